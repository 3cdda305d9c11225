// A thresholds file of the gate from anywhere: read, and asked.
#include <cmath>
#include <string>

#include "bench/gate/rules.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const bench::gate::Rules rules = bench::gate::parse_rules(fuzz::to_text(data, size), "file");
        for (const bench::gate::Rule& rule : rules) {
            fuzz::expect(!rule.rows.empty() && !rule.counters.empty() && !rule.reason.empty());
            fuzz::expect(std::isfinite(rule.relative) && rule.relative >= 0.0);
            fuzz::expect(std::isfinite(rule.absolute) && rule.absolute >= 0.0);
            (void)rule.wants_row("gl/ring_plain_f32/order:0.5/taps:600/accuracy/signal:step");
            fuzz::expect(!(rule.excess(1.0, 1.0) > 0.0));
        }
        (void)bench::gate::better_of(rules, "gl/ring_plain_f32/order:0.5/taps:600/host", "real_time");
    });
    return 0;
}
