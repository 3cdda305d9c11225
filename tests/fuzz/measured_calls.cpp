// Measured cycles of any program's functions: what is taken names its program and is within range.
#include "qemu/emulate/measured_calls.hpp"

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const std::string text = fuzz::to_text(data, size);
        const bool is_told_by_its_header = qemu::names_programs(text);
        const auto rows = qemu::parse_measured_calls(text, "file", "folder");
        fuzz::expect(!rows.empty() && is_told_by_its_header);
        unsigned line = 0;
        for (const qemu::MeasuredCall& row : rows) {
            fuzz::expect(row.line > line);
            line = row.line;
            fuzz::expect(!row.elf.empty() && !row.function.empty() && !row.core.empty());
            fuzz::expect(row.cycles > 0.0 && row.cycles <= 1e12 && row.per > 0.0 && row.per <= 1e12);
        }
    });
    return 0;
}
