#include "drive/indices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/failure.hpp"

namespace drive {

Indices compute_indices(std::span<const double> time_s, std::span<const double> measured,
                        std::span<const double> modelled) {
    const std::size_t count = time_s.size();
    if (count < 2 || measured.size() != count || modelled.size() != count) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("expected equally many stamps, measured and modelled values, at least 2, found "
                        "{}, {} and {}",
                        count, measured.size(), modelled.size()));
    }
    const auto [lowest, highest] = std::minmax_element(measured.begin(), measured.end());
    if (*lowest == *highest) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("expected a measured output that moves, found {} throughout", *lowest));
    }
    const double samples = static_cast<double>(count);
    const double mean = std::accumulate(measured.begin(), measured.end(), 0.0) / samples;
    Indices indices;
    double squares = 0.0;
    double spread = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double error = measured[i] - modelled[i];
        squares += error * error;
        spread += (measured[i] - mean) * (measured[i] - mean);
        indices.max_error = std::max(indices.max_error, std::fabs(error));
        if (measured[i] == 0.0) {
            ++indices.max_ape_skipped;
        } else {
            indices.max_ape = std::max(indices.max_ape, std::fabs(error / measured[i]));
        }
        if (i + 1 < count) {
            const double next = measured[i + 1] - modelled[i + 1];
            const double t = time_s[i] - time_s[0];
            const double t_next = time_s[i + 1] - time_s[0];
            const double half = 0.5 * (t_next - t);
            indices.ise += half * (error * error + next * next);
            indices.iae += half * (std::fabs(error) + std::fabs(next));
            indices.itse += half * (t * error * error + t_next * next * next);
            indices.itae += half * (t * std::fabs(error) + t_next * std::fabs(next));
        }
    }
    indices.rmse = std::sqrt(squares / samples);
    indices.nrmse_printed = 1.0 - std::sqrt(squares) / (samples * (*highest - *lowest));
    indices.nrmse_fit = 1.0 - std::sqrt(squares) / std::sqrt(spread);
    return indices;
}

}  // namespace drive
