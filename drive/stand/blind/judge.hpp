// The rules for verdicts on cases whose base the judge fitted, and what is to be reached by them.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "drive/stand/blind/score.hpp"

namespace stand::blind {

/// An ambiguity of more alternatives earns nothing.
inline constexpr std::size_t most_alternatives = 3;

struct Judgement {
    double points = 0.0;  ///< 0 to 1
    bool wrong = false;   ///< attributed, and nothing of the truth is named
};

/// Nothing to find, or what a fitted base takes up: `no_gap` earns 1. An unlisted effect: `unknown` does. A single one
/// or a pair: an attribution earns the share that true and named effects have in common (of a pair one alone half, a
/// true one beside a false one half); an ambiguity the mean of what its alternatives would earn, so 1/k of one effect
/// among k, and nothing above three. Everything else earns 0; wrong is an attribution without a true effect alone.
[[nodiscard]] Judgement judge(const SealedCase& truth, const Answer& answer);

/// Points of so many cases.
struct Earned {
    double points = 0.0;
    std::size_t all = 0;
    [[nodiscard]] double value() const { return all == 0 ? 0.0 : points / static_cast<double>(all); }
};

/// One case, its answer, and what that is worth.
struct JudgedCase {
    SealedCase truth;
    Answer answer;
    Judgement judged;
};

struct OpenScore {
    std::vector<JudgedCase> cases;
    Earned singles;
    Earned pairs;
    Share wrong;                              ///< of all cases
    Share unlisted;                           ///< `unknown`
    Share nothing;                            ///< `no_gap` where nothing is to find or a fitted base takes it up
    std::map<std::string, Earned> by_effect;  ///< single ones
    std::map<std::string, Earned> by_domain;  ///< single ones
    std::map<std::string, Earned> by_size;    ///< single ones
    Share ambiguous_without;                  ///< of the ambiguous answers, those that hold nothing of the truth
    std::vector<Claim> claims;                ///< the attributed; right: all points
    std::map<std::string, std::map<std::string, std::size_t>> confusion;  ///< truth, answer; both by their names
};

/// \param answers  one for each case \throws glsum::Failure (bad input) for another number
[[nodiscard]] OpenScore score_open(std::span<const SealedCase> truths, std::span<const Answer> answers);

/// For people.
[[nodiscard]] std::string to_text(const OpenScore& score);
/// Schema `glsum-open-score-1`.
[[nodiscard]] std::string to_json(const OpenScore& score);

/// What is to be reached and is not: 80 % of the points for single causes, at most 3 % of all cases wrong, `unknown`
/// for 85 % of the unlisted, `no_gap` for 95 % where there is nothing to find, nine in ten right of the answers at 0.9
/// and above, six in ten of the right ones there. Empty: all reached, as far as counted.
[[nodiscard]] std::vector<std::string> missed_goals(const OpenScore& score);

}  // namespace stand::blind
