// The reading jumps by a size at a time and stays off; up to three times in a record.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

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

// Greedily: the place at which a step, laid over the residuals, takes most of their squares, until a further one takes
// less than a twentieth of what is left.
std::vector<double> guess(const Clue& clue) {
    std::vector<double> left(clue.residuals.begin(), clue.residuals.end());
    std::vector<double> found;
    const Record& record = clue.course.record();
    for (std::size_t jump = 0; jump < most_jumps; ++jump) {
        double squares = 0.0;
        double behind = 0.0;
        double most = 0.0;
        std::size_t at = 0;
        for (std::size_t i = left.size(); i-- > 1;) {
            behind += left[i];
            squares += left[i] * left[i];
            const double taken = behind * behind / static_cast<double>(left.size() - i);
            if (taken > most) {
                most = taken;
                at = i;
            }
        }
        if (!(most > 0.05 * squares)) {
            found.insert(found.end(), {0.0, 0.0});
            continue;
        }
        double size = 0.0;
        for (std::size_t i = at; i < left.size(); ++i) {
            size += left[i] / static_cast<double>(left.size() - at);
        }
        for (std::size_t i = at; i < left.size(); ++i) {
            left[i] -= size;
        }
        const double half_before_s = 0.5 * (record.time_s[at] + record.time_s[at - 1]) - record.time_s.front();
        found.insert(found.end(), {half_before_s, size});
    }
    return found;
}

}  // namespace

const Effect& missed_counts() {
    static const Effect effect{"missed_counts", Kind::event, parameters, add, {}, guess};
    return effect;
}

}  // namespace gap
