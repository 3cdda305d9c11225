// What a sum stands for: the exact derivative, at some samples of a record.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "bench/sweep/discretisation.hpp"

namespace bench {

struct DerivativeLimit {
    std::size_t sample;  ///< k > 0
    double value;        ///< h^v / w_0 D^v x(t_k - lag h), in the unit of the sum
    bool late;           ///< in the record's second half, where the start of the signal has faded
};

/// At up to 200 samples, log-spaced over 1 ... samples - 1: dense where the signal's start still shows. Of noise and
/// drive, which have no formula, none. \param order  v in (-2, 2]
[[nodiscard]] std::vector<DerivativeLimit> derivative_limits(std::string_view signal, std::size_t samples, double order,
                                                             Discretisation weights = Discretisation::gl);

struct LimitError {
    double largest = 0.0;
    double late = 0.0;  ///< of the late ones
};

/// The largest magnitudes of `error(limit)`.
template <class Error>
[[nodiscard]] LimitError error_at(const std::vector<DerivativeLimit>& limits, Error error) {
    LimitError found;
    for (const DerivativeLimit& limit : limits) {
        const double here = std::fabs(error(limit));
        found.largest = std::max(found.largest, here);
        found.late = limit.late ? std::max(found.late, here) : found.late;
    }
    return found;
}

}  // namespace bench
