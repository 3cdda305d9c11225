#include "gap/drive/jitter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gap/drive/clipped.hpp"

namespace gap {
namespace {

// d reading / dt of the simulation at the stamps.
std::vector<double> speed_of(const Record& record, std::span<const double> residuals) {
    const std::size_t size = record.size();
    std::vector<double> speed(size);
    const auto simulated = [&](std::size_t i) { return record.output[i] - residuals[i]; };
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t from = i == 0 ? 0 : i - 1;
        const std::size_t to = std::min(size - 1, i + 1);
        speed[i] = (simulated(to) - simulated(from)) / (record.time_s[to] - record.time_s[from]);
    }
    return speed;
}

std::vector<FreeParameter>* jitter_of(Candidate& candidate) {
    std::size_t at = 0;
    for (const Effect* effect : candidate.effects) {
        if (effect->only_spreads) {
            return &candidate.lasting[at];
        }
        at += effect->kind == Kind::lasting ? 1 : 0;
    }
    return nullptr;
}

// Whether what is left, as far as it goes with the speed, is as coloured from sample to sample as no jitter is.
bool is_coloured(std::span<const double> residuals, std::span<const double> speed) {
    double along = 0.0;
    double square = 0.0;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
        along += residuals[i] * speed[i] * residuals[i - 1] * speed[i - 1];
        square += residuals[i] * speed[i] * residuals[i] * speed[i];
    }
    return along > 0.3 * square;
}

// Variances in units of the whitener's: noise_share and what an even shift of the time makes of a speed.
std::vector<double> spreads(std::span<const double> speed, const Whitener& whitener, double half_width_s,
                            double noise_share) {
    double weight = 1.0;
    for (const double c : whitener.coefficients) {
        weight += c * c;  // the shifts of neighbours do not know of each other
    }
    std::vector<double> spread(speed.size());
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const double by = half_width_s * speed[i] / whitener.deviation;
        spread[i] = std::sqrt(noise_share + weight * by * by / 3.0);
    }
    return spread;
}

}  // namespace

std::vector<double> spread_of(const Study& study, const Candidate& candidate, std::size_t record,
                              std::span<const double> residuals, const Whitener& whitener) {
    Candidate copy = candidate;
    const auto* jitter = jitter_of(copy);
    if (jitter == nullptr) {
        return {};
    }
    const Record& read = study.courses[record].record();
    std::vector<double> spread = spreads(speed_of(read, residuals), whitener, (*jitter)[0].value, (*jitter)[1].value);
    const std::vector<char> clipped = clipped_readings(read);
    for (std::size_t i = 0; i < spread.size(); ++i) {
        spread[i] = clipped[i] != 0 ? 1.0 : spread[i];
    }
    return spread;
}

void fit_jitter(const Study& study, Candidate& candidate, const Whitener& whitener) {
    std::vector<FreeParameter>* jitter = jitter_of(candidate);
    if (jitter == nullptr) {
        return;
    }
    const auto residuals = all_residuals(study, candidate);
    std::vector<std::vector<double>> speeds;
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        speeds.push_back(speed_of(study.courses[r].record(), residuals[r]));
    }
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        if (is_coloured(residuals[r], speeds[r])) {
            (*jitter)[0].value = 0.0;
            (*jitter)[1].value = 1.0;
            return;
        }
    }
    // What a sensor's end holds has no noise, whenever it was read: that the rest has some is no jitter.
    std::vector<std::vector<char>> clipped;
    for (const Course& course : study.courses) {
        clipped.push_back(clipped_readings(course.record()));
    }
    // Normal, not heavy-tailed: the width is a second moment's.
    std::vector<std::vector<double>> white;
    for (const auto& record : residuals) {
        white.push_back(whitener.apply(record));
    }
    const auto likelihood = [&](double half_width_s, double noise_share) {
        double sum = 0.0;
        for (std::size_t r = 0; r < white.size(); ++r) {
            const auto spread = spreads(speeds[r], whitener, half_width_s, noise_share);
            for (std::size_t i = whitener.coefficients.size(); i < spread.size(); ++i) {
                const double size = white[r][i] / spread[i];
                sum -= study.counts[r][i] != 0 && clipped[r][i] == 0 ? 0.5 * size * size + std::log(spread[i]) : 0.0;
            }
        }
        return sum;
    };
    constexpr double shares[] = {0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1.0};
    double best = -std::numeric_limits<double>::infinity();
    const auto try_width = [&](double half_width_s) {
        for (const double share : shares) {
            const double value = likelihood(half_width_s, share);
            if (value > best) {
                best = value;
                (*jitter)[0].value = half_width_s;
                (*jitter)[1].value = share;
            }
        }
    };
    const double widest = (*jitter)[0].upper;
    for (double width = widest; width > 1e-3 * widest; width *= 0.7) {
        try_width(width);
    }
    for (double factor = 1.2; factor > 1.01; factor = std::sqrt(factor)) {
        const double centre = (*jitter)[0].value;
        try_width(centre * factor);
        try_width(centre / factor);
    }
    constexpr double clear = 4.0;
    if (best < likelihood(0.0, 1.0) + clear) {  // the training records hardly know of any
        (*jitter)[0].value = 0.0;
        (*jitter)[1].value = 1.0;
        return;
    }
    // 95 %: where the logarithm of the likelihood has fallen by 1.92.
    constexpr double fall = 1.92;
    FreeParameter& width = (*jitter)[0];
    FreeParameter& share = (*jitter)[1];
    double low = width.value;
    double high = width.value;
    while (low > 1e-3 * width.value && likelihood(low, share.value) > best - fall) {
        low *= 0.98;
    }
    while (high < 3.0 * width.value && likelihood(high, share.value) > best - fall) {
        high *= 1.02;
    }
    width.deviation = 0.5 * (high - low) / 1.96;
    width.low = low;
    width.high = std::min(high, width.upper);
    share.low = share.high = share.value;
    for (const double tried : shares) {
        if (likelihood(width.value, tried) > best - fall) {
            share.low = std::min(share.low, tried);
            share.high = std::max(share.high, tried);
        }
    }
}

std::vector<double> without_jitter(const Study& study, const Candidate& candidate, std::size_t record,
                                   std::span<const double> residuals, const Whitener& whitener) {
    Candidate copy = candidate;
    const auto* jitter = jitter_of(copy);
    std::vector<double> left(residuals.begin(), residuals.end());
    if (jitter == nullptr || (*jitter)[0].value == 0.0) {
        return left;
    }
    const double half_width_s = (*jitter)[0].value;
    const double noise = whitener.stationary_deviation * whitener.stationary_deviation * (*jitter)[1].value;
    const std::vector<double> speed = speed_of(study.courses[record].record(), residuals);
    for (std::size_t i = 0; i < left.size(); ++i) {
        const double moved = speed[i] * speed[i] * half_width_s * half_width_s / 3.0;
        const double shift_s =
            speed[i] != 0.0 ? std::clamp(left[i] / speed[i] * moved / (moved + noise), -half_width_s, half_width_s)
                            : 0.0;
        left[i] -= speed[i] * shift_s;
    }
    return left;
}

}  // namespace gap
