#include "cli/board.hpp"

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"

namespace cli {

std::filesystem::path cores_folder() { return std::filesystem::path(build_info::source_folder) / "qemu" / "cores"; }

qemu::Board built_board() {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path built = build_info::build_folder;
    qemu::Board board = qemu::find_board(built.parent_path() / "mps2-an500", built / "qemu" / "glsum_plugin.so",
                                         source / "targets" / "mps2-an500" / "emulate");
    board.cores = cores_folder();
    (void)qemu::emulator_version();
    return board;
}

std::optional<qemu::Board> board_if_there() {
    try {
        return built_board();
    } catch (const glsum::Failure&) {
        return std::nullopt;
    }
}

std::vector<qemu::MeasuredCycles> read_measured_cycles(const std::filesystem::path& path) {
    return qemu::parse_measured_cycles(base::read_file(path, qemu::MeasuredLimits::bytes), path.string());
}

}  // namespace cli
