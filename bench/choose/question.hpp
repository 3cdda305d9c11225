// A budget as a user states it, and the answer with where its numbers come from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/machines.hpp"
#include "bench/choose/conditions.hpp"
#include "bench/choose/derivative_errors.hpp"
#include "bench/choose/search.hpp"
#include "bench/choose/would_do.hpp"
#include "bench/rows/row.hpp"
#include "qemu/emulate/firmware.hpp"

namespace choose {

enum class Target { host, m7, m4 };
/// The emulated machine of a target; null: this machine itself.
[[nodiscard]] const base::Machine* machine_of(Target target);
/// "host", "m7", "m4"; nothing for other words.
[[nodiscard]] std::optional<Target> target_called(std::string_view word);
[[nodiscard]] std::string_view word_of(Target target);

struct Question {
    Conditions conditions;
    Target target = Target::m7;
    std::string core;                  ///< of the timing model, whose cycles count; empty: instructions do
    std::vector<std::string> kernels;  ///< to choose among
    double max_error = 0.0;            ///< of the sum, or of the derivative where there is a goal
    std::optional<glsum::design::DerivativeGoal> goal;
    FilterDesign by = FilterDesign::fitted;  ///< of a goal
    std::optional<double> max_cycles;
    std::optional<double> max_instructions;
    std::optional<double> max_bytes;
    std::optional<double> clock_hz;
    std::optional<double> rate_hz;
    std::filesystem::path results;   ///< measurements of an earlier run; empty: none
    bool results_asked_for = false;  ///< a missing file is then an error
    unsigned jobs = 1;

    [[nodiscard]] CountedOrder counted_order() const { return {conditions.order, goal.has_value()}; }
};

struct Answer {
    Question question;
    Choice choice;
    std::optional<DerivativeReport> derivative;  ///< of what was chosen, where there is a goal
    std::vector<WouldDo> would_do;               ///< where nothing meets a goal: lesser goals that something meets
    std::string unit;                            ///< of what is ranked
    std::string limited_unit;                    ///< of what the cost limit holds against
    std::vector<std::string> notes;              ///< where the numbers come from, one sentence each
    bench::Json context;                         ///< the conditions of this run
};

/// Kernels that run on a target: all but `null`, on an emulated one without the host's own, those of integrals for
/// these alone.
[[nodiscard]] std::vector<std::string> kernels_of(Target target, double order);

/// Of a whole order, what its sum is; empty for others.
[[nodiscard]] std::string what_a_whole_order_is(double order);

/// \param board  needed for an emulated target; on the host it only says whether a file's rows are of this build
/// \throws glsum::Failure (bad input) for limits that do not suit the target; (missing) without a board for an emulated
/// target.
[[nodiscard]] Answer answer(const Question& question, const std::optional<qemu::Board>& board);

/// The error and cost of one kernel and length, whatever the limits: `chosen` of the answer. Without a board the
/// target's cost has a fault that says so. \throws glsum::Failure (bad input) when the kernel refuses the length.
[[nodiscard]] Answer measure_one(const Question& question, const std::string& kernel, std::size_t taps,
                                 const std::optional<qemu::Board>& board);

}  // namespace choose
