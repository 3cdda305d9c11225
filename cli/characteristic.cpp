#include "cli/characteristic.hpp"

#include <fmt/format.h>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "cli/drive_files.hpp"
#include "drive/static_characteristic.hpp"

namespace cli {

void add_characteristic_options(Command& command, CharacteristicOptions& options) {
    command.add_flag("--static", options.asked,
                     "Instead: the static characteristic, where the output rests for each level of the input");
    command.add_option("--hold-s", options.shortest_hold_s, "Of --static: shorter holds are passed over")
        .above(0)
        .capture_default_str();
}

void show_characteristic(const CharacteristicOptions& options, const std::vector<std::filesystem::path>& logs,
                         const drive::Columns& columns, const std::filesystem::path& out,
                         const std::filesystem::path& plot) {
    if (logs.size() != 1) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("--static: expected one log, found {}", logs.size()));
    }
    const drive::StaticCharacteristic found =
        drive::static_characteristic(read_ordered_log(logs.front(), columns), options.shortest_hold_s);
    fmt::print("{}", drive::to_text(found));
    if (!out.empty()) {
        base::write_file(out, drive::to_csv(found));
    }
    if (!plot.empty()) {
        base::draw(
            drive::picture_of_characteristic(found, "Static characteristic of " + logs.front().filename().string()),
            plot);
    }
}

}  // namespace cli
