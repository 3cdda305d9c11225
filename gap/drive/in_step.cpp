#include "gap/drive/in_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gap/drive/moves.hpp"

namespace gap {
namespace {

constexpr double as_far = 0.02;
constexpr double same_level = 0.03;  // of the input's span

}  // namespace

std::optional<double> input_period_s(const Record& record) {
    const auto [low, high] = std::ranges::minmax(record.input);
    const double same = same_level * (high - low);
    const std::vector<Move> moves = moves_of(record, record.input.front(), same);
    std::vector<double> apart_s;
    for (auto move = moves.begin(); move != moves.end(); ++move) {
        const auto again = std::find_if(move + 1, moves.end(), [&](const Move& later) {
            return std::fabs(later.from - move->from) <= same && std::fabs(later.to - move->to) <= same;
        });
        if (again != moves.end()) {
            apart_s.push_back(again->at_s - move->at_s);
        }
    }
    if (apart_s.size() < 2) {
        return std::nullopt;
    }
    const auto [least, most] = std::ranges::minmax(apart_s);
    return most - least <= as_far * most ? std::optional(0.5 * (least + most)) : std::nullopt;
}

std::string in_step_with_input(const Study& study, const Candidate& trained) {
    for (const Effect* effect : trained.effects) {
        if (effect->period_s == nullptr) {
            continue;
        }
        const double period_s = effect->period_s(values_of(*trained.numbers_of(effect)));
        for (const Course& course : study.courses) {
            const std::optional<double> of_input_s = input_period_s(course.record());
            if (of_input_s && std::fabs(period_s - *of_input_s) <= as_far * *of_input_s) {
                return fmt::format("{} comes again every {:.4g} s, as the input's moves do: it is the drive's own",
                                   effect->name, period_s);
            }
        }
    }
    return "";
}

}  // namespace gap
