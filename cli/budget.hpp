// The options by which `choose` and `generate` take a budget.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/choose/question.hpp"
#include "cli/command.hpp"
#include "qemu/emulate/firmware.hpp"

namespace cli {

/// Of a record: hours and gigabytes, where a sum's full memory is searched.
inline constexpr std::size_t most_samples_of_a_record = 10'000'000;

struct Budget {
    double order = 0.0;
    double step_s = 0.0;
    double max_error = 0.0;
    std::string derivative_error;
    std::string band;
    double step_until_s = 0.0;
    std::string design;
    std::string plot;
    std::vector<std::string> signals;
    std::optional<double> max_cycles;
    std::optional<double> max_instructions;
    std::optional<double> max_bytes;
    std::optional<double> clock_hz;
    std::optional<double> rate_hz;
    std::string target;
    std::string core;
    std::string results;
    bool fresh = false;
    bool quick = false;
    std::size_t samples = 0;
    unsigned jobs = 1;
};

/// Adds the options. \param needs_order  else the order may be left out, and is then not a number
/// \return the budget that they fill.
std::shared_ptr<Budget> add_budget(Command& command, bool needs_order = true);

/// The core file that is modelled: the one asked for, or the usual one of the target's machine.
[[nodiscard]] std::string core_of(const Budget& budget);

/// Samples of the records.
[[nodiscard]] std::size_t samples_of(const Budget& budget);

/// Checks what was typed. \throws glsum::Failure (bad input) naming the option, what was expected and found.
[[nodiscard]] choose::Question to_question(const Budget& budget);

/// Draws what was chosen where --plot was given. \pre something was chosen
void plot_if_asked(const Budget& budget, const choose::Answer& answer);

/// The board where a question needs it, else the board if it is there.
[[nodiscard]] std::optional<qemu::Board> board_for(const choose::Question& question);

}  // namespace cli
