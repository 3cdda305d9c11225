// Answers to an exam against what is known: right, ambiguous, unknown, wrong; the gap before and after beside what is
// attainable.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gap/exam/truth.hpp"

namespace gap::exam {

/// What a verdict's file says, or a refusal.
struct Reply {
    std::string verdict;  ///< attributed, ambiguous, unknown, no_gap or refused
    /// Sets of effects that are named together: one of an attribution, several of an ambiguity.
    std::vector<std::vector<std::string>> named;
    double confidence = 0.0;           ///< the lowest of the named; 0 without any
    std::vector<std::string> suspect;  ///< of an unknown
    std::optional<double> gap_before;
    std::optional<double> gap_after;
    std::string reason;  ///< of a refusal
};

/// Of schema glsum-gap-1. \throws glsum::Failure (bad input) naming the file, what was expected and what was found.
[[nodiscard]] Reply parse_reply(const std::string& text, const std::string& name);
[[nodiscard]] Reply refusal(const std::string& reason);

enum class Mark {
    right,           ///< causes that are known, a main one among them; `no_gap` where nothing large is missing
    spurious,        ///< a main cause, and one that is none beside it
    ambiguous,       ///< one of the alternatives is right
    honest_unknown,  ///< nothing listed is known to make it
    missed,          ///< unknown, though there was an answer
    wrong,           ///< causes without a main one, or `no_gap` where there is a cause
    refused,
};
inline constexpr std::array all_marks = {Mark::right,  Mark::spurious, Mark::ambiguous, Mark::honest_unknown,
                                         Mark::missed, Mark::wrong,    Mark::refused};
/// In words, for a table.
[[nodiscard]] const char* name_of(Mark mark);

struct Scored {
    Truth truth;
    Reply reply;
    Mark mark = Mark::wrong;
    /// 1 for right and for an honest unknown, 1/2 beside a spurious cause, 1/k for an ambiguity of k alternatives
    /// (those that are right count as one) and 0 for one of more than three, else 0.
    double points = 0.0;
    std::optional<double> attainable_gap;
    /// (before - after) / (before - attainable), at most 1; 0 where nothing is named; none where nothing is attainable.
    std::optional<double> closed;
};

[[nodiscard]] Scored score(const Truth& truth, const Reply& reply);

/// A table and its sums for a terminal.
[[nodiscard]] std::string to_text(std::span<const Scored> all);
/// Schema glsum-exam-score-1.
[[nodiscard]] std::string to_json(std::span<const Scored> all);

}  // namespace gap::exam
