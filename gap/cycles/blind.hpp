// Measured cycles of cores that nobody told the diagnosis: secret switches and costs of the timing model, and a counter
// that is not exact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gap/cycles/explain.hpp"

namespace gap::cycles {

/// What was done to a core.
struct Secret {
    std::string kind;                       ///< nothing, switch, cost, two, unlisted; rules, rules and cost
    std::vector<std::string> effects = {};  ///< that the diagnosis is to name, sorted; of `unlisted` none
    std::vector<std::string> without = {};  ///< effects of the model that it does not pay
    std::string set = {};                   ///< rule set of the core file that made the cycles; empty: the nominal one
    std::string mechanism = {};             ///< that made them, one that the core has not (timing::Mechanisms)
    double ratio = 1.0;                     ///< of the clocks: all cycles
    double overhead = 0.0;                  ///< cycles a call
    double maintenance = 0.0;               ///< and beside them where caches are maintained
    double contention = 0.0;                ///< a part of the call's cycles where it is on the bus
    double sawtooth = 0.0;                  ///< of the cycles of lengths 3 n + 1: what no listed effect does

    /// The set or mechanism that made the cycles, where it is not the judge's; empty: it is.
    [[nodiscard]] const std::string& other_rules() const { return mechanism.empty() ? set : mechanism; }
};

/// Effects without which the rows' cycles differ by more than what is taken for no gap: what a switch takes away.
/// \param predict  of `blind_rows`
[[nodiscard]] std::vector<std::string> switches_that_show(const std::string& core, const Predict& predict);

/// A quarter nothing, 15 % two at once, 15 % unlisted, of the rest half a switch and half a cost.
/// \param switches  as `switches_that_show`
[[nodiscard]] std::vector<Secret> draw_secrets(std::size_t cases, std::uint64_t seed,
                                               const std::vector<std::string>& switches);

/// Whether it is known where the rules of a set, or a mechanism, act.
[[nodiscard]] bool has_place(const std::string& rules);

/// The rules that may make a core's cycles in its place: its rival sets that fit silicon, and every mechanism.
/// \throws glsum::Failure (bad input) for a core file without rival rules of a Cortex-M7
[[nodiscard]] std::vector<std::string> other_rules_of(const std::string& core, const std::filesystem::path& cores);

/// A core file of that core with a mechanism that it has not.
[[nodiscard]] std::string core_with(const std::string& core, const std::string& mechanism);

/// Cores whose cycles other rules made than those that judge: another mechanism, not other numbers of the same one.
/// Half of them have a cost beside it. \param rules  sets and mechanisms that have a place, one at least
[[nodiscard]] std::vector<Secret> draw_other_rules(std::size_t cases, std::uint64_t seed,
                                                   const std::vector<std::string>& rules);

/// `case-001`, ...
[[nodiscard]] std::string name_of_case(std::size_t number);

/// The truth of all cases, as the sealed file holds it: JSON.
[[nodiscard]] std::string seal(const std::vector<Secret>& secrets);

/// The rows of a blind case: kernels of each number format, loops of published measurements among them, in the fastest
/// memory and over the bus with caches maintained, six lengths each. Their cycles are 0.
/// \param beyond_caches  also lengths whose data a cache of 4 KB does not hold
[[nodiscard]] std::vector<qemu::MeasuredCycles> blind_rows(bool beyond_caches = false);

/// Sets the rows' cycles: what a core predicts without the secret's switches, its costs, and a counter that is a cycle
/// off in either direction two times of three.
void measure(std::vector<qemu::MeasuredCycles>& rows, const std::vector<qemu::PredictedCycles>& predicted,
             const Secret& secret, std::uint64_t seed);

/// Whether an explanation says what was done: no gap of nothing, `unknown` of what is not listed, else every effect and
/// no other; of an ambiguous one with one of its alternatives (a slower clock looks like interrupts). Other rules are
/// no effect of the list: of them alone all but a name for what they do not touch is right, and a cost beside them is
/// to be named, with nothing that they do not touch.
[[nodiscard]] bool names(const Explanation& found, const Secret& secret);

}  // namespace gap::cycles
