#include "cli/board.hpp"

#include "bench/build_info.hpp"
#include "qemu/failure.hpp"

namespace cli {

qemu::Board built_board() {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path built = build_info::build_folder;
    qemu::Board board = qemu::find_board(built.parent_path() / "mps2-an500", built / "qemu" / "glsum_plugin.so",
                                         source / "targets" / "mps2-an500" / "emulate");
    (void)qemu::emulator_version();
    return board;
}

std::optional<qemu::Board> board_for(const choose::Question& question) {
    try {
        return built_board();
    } catch (const glsum::Failure&) {
        if (question.target == choose::Target::m7) {
            throw;
        }
        return std::nullopt;
    }
}

}  // namespace cli
