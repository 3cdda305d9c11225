// Verdicts on blind cases against the truth that was sealed.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drive/stand/blind/calibration.hpp"

namespace stand::blind {

struct Stretch {
    double from_s;
    double to_s;
    double share = 0.0;  ///< of the squared gap; of a verdict
};

/// A case of the sealed file.
struct SealedCase {
    std::string name;
    std::string kind;          ///< `none`, `single`, `pair`, `unlisted`; `same` or, of a fitted base, `taken_up`
    bool fitted_base = false;  ///< nobody handed over a model: `judge` scores it
    std::string domain;        ///< of a fitted base
    std::vector<std::string> effects;
    std::string size;  ///< of the first effect; empty without one
    std::vector<std::string> required;
    std::vector<std::string> allowed;
    std::string train;
    std::string validate;
    bool new_profile = false;
    double gap_base = 0.0;
    double noise_floor = 0.0;
    std::vector<Stretch> where;
};

/// What a verdict says.
struct Answer {
    std::string verdict;  ///< `attributed`, `ambiguous`, `unknown`, `no_gap`
    std::vector<std::string> effects;
    double confidence = 0.0;           ///< the lowest of the named effects'; 0 without any
    std::vector<std::string> ranking;  ///< best first
    std::optional<double> gap_after;
    std::vector<Stretch> where;
};

/// By how much of the validation log-likelihood a true effect beats every other single one where it is identifiable.
inline constexpr double identifiable_lead = 10.0;

/// The true effect, refitted by the optimizer of the diagnosis: what could have been reached.
struct Oracle {
    bool identifiable = false;
    double gap_base = 0.0;  ///< on the validation records, as the diagnosis simulates them
    double gap_after = 0.0;
};

/// \throws glsum::Failure (bad input) naming the file, the case, what was expected and what was found.
[[nodiscard]] std::vector<SealedCase> parse_sealed(const std::string& text, const std::string& name);
[[nodiscard]] Answer parse_answer(const std::string& text, const std::string& name);

struct Score {
    Share top_one;       ///< all cases: the right answer of their class
    Share identifiable;  ///< single effects that the oracle finds identifiable; none counted without an oracle
    Share top_two;    ///< cases with listed effects: right, or among the first two (two more for a pair) of the ranking
    Share detection;  ///< cases with an effect: anything but `no_gap`
    Share false_alarms;  ///< cases without: anything but `no_gap`
    Share false_alarms_new_profile;
    Share wrong_claims;  ///< of the attributed: another effect is named than the true one
    std::map<std::string, Share> by_class;
    std::map<std::string, Share> by_effect;  ///< single ones
    std::map<std::string, Share> by_size;
    std::map<std::string, Share> by_training;                             ///< single ones, by the training's excitation
    std::vector<Claim> claims;                                            ///< the attributed
    std::vector<Confidence> calibration;                                  ///< of them
    std::map<std::string, std::map<std::string, std::size_t>> confusion;  ///< truth, answer
    std::vector<double> shrinks;  ///< of rightly named effects, by the true noise floor; sorted
    /// Of all cases with one or two listed effects: how far the gap shrinks over how far the oracle shrinks it; 0 where
    /// nothing is named. Sorted.
    std::vector<double> of_the_oracle;
    std::vector<double> in_the_stretch;  ///< share of the located gap inside the true stretch, for events; sorted
};

/// What a table of confusions calls them: the effect of a single one, else the class; the effects of an attribution,
/// else the verdict.
[[nodiscard]] std::string row_of(const SealedCase& truth);
[[nodiscard]] std::string column_of(const Answer& answer);

/// Whether an answer is the right one.
[[nodiscard]] bool is_right(const SealedCase& truth, const Answer& answer);

/// \param oracle  of each case, or empty
[[nodiscard]] Score score(std::span<const SealedCase> truths, std::span<const Answer> answers,
                          std::span<const std::optional<Oracle>> oracle = {});

/// The answer of somebody who names one effect, or `none`.
[[nodiscard]] Answer answer_naming(const std::string& effect);

/// The answers of somebody who looks at nothing.
[[nodiscard]] std::vector<Answer> constant_guess(std::size_t cases);

/// Somebody's score and name, for a table.
struct Scored {
    std::string name;
    Score score;
};

/// For people: the first in full, the others in one line each. \param scored  at least one
[[nodiscard]] std::string to_text(std::span<const Scored> scored);
[[nodiscard]] std::string to_json(std::span<const Scored> scored);

/// What is to be reached and is not: top-1 90 % of the identifiable, false alarms at most 5 %, `unknown` for 80 % of
/// the unlisted, 70 % of the pairs, 0.9 of the oracle's shrink in the median. Empty: all reached, as far as counted.
[[nodiscard]] std::vector<std::string> missed_goals(const Score& score);

}  // namespace stand::blind
