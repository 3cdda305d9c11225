// A verdict, whoever gives it: what is named with which numbers, how far the gap shrinks, where it lies, what comes
// next.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gap/verdict/outcome.hpp"
#include "gap/verdict/where.hpp"
#include "gap/verdict/written.hpp"

namespace gap {

struct Cause {
    std::string effect;
    std::vector<Written> parameters;  ///< with intervals of 95 %, where there are any
    double gap_before;
    double gap_after;
    double shrink;  ///< of what can be closed
    double confidence;
    std::optional<double> gap_without =
        {};  ///< of a drive: what is left beside the others that are named, if it was tried
};

/// In place of effects in a ranking: what is judged, as it is.
constexpr const char* no_effect = "none";

/// What was tried, by how far it goes.
struct Rank {
    std::string effects;  ///< joined by " + ", or `no_effect`
    double gap_after;
    double score;  ///< higher is better
};

struct Gap {
    std::string metric;
    double base;
    double after;  ///< with what helps most
    double noise_floor;
};

/// The model of a drive that effects were looked for in.
struct BaseOfDrive {
    std::string form;                 ///< empty: a model was given
    std::string model;                ///< its equation
    std::string in_short;             ///< the same with four digits
    double linear_share;              ///< of the validation output's variance, by the best linear description
    double idle_input;                ///< the logged level that inputs and the numbers of causes are counted from
    std::vector<Written> parameters;  ///< with intervals of 95 %
    struct Record {
        std::string name;
        std::vector<std::pair<std::string, double>> numbers;  ///< its operating point, state and events
    };
    std::vector<Record> records;  ///< those judged that have numbers of their own
    struct Description {
        std::string form;
        double gap_aside;  ///< in blocks of the training kept aside
        double gap;
    };
    std::vector<Description> descriptions;  ///< that were tried, the best first; empty: none were
};

/// What leads where nothing is named.
struct Suspect {
    std::string name;  ///< as in the ranking
    std::vector<std::pair<std::string, std::vector<Written>>> effects;
    double gap_after;
    double unexplained;  ///< of the base's squared gap
};

/// What a verdict on a drive has beside the rest.
struct OfDrive {
    std::vector<std::vector<Cause>> alternatives;  ///< one that is named, or several that these data cannot part
    std::string chosen;                            ///< of the ranking, what helps most, be it `no_effect`
    Where where;
    BaseOfDrive base;
    std::optional<Suspect> suspect = {};
    std::vector<std::string> extrapolated;  ///< what validation has and training lacks
    double confidence;
    bool split;  ///< parts of the training records were kept aside to judge
};

/// What a verdict on cycles has beside the rest.
struct OfCycles {
    std::string judged;               ///< the core file
    std::string reference;            ///< that of the core which pays what was found
    std::vector<Cause> steps;         ///< from the one to the other, in turn
    std::vector<Cause> alternatives;  ///< of one step more: each explains the same
    std::string apart;                ///< what the alternatives are about
    WhereInRows where;
};

struct Verdict {
    Outcome outcome;
    Gap gap;
    std::vector<Rank> ranking;
    std::variant<OfDrive, OfCycles> of;
    std::string next_experiment;
    std::vector<std::string> notes;
};

/// Schema glsum-gap-1.
[[nodiscard]] std::string to_json(const Verdict& verdict);
/// Some lines for a terminal.
[[nodiscard]] std::string to_text(const Verdict& verdict);

/// The numbers of causes that stand together, and what each takes of the gap.
[[nodiscard]] std::vector<std::string> cause_lines(const std::vector<Cause>& causes);
/// The base with its numbers, how linear the records are, and each record's operating point; empty: a model was given.
[[nodiscard]] std::string base_line(const OfDrive& of);
/// What leads where nothing is named, and what stays unexplained; empty: something is named, or nothing leads.
[[nodiscard]] std::string suspect_line(const Verdict& verdict, const OfDrive& of);
/// 0: it is not among them.
[[nodiscard]] double score_of_no_effect(const std::vector<Rank>& ranking);
/// The names of causes that stand together, as in the ranking.
[[nodiscard]] std::string joined(const std::vector<Cause>& causes);

}  // namespace gap
