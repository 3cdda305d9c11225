#include "gap/drive/outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gap/drive/moves.hpp"

namespace gap {
namespace {

constexpr double large = 0.03;        // of the greatest input: a move
constexpr double at_the_end = 0.02;   // of the record's length
constexpr double settling = 3.0;      // time constants
constexpr double incredible = 0.006;  // so few true events begin with the input by chance
constexpr double undone = 0.05;       // of the input: what a force may leave of it, or it may change
constexpr double unfelt = 0.05;       // of the largest event: it follows what the base leaves there

double length_of(const Record& record) { return record.time_s.back() - record.time_s.front(); }

// The large ones, the record's begin included.
std::vector<double> times_of_moves(const Record& record) {
    const auto [low, high] = std::ranges::minmax(record.input);
    std::vector<double> times_s;
    for (const Move& move : moves_of(record, 0.0, large * std::max(std::fabs(low), std::fabs(high)))) {
        times_s.push_back(move.at_s);
    }
    return times_s;
}

std::optional<double> number_of(const std::vector<FreeParameter>& own, const std::string& name) {
    const auto found = std::find_if(own.begin(), own.end(), [&](const FreeParameter& one) { return one.name == name; });
    return found == own.end() ? std::optional<double>() : found->value;
}

// A disturbance, or the first of some jumps; nothing: it was not found in this record.
std::optional<Happening> happening_of(const std::vector<FreeParameter>& own, const std::string& effect) {
    const auto from_s = number_of(own, effect + ".from_s");
    const auto at_s = number_of(own, effect + ".at_s");
    const auto size = number_of(own, effect + ".size");
    if ((!from_s && !at_s) || !size || *size == 0.0) {
        return std::nullopt;
    }
    return Happening{from_s ? *from_s : *at_s, number_of(own, effect + ".to_s")};
}

}  // namespace

double least_felt(const Effect& effect, const Candidate& trained, const Candidate& validated) {
    double largest = 0.0;
    for (const Candidate* candidate : {&trained, &validated}) {
        for (const auto& own : candidate->own) {
            for (const FreeParameter& one : own) {
                if (one.name.starts_with(effect.name + ".size")) {
                    largest = std::max(largest, std::fabs(one.value));
                }
            }
        }
    }
    return unfelt * largest;
}

double chance_of_meeting(const Record& record, double time_s, double delay_s) {
    const double length_s = length_of(record);
    std::vector<double> moves = times_of_moves(record);
    double nearest_s = length_s;
    for (double& move : moves) {
        move += delay_s;
        nearest_s = std::min(nearest_s, std::fabs(time_s - move));
    }
    nearest_s = std::max(nearest_s, 0.5 * record.usual_interval_s);
    double covered_s = 0.0;
    double until_s = 0.0;
    for (const double move : moves) {  // they rise
        const double from_s = std::max(until_s, move - nearest_s);
        const double to_s = std::min(length_s, move + nearest_s);
        covered_s += std::max(0.0, to_s - from_s);
        until_s = std::max(until_s, to_s);
    }
    return moves.empty() ? 1.0 : std::min(1.0, covered_s / length_s);
}

double joint_chance(std::span<const double> chances) {
    double product = 1.0;
    for (const double chance : chances) {
        product *= std::max(chance, 1e-12);
    }
    double term = product;
    double sum = 0.0;
    for (std::size_t k = 0; k < chances.size(); ++k) {
        sum += term;
        term *= -std::log(product) / static_cast<double>(k + 1);
    }
    return chances.empty() ? 1.0 : sum;
}

bool lasts_throughout(const Record& record, const Happening& happening, double settling_s) {
    const std::vector<double> moves = times_of_moves(record);
    const double first_s = moves.empty() ? 0.0 : moves.front();
    return happening.to_s && *happening.to_s > (1.0 - at_the_end) * length_of(record) &&
           happening.from_s < first_s + settling_s;
}

bool acts_before_the_input(const std::vector<FreeParameter>& own, const Happening& happening, double delay_s) {
    return happening.from_s < delay_s && std::any_of(own.begin(), own.end(), [](const FreeParameter& one) {
               return one.name == "initial_output" && !one.fixed;
           });
}

bool undoes_the_input(const Record& record, const drive::Model& model, const Happening& happening, double size) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < record.size(); ++i) {
        const double acts_s = record.time_s[i] - record.time_s.front() + model.delay_s;
        // The interval that a move begins or ends in belongs to neither side.
        if (happening.to_s && acts_s > happening.from_s + record.usual_interval_s &&
            acts_s < *happening.to_s - record.usual_interval_s) {
            low = std::min(low, model.gain * record.input[i]);
            high = std::max(high, model.gain * record.input[i]);
        }
    }
    const double force = 0.5 * (low + high);
    return high - low <= undone * std::fabs(force) && std::fabs(size + force) <= undone * std::fabs(force);
}

std::string doubt_of_events(const Study& study, const Candidate& trained, const Study& validation,
                            const Candidate& validated) {
    const drive::Model model = model_of(study.base.refit ? with_values(study.base.form, trained) : study.base.form);
    const double delay_s = model_of(study.base.form).delay_s;
    const double settling_s = delay_s + settling * study.scales.time_constant_s;
    for (const Effect* effect : trained.effects) {
        if (effect->kind != Kind::event) {
            continue;
        }
        const double least_size = least_felt(*effect, trained, validated);
        std::vector<double> chances;
        for (const auto& [of, candidate] : {std::pair(&study, &trained), std::pair(&validation, &validated)}) {
            for (std::size_t r = 0; r < candidate->own.size(); ++r) {
                const Record& record = of->courses[r].record();
                const auto happening = happening_of(candidate->own[r], effect->name);
                const double size = number_of(candidate->own[r], effect->name + ".size").value_or(0.0);
                const bool felt = std::fabs(size) >= least_size;
                if (happening && felt && lasts_throughout(record, *happening, settling_s)) {
                    return fmt::format("{} of {} begins with the input and is still there at the end", effect->name,
                                       record.name);
                }
                if (happening && felt && acts_before_the_input(candidate->own[r], *happening, delay_s)) {
                    return fmt::format("{} of {} begins before its input can act, as what was before the record does",
                                       effect->name, record.name);
                }
                if (happening && felt && effect->place == Place::plant &&
                    undoes_the_input(record, model, *happening, size)) {
                    return fmt::format("{} of {} undoes the input as long as it lasts", effect->name, record.name);
                }
                if (happening) {
                    chances.push_back(chance_of_meeting(record, happening->from_s, delay_s));
                }
            }
        }
        const double chance = joint_chance(chances);
        if (chance < incredible) {
            return fmt::format("{} begins with a move of the input in every record, by chance once in {:.2g}",
                               effect->name, 1.0 / chance);
        }
    }
    return "";
}

}  // namespace gap
