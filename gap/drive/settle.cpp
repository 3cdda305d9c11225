#include "gap/drive/settle.hpp"

#include <algorithm>
#include <cmath>

#include "gap/drive/cost.hpp"
#include "gap/drive/fit.hpp"

namespace gap {
namespace {

constexpr int parts = 100;               // of a number's range
constexpr double the_same = 1.0 + 1e-4;  // times the cost
constexpr double wide = 0.02;            // of its range: less is no matter

// How far towards a bound a number may go while training says nothing. The bound itself is tried, too: it may be none.
double as_far_as_untold(const Study& study, Candidate& candidate, FreeParameter& number, double bound) {
    const double value = number.value;
    const double step = (number.upper - number.lower) / parts * (bound > value ? 1.0 : -1.0);
    const double most = the_same * candidate.cost;
    double far = value;
    for (int i = 1; i <= parts; ++i) {
        number.value = std::clamp(value + i * step, number.lower, number.upper);
        if (number.value == far || !(cost_of(study, candidate, nullptr) <= most)) {
            break;
        }
        far = number.value;
    }
    number.value = value;
    return far;
}

// \param carried  the candidate on the validation records
double best_within(const Study& validation, Candidate& carried, FreeParameter& number, double low, double high) {
    constexpr int places = 12;
    double best = number.value;
    double least = cost_of(validation, carried, nullptr);
    for (double reach = 0.5 * (high - low), middle = low + reach; reach > 1e-3 * (high - low); reach /= places / 2.0) {
        for (int i = -places; i <= places; ++i) {
            number.value = std::clamp(middle + reach * i / places, low, high);
            const double cost = cost_of(validation, carried, nullptr);
            if (cost < least) {
                least = cost;
                best = number.value;
            }
        }
        middle = best;
    }
    return best;
}

}  // namespace

Settled settle(const Study& study, const Study& validation, const Candidate& trained) {
    Settled settled{trained, 0};
    Candidate& mine = settled.trained;
    Candidate carried;
    mine.cost = cost_of(study, mine, nullptr);
    std::vector<std::vector<EffectParameter>> named;
    for (const Effect* effect : mine.effects) {
        if (effect->kind == Kind::lasting) {
            named.push_back(effect->parameters(study.scales));
        }
    }
    for (std::size_t e = 0; e < mine.lasting.size() && std::isfinite(mine.cost); ++e) {
        for (std::size_t n = 0; n < mine.lasting[e].size(); ++n) {
            FreeParameter& number = mine.lasting[e][n];
            if (number.fixed) {
                continue;
            }
            const double low = as_far_as_untold(study, mine, number, number.lower);
            const double high = as_far_as_untold(study, mine, number, number.upper);
            // What may as well be none is not told by training at all.
            const bool may_be_none = low <= named[e][n].none && named[e][n].none <= high;
            if (may_be_none || high - low < wide * (number.upper - number.lower)) {
                continue;
            }
            if (carried.own.empty()) {
                carried = carried_over(validation, mine, nullptr);
            }
            FreeParameter& there = carried.lasting[e][n];
            there.value = best_within(validation, carried, there, low, high);
            number.value = there.value;
            ++settled.numbers;
        }
    }
    return settled;
}

}  // namespace gap
