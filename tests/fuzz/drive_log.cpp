// A drive's log from anywhere: read, its stamps put in order, resampled, and written.
#include <cmath>

#include "drive/log.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        drive::Log log = drive::parse_log(fuzz::to_text(data, size), "file");
        fuzz::expect(log.time_s.size() >= 2 && log.output.size() == log.time_s.size());
        fuzz::expect(log.input.size() == log.time_s.size() && log.line.size() == log.time_s.size());
        // What was taken is written, and taken again, as it was.
        const drive::Log again = drive::parse_log(drive::to_csv(log), "again");
        fuzz::expect(again.time_s == log.time_s && again.input == log.input && again.output == log.output);
        (void)drive::order_stamps(log);
        for (std::size_t k = 1; k < log.time_s.size(); ++k) {
            fuzz::expect(log.time_s[k] > log.time_s[k - 1]);
        }
        const double length_s = log.time_s.back() - log.time_s.front();
        if (length_s < 1e6) {
            for (const drive::Hold hold : {drive::Hold::linear, drive::Hold::zero_order}) {
                for (const double value : drive::resample(log, length_s / 100.0, hold).log.output) {
                    fuzz::expect(std::isfinite(value));
                }
            }
        }
    });
    // The same with what options decide, and with columns by number.
    fuzz::refused_or([&] {
        const drive::Columns columns = {.time = "1",
                                        .output = "2",
                                        .needs_input = false,
                                        .separator = size % 2 == 0 ? "comma" : "blank",
                                        .decimal = "comma",
                                        .time_unit = "ms"};
        const drive::Log log = drive::parse_log(fuzz::to_text(data, size), "file", columns);
        fuzz::expect(log.output.size() == log.time_s.size() && std::isfinite(log.time_s.back()));
    });
    return 0;
}
