#include "glsum/design/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "glsum/logmemory/nested.hpp"
#include "glsum/weights.hpp"

namespace glsum::design {
namespace {

// The fewest blocks with which `taps` reach index `horizon`; `taps` if all of them are too few.
std::size_t fewest_blocks(std::size_t taps, std::size_t per_level, std::size_t horizon) {
    std::size_t reach = taps;  // each block takes the place of one tap
    std::size_t width = 2;
    std::size_t blocks = 0;
    for (; reach <= horizon && blocks < taps; ++blocks) {
        width *= blocks > 0 && blocks % per_level == 0 ? 2 : 1;
        reach += width - 1;
    }
    return reach > horizon ? blocks : taps;
}

}  // namespace

double error_of(const std::vector<double>& weights, std::size_t near_taps, const Blocks& blocks, std::size_t horizon) {
    double error = 0.0;
    std::size_t from = near_taps;
    std::size_t width = 2;
    for (std::size_t b = 0; b < blocks.count && from <= horizon; ++b) {
        width *= b > 0 && b % blocks.per_level == 0 ? 2 : 1;
        double sum = 0.0;
        for (std::size_t j = from; j < from + width; ++j) {
            sum += weights[j];
        }
        const double mean = sum / static_cast<double>(width);
        for (std::size_t j = from; j < std::min(from + width, horizon + 1); ++j) {
            error += std::fabs(weights[j] - mean);
        }
        from += width;
    }
    for (std::size_t j = from; j <= horizon; ++j) {
        error += std::fabs(weights[j]);
    }
    return error;
}

BlockDesign design_blocks(const Tail& tail, std::size_t taps) {
    const std::size_t horizon = tail.horizon;
    // The last block, which begins within the horizon, is no wider than all that lies before it and two more.
    std::vector<double> weights = {1.0};
    for (Weights walk(tail.order); weights.size() < 2 * (horizon + taps) + 4;) {
        walk.next();
        weights.push_back(walk.weight());
    }
    BlockDesign best{taps, {}, error_of(weights, taps, {}, horizon)};
    const auto consider = [&](std::size_t count, std::size_t per_level) {
        const Blocks blocks{count, per_level};
        const double error = error_of(weights, taps - count, blocks, horizon);
        if (error < best.error) {
            best = {taps - count, blocks, error};
        }
    };
    for (std::size_t per_level = 1; per_level < taps; per_level += per_level < 16 ? 1 : per_level / 8) {
        const std::size_t fewest = fewest_blocks(taps, per_level, horizon);
        if (per_level == 1) {
            for (std::size_t count = 1; count < std::min(fewest, taps); ++count) {
                consider(count, 1);
            }
        }
        if (fewest > 0 && fewest < taps) {
            consider(fewest, per_level);
        }
    }
    return best;
}

}  // namespace glsum::design
