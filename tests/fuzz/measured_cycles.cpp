// Measured cycles from anywhere: what is taken is within the ranges that the prediction counts on.
#include "qemu/emulate/measured_cycles.hpp"

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const auto rows = qemu::parse_measured_cycles(fuzz::to_text(data, size), "file");
        fuzz::expect(!rows.empty());
        unsigned line = 0;
        for (const qemu::MeasuredCycles& row : rows) {
            fuzz::expect(row.line > line);
            line = row.line;
            fuzz::expect(row.taps >= 1 && row.taps <= 1'000'000);
            fuzz::expect(row.cycles >= 1.0 && row.cycles <= 1e12);
            fuzz::expect(row.instructions.value_or(1.0) >= 1.0 && row.instructions.value_or(1.0) <= 1e12);
        }
    });
    return 0;
}
