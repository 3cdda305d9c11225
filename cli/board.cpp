#include "cli/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "qemu/emulate/foreign_program.hpp"

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
    board.machine = &machine;
    (void)qemu::emulator_version();
    return board;
}

qemu::SiliconProgram built_silicon(const base::Machine& machine) {
    const qemu::Board board = built_board(machine);
    return {board.measure_elf.parent_path() / "silicon.elf", board.plugin, board.cores, board.emulator};
}

qemu::CallsProgram calls_program(unsigned timeout_s) {
    return {
        [timeout_s](const base::Machine& machine) {
            return qemu::Emulator{emulate_script(machine), std::chrono::seconds(timeout_s), std::chrono::seconds(10)};
        },
        plugin(), cores_folder()};
}

std::vector<std::string> default_cores() {
    std::vector<std::string> cores;
    for (const base::Machine& machine : base::machines) {
        cores.emplace_back(machine.default_core);
    }
    return cores;
}

void take_cores(bench::Sweep& sweep, const std::vector<std::string>& asked) {
    sweep.cores.clear();
    std::vector<std::string> wanted = asked;
    if (asked.empty()) {
        wanted = default_cores();
        wanted.insert(wanted.begin(), bench::count_only);
    }
    for (const std::string& core : wanted) {
        if (std::find(sweep.cores.begin(), sweep.cores.end(), core) != sweep.cores.end()) {
            continue;
        }
        if (core == bench::count_only) {
            sweep.cores.push_back(core);
            continue;
        }
        const base::Machine& machine = qemu::machine_of({core, "", ""}, cores_folder());
        // Where nothing is emulated a core is only named for the record, as the first machine's are.
        const bool serves =
            sweep.wants(machine.word) || (sweep.machines().empty() && &machine == base::machines.data());
        if (!serves && !asked.empty()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("--core {}: of a {}; expected --targets with {} beside it", core,
                                             machine.name, machine.word));
        }
        if (serves) {
            sweep.cores.push_back(core);
            if (&machine != base::machines.data()) {
                sweep.machine_of_core[core] = machine.word;
            }
        }
    }
    for (const base::Machine* machine : sweep.machines()) {
        if (sweep.cores_on(*machine).empty()) {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                fmt::format("--core: expected count or a core of a {}, one of --targets, too", machine->name));
        }
    }
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
