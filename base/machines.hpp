// The emulated targets: one row each. A second core was added by its row, its core files, its model and its board.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace base {

struct Machine {
    std::string_view word;          ///< as commands and the names of rows have it
    std::string_view core;          ///< as core files name the model of its core
    std::string_view name;          ///< of the core, for texts
    std::string_view board;         ///< its folder of targets/, and the preset that builds its firmware
    std::string_view default_core;  ///< the core file where none is asked for: the fastest memories
    unsigned issues_a_cycle;        ///< instructions, at most
};

inline constexpr std::array<Machine, 2> machines{{
    {"m7", "cortex-m7", "Cortex-M7", "mps2-an500", "stm32f746-itcm", 2},
    {"m4", "cortex-m4", "Cortex-M4", "mps2-an386", "cortex-m4-zerowait", 1},
}};

[[nodiscard]] constexpr std::array<std::string_view, machines.size()> machine_words() {
    std::array<std::string_view, machines.size()> words;
    std::transform(machines.begin(), machines.end(), words.begin(),
                   [](const Machine& machine) { return machine.word; });
    return words;
}

/// By its word.
[[nodiscard]] constexpr const Machine* machine_called(std::string_view word) {
    const auto* const found =
        std::find_if(machines.begin(), machines.end(), [&](const Machine& m) { return m.word == word; });
    return found == machines.end() ? nullptr : found;
}

/// The machine whose core a core file is for.
[[nodiscard]] constexpr const Machine& machine_of_core(std::string_view core) {
    const auto* const found =
        std::find_if(machines.begin(), machines.end(), [&](const Machine& m) { return m.core == core; });
    return found == machines.end() ? machines.front() : *found;
}

}  // namespace base
