// The reading jumps by a size at a time and stays off; up to three times in a record.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/failure.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/drive/white_noise.hpp"

namespace gap {

const Effect& missed_counts();

namespace {

constexpr std::size_t most_jumps = 3;

std::vector<EffectParameter> parameters(const Scales& scales) {
    std::vector<EffectParameter> all;
    for (std::size_t jump = 0; jump < most_jumps; ++jump) {
        const std::string number = jump == 0 ? "" : std::to_string(jump + 1);
        // A time between two samples moves nothing: the guess is what counts.
        all.push_back({"at" + number + "_s", "s", 0.0, scales.length_s, 0.0, {0.0}, true});
        all.push_back({"size" + number, "y", -scales.output_span, scales.output_span, 0.0, {0.0}});
    }
    return all;
}

void add(Scenario& scenario, std::span<const double> values) {
    const std::vector<double> own(values.begin(), values.end());
    scenario.logger.emplace_back([own](std::span<double> reading, const Record& record) {
        for (std::size_t jump = 0; jump < own.size(); jump += 2) {
            for (std::size_t i = 0; i < reading.size() && own[jump] > 0.0; ++i) {
                reading[i] += record.time_s[i] - record.time_s.front() >= own[jump] ? own[jump + 1] : 0.0;
            }
        }
    });
}

double noise_of(std::span<const double> residuals) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
        steps.push_back(std::fabs(residuals[i] - residuals[i - 1]));
    }
    return noise_by_differences(std::move(steps), 1);
}

// A count is missed at once, so that a jump shows between neighbours: half of its size at least, by the means of as
// many samples before and behind as noise asks for. What only grows to that size is no missed count. Where noise asks
// for more samples than `most_neighbours`, nothing is seen, and nothing is refused.
bool is_seen(std::span<const double> residuals, std::size_t at, double size, double noise) {
    constexpr double most_neighbours = 40.0;
    const double wanted = std::ceil(128.0 * noise * noise / (size * size));  // a deviation of size / 8
    if (wanted > most_neighbours) {
        return true;
    }
    const std::size_t count = std::min({static_cast<std::size_t>(std::max(1.0, wanted)), at, residuals.size() - at});
    const auto mean_from = [&](std::size_t first) {
        const std::span<const double> those = residuals.subspan(first, count);
        return std::accumulate(those.begin(), those.end(), 0.0) / static_cast<double>(count);
    };
    return (mean_from(at) - mean_from(at - count)) / size >= 0.5;
}

// Greedily: the place at which a step, laid over the residuals, takes most of their squares, of those where a jump is
// seen, until a further one takes less than a twentieth of what is left.
std::vector<double> guess(const Clue& clue) {
    std::vector<double> left(clue.residuals.begin(), clue.residuals.end());
    std::vector<double> found;
    const Record& record = clue.course.record();
    const double noise = noise_of(left);
    for (std::size_t jump = 0; jump < most_jumps; ++jump) {
        double squares = 0.0;
        double behind = 0.0;
        double most = 0.0;
        double size = 0.0;
        std::size_t at = 0;
        for (std::size_t i = left.size(); i-- > 1;) {
            behind += left[i];
            squares += left[i] * left[i];
            const double mean = behind / static_cast<double>(left.size() - i);
            if (behind * mean > most && is_seen(left, i, mean, noise)) {
                most = behind * mean;
                size = mean;
                at = i;
            }
        }
        if (!(most > 0.05 * squares)) {
            found.insert(found.end(), {0.0, 0.0});
            continue;
        }
        for (std::size_t i = at; i < left.size(); ++i) {
            left[i] -= size;
        }
        const double half_before_s = 0.5 * (record.time_s[at] + record.time_s[at - 1]) - record.time_s.front();
        found.insert(found.end(), {half_before_s, size});
    }
    return found;
}

// The jumps that there were, as two lists.
std::vector<Written> to_contract(const Effect&, std::span<const Fitted> fitted) {
    std::vector<double> times;
    std::vector<double> sizes;
    std::vector<std::pair<double, double>> time_intervals;
    std::vector<std::pair<double, double>> size_intervals;
    for (std::size_t jump = 0; jump < fitted.size(); jump += 2) {
        if (fitted[jump].value > 0.0) {
            times.push_back(fitted[jump].value);
            time_intervals.emplace_back(fitted[jump].low, fitted[jump].high);
            sizes.push_back(fitted[jump + 1].value);
            size_intervals.emplace_back(fitted[jump + 1].low, fitted[jump + 1].high);
        }
    }
    return {{"at_s", times, time_intervals, "s"}, {"sizes", sizes, size_intervals, "y"}};
}

std::vector<double> from_contract(const Effect&, const Contracted& contracted) {
    const std::vector<double>& times = list_in(contracted, "at_s");
    const std::vector<double>& sizes = list_in(contracted, "sizes");
    if (times.size() != sizes.size() || contracted.size() != 2) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             "missed_counts: expected at_s and sizes, as many of the one as of the other");
    }
    std::vector<double> values;
    for (std::size_t jump = 0; jump < times.size(); ++jump) {
        values.push_back(times[jump]);
        values.push_back(sizes[jump]);
    }
    return values;
}

}  // namespace

const Effect& missed_counts() {
    static const Effect effect{
        .name = "missed_counts",
        .kind = Kind::event,
        .parameters = parameters,
        .add_to = add,
        .guess = guess,
        .place = Place::sensor,
        .numbers = {{"at_s"}, {"size"}, {"at2_s"}, {"size2"}, {"at3_s"}, {"size3"}},
        .domains = {Domain::mechanical, Domain::electric},  // levels and temperatures are not counted
        .to_contract = to_contract,
        .from_contract = from_contract,
    };
    return effect;
}

}  // namespace gap
