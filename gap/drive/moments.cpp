#include "gap/drive/moments.hpp"

namespace gap {

Moments moments_of(std::span<const double> x, std::span<const double> y) {
    const auto count = static_cast<double>(x.size());
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    Moments sums;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sums.xx += (x[i] - mean_x) * (x[i] - mean_x);
        sums.xy += (x[i] - mean_x) * (y[i] - mean_y);
        sums.yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    return sums;
}

}  // namespace gap
