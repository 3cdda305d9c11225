#include "qemu/emulate/measured_calls.hpp"

#include <fmt/format.h>

#include "base/failure.hpp"
#include "qemu/emulate/measured_table.hpp"

namespace qemu {

bool names_programs(const std::string& text) { return MeasuredTable::has_header_with(text, "elf"); }

std::vector<MeasuredCall> parse_measured_calls(const std::string& text, const std::string& name,
                                               const std::filesystem::path& folder) {
    const MeasuredTable table(text, name, {"elf", "function", "core", "code", "data", "measured", "per"});
    std::vector<MeasuredCall> rows;
    for (std::size_t i = 0; i < table.size(); ++i) {
        for (const char* column : {"elf", "function", "core"}) {
            if (table.text(i, column).empty()) {
                throw glsum::Failure(glsum::Exit::bad_input,
                                     fmt::format("{}: expected a name, found none", table.place(i, column)));
            }
        }
        const std::string code = table.one_of(i, "code", {"itcm", "flash", "flash_cached", "axi", ""});
        rows.push_back({folder / table.text(i, "elf"), table.text(i, "function"), table.text(i, "core"),
                        code == "flash_cached" ? "flash" : code, table.one_of(i, "data", {"dtcm", "axi", ""}),
                        table.number<double>(i, "measured", 1e-6, 1e12), table.number<double>(i, "per", 1e-6, 1e12),
                        table.line(i), table.has("group") ? table.text(i, "group") : ""});
    }
    return rows;
}

}  // namespace qemu
