#include "qemu/emulate/measured_cycles.hpp"

#include <fmt/format.h>

namespace qemu {

std::vector<MeasuredCycles> parse_measured_cycles(const std::string& text, const std::string& name) {
    const MeasuredTable table(text, name, {"kernel", "code", "data", "maintenance", "taps", "cycles"});
    std::vector<MeasuredCycles> rows;
    for (std::size_t i = 0; i < table.size(); ++i) {
        rows.push_back({table.text(i, "kernel"), table.one_of(i, "code", {"flash_cached", "flash", "itcm"}),
                        table.one_of(i, "data", {"dtcm", "axi"}), table.one_of(i, "maintenance", {"0", "1"}) == "1",
                        table.number<std::uint32_t>(i, "taps", 1, 1e6), table.number<double>(i, "cycles", 1, 1e12),
                        table.line(i)});
        if (table.has("instructions")) {
            rows.back().instructions = table.number<double>(i, "instructions", 1, 1e12);
        }
    }
    return rows;
}

std::string to_csv(const std::vector<MeasuredCycles>& rows) {
    std::string csv = "kernel,code,data,maintenance,taps,cycles\n";
    for (const MeasuredCycles& row : rows) {
        csv += fmt::format("{},{},{},{},{},{}\n", row.kernel, row.code, row.data, row.maintenance ? 1 : 0, row.taps,
                           row.cycles);
    }
    return csv;
}

}  // namespace qemu
