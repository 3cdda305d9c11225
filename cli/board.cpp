#include "cli/board.hpp"

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"

namespace cli {

std::filesystem::path cores_folder() { return std::filesystem::path(build_info::source_folder) / "qemu" / "cores"; }

std::filesystem::path plugin() { return std::filesystem::path(build_info::build_folder) / "qemu" / "glsum_plugin.so"; }

std::filesystem::path emulate_script(const base::Machine& machine) {
    return std::filesystem::path(build_info::source_folder) / "targets" / machine.board / "emulate";
}

qemu::Board built_board(const base::Machine& machine) {
    const std::filesystem::path built = build_info::build_folder;
    qemu::Board board = qemu::find_board(built.parent_path() / machine.board, plugin(), emulate_script(machine));
    board.cores = cores_folder();
    (void)qemu::emulator_version();
    return board;
}

qemu::SiliconProgram built_silicon() {
    const qemu::Board board = built_board();
    return {board.measure_elf.parent_path() / "silicon.elf", board.plugin, board.cores, board.emulator};
}

std::optional<qemu::Board> board_if_there(const base::Machine& machine) {
    try {
        return built_board(machine);
    } catch (const glsum::Failure&) {
        return std::nullopt;
    }
}

std::vector<qemu::MeasuredCycles> read_measured_cycles(const std::filesystem::path& path) {
    return qemu::parse_measured_cycles(base::read_file(path, qemu::MeasuredLimits::bytes), path.string());
}

}  // namespace cli
