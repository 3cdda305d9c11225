#include "gap/drive/own_start.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace gap {
namespace {

double squares_in(const Study& study, const Candidate& candidate, std::size_t record) {
    const std::vector<double> residuals = residuals_of(study, candidate, record);
    double sum = 0.0;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        sum += study.counts[record][i] != 0 ? residuals[i] * residuals[i] : 0.0;
    }
    return sum;
}

}  // namespace

void begin_own(const Study& study, Candidate& candidate) {
    for (const Effect* effect : candidate.effects) {
        if (effect->kind == Kind::event) {
            continue;
        }
        for (const EffectParameter& named : effect->parameters(study.scales)) {
            for (std::size_t r = 0; named.of_record && r < candidate.own.size(); ++r) {
                const auto mine =
                    std::ranges::find(candidate.own[r], effect->name + "." + named.name, &FreeParameter::name);
                if (mine == candidate.own[r].end()) {
                    continue;
                }
                double best = mine->value;
                double least = squares_in(study, candidate, r);
                for (const double start : named.starts) {
                    mine->value = start;
                    if (const double left = squares_in(study, candidate, r); left < least) {
                        least = left;
                        best = start;
                    }
                }
                mine->value = best;
            }
        }
    }
}

void take_first_records(Candidate& candidate) {
    for (std::vector<FreeParameter>& numbers : candidate.lasting) {
        for (FreeParameter& number : numbers) {
            if (candidate.own.empty()) {
                return;
            }
            const auto first = std::ranges::find(candidate.own.front(), number.name, &FreeParameter::name);
            number.value = first == candidate.own.front().end() ? number.value : first->value;
        }
    }
}

}  // namespace gap
