#include "gap/drive/base/worth_asking.hpp"

#include <algorithm>

namespace gap {
namespace {

bool contains(const std::vector<const Described*>& asked, const Described& one) {
    return std::find(asked.begin(), asked.end(), &one) != asked.end();
}

}  // namespace

std::vector<const Described*> worth_asking(const std::vector<Described>& found) {
    const Described& front = found.front();
    std::vector<const Described*> asked = {&front};
    const auto add_first = [&](auto suits) {
        for (const Described& one : found) {  // the best first
            if (!contains(asked, one) && suits(one)) {
                asked.push_back(&one);
                return;
            }
        }
    };
    const auto alike = [&](const Described& one) { return (one.integrators > 0) == (front.integrators > 0); };
    // Where it was fitted and where it was not.
    const auto within = [&](const Described& one, double times) {
        return one.aside < times * front.aside && one.validation < times * front.validation;
    };
    // What a richer one makes of a bend fits the training, and elsewhere less well.
    const auto better_elsewhere = [&](const Described& one) {
        constexpr double clearly = 0.8;
        return one.validation < clearly * front.validation;
    };
    add_first([&](const Described& one) {
        return alike(one) && one.numbers < front.numbers && (within(one, 2.0) || better_elsewhere(one));
    });
    // A richer one that says nothing more would only say it again.
    const auto further = [&](const Described& one) {
        constexpr double more = 0.97;
        return one.aside < more * front.aside || one.validation < more * front.validation;
    };
    add_first([&](const Described& one) {
        return alike(one) && one.numbers > front.numbers && within(one, 1.2) && further(one);
    });
    add_first([&](const Described& one) { return !alike(one) && one.integrators < 2 && within(one, 1.6); });
    return asked;
}

const Described* with_one_lag_more(const std::vector<Described>& found, const Described& than) {
    const auto richer = std::find_if(found.begin(), found.end(), [&](const Described& one) {
        return one.integrators == than.integrators && one.numbers == than.numbers + 1;
    });
    return richer == found.end() ? nullptr : &*richer;
}

const Described* with_a_place(const std::vector<Described>& found, const std::vector<const Described*>& asked) {
    const auto two_lags = std::find_if(found.begin(), found.end(), [&](const Described& one) {
        return one.name == "second_order" || (one.name == "fractional_second_order" && !contains(asked, one));
    });
    return two_lags == found.end() ? nullptr : &*two_lags;
}

const Described* simplest_like(const std::vector<Described>& found, const Described& of) {
    const Described* simplest = &of;
    for (const Described& one : found) {
        if (one.integrators == of.integrators && one.numbers < simplest->numbers) {
            simplest = &one;
        }
    }
    return simplest;
}

}  // namespace gap
