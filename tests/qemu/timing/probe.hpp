// Runs a few instructions, written in assembly, through the model: the assembler encodes them, this walks them.
//
// Registers hold addresses only as far as loads and stores move them: r0 to r9 begin at 0x20000000 + 0x100 * n, sp at
// 0x20010000; a written-back base moves. Nothing else is computed. A backward branch is taken on every turn but the
// last, a forward one if it is unconditional; what is called returns.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "listing.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/model.hpp"

namespace probe {

struct Outcome {
    std::vector<std::int64_t> positions;  ///< half cycle of each executed instruction's issue
    timing::Losses losses{};
    std::size_t unknown = 0;
};

struct Setting {
    timing::Figures figures;
    timing::Placement placement;
    timing::Effects off;
    std::map<unsigned, std::uint32_t> registers = {};  ///< addresses other than the usual ones
    unsigned turns = 1;                                ///< of a backward branch
    timing::Core core = timing::Core::cortex_m7;
};

/// The nominal set of a core of qemu/cores.
[[nodiscard]] Setting core(const std::string& name);

[[nodiscard]] Outcome run(const std::string& assembly, const Setting& setting);

/// Of a text one after the other, or of the loop that it is.
enum class How { copies, turns };

/// A text whose lines are parted by ";".
[[nodiscard]] std::string lines_of(const char* text);

/// Cycles that one more copy of the text takes, in a steady run of copies: 24 against 16 of them. A copy has labels of
/// its own if it uses local numeric ones.
[[nodiscard]] double steady_cycles(const std::string& assembly, const Setting& setting);

/// Cycles that one more turn of the loop takes, in a steady run: 24 against 16 turns.
[[nodiscard]] double steady_turns(const std::string& assembly, Setting setting);

/// Either. \param text  lines parted by ";"
[[nodiscard]] double steady(const char* text, How how, const Setting& setting);

/// Expects that five turns of a text take half a cycle an instruction and what they lost, exactly.
void expect_losses_to_sum(const char* text, const std::string& core);
/// Expects that an effect that is switched off loses nothing, each of them. \param text  likewise
void expect_effects_to_switch_off(const char* text, const std::string& core);

}  // namespace probe
