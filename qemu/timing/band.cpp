#include "qemu/timing/band.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace timing {

Band band_of(const CoreFile& core, std::span<const std::int64_t> figures, std::int64_t guessed) {
    const auto nominal = static_cast<double>(figures[0]);
    double low = nominal;
    double high = nominal;
    double furthest = 0.0;  // of the set without fitted rules, too
    for (std::size_t s = 0; s < figures.size(); ++s) {
        const auto figure = static_cast<double>(figures[s]);
        furthest = std::max(furthest, std::abs(figure - nominal));
        if (core.sets[s].fits) {
            low = std::min(low, figure);
            high = std::max(high, figure);
        }
    }
    const double published = static_cast<double>(core.sets[0].figures.band_published_permille) / 1000.0;
    const double fitted = static_cast<double>(core.sets[0].figures.band_fitted_permille) / 1000.0;
    const double in_doubt =
        furthest + static_cast<double>(core.sets[0].figures.band_predicted_permille * guessed) / 1000.0;
    const double share = nominal > 0.0 ? in_doubt / nominal : 0.0;
    const double margin = std::min(published + share, std::max(fitted, published));
    const double middle = (low + high) / 2.0;
    const double widest = std::max(fitted, margin) * nominal;
    const double half = std::min((high - low) / 2.0 + margin * middle, widest);
    const double centre = std::clamp(middle, nominal - half, nominal + half);
    // Outward to whole units, but not past the widest, which is a limit of the band as it is printed. Of a figure so
    // short that no unit has room within it, one unit is.
    low = std::max(std::floor(centre - half), std::min(std::ceil(centre - widest), nominal - 1.0));
    high = std::min(std::ceil(centre + half), std::max(std::floor(centre + widest), nominal + 1.0));
    return {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)};
}

}  // namespace timing
