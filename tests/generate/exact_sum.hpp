// The taps and modes of a design over real numbers, in long double: what the rounding of a kernel is held against.
#pragma once

#include <cstddef>
#include <vector>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

class ExactSum {
public:
    explicit ExactSum(const glsum::Design& design) {
        glsum::Weights weights(design);
        for (std::size_t j = 1; j + 2 * design.modes.size() < design.taps; ++j) {
            weights.next();
            taps_.push_back(weights.weight());
        }
        modes_.assign(design.modes.begin(), design.modes.end());
        past_.assign(taps_.size(), 0.0L);
        states_.assign(modes_.size(), 0.0L);
    }
    long double step(long double newest) {
        long double sum = newest;
        for (std::size_t j = 0; j < taps_.size(); ++j) {
            sum += static_cast<long double>(taps_[j]) * past_[j];
        }
        past_.insert(past_.begin(), newest);
        const long double leaving = past_.at(taps_.size());
        for (std::size_t m = 0; m < modes_.size(); ++m) {
            const long double decay = modes_[m].decay;
            sum += static_cast<long double>(modes_[m].weight) / decay * states_[m];
            states_[m] += decay * (leaving - states_[m]);
        }
        past_.pop_back();
        return sum;
    }

private:
    std::vector<double> taps_;  // behind the first
    std::vector<glsum::Mode> modes_;
    std::vector<long double> past_;
    std::vector<long double> states_;
};
