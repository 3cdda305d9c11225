// An outside force for a time.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

namespace gap {

const Effect& load_disturbance();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    return {{"from_s", "s", 0.0, scales.length_s, 0.0, {0.35 * scales.length_s}},
            {"to_s", "s", 0.0, scales.length_s, 0.0, {0.5 * scales.length_s}},
            {"size", "rhs", -scales.force, scales.force, 0.0, {0.05 * scales.force}}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.forces.pushes.push_back({values[0], values[1], values[2]});
}

// What a force that begins at each of some times and stays does to the model, from one simulation; the difference of
// two that takes most of the residuals' squares.
std::vector<double> guess(const Clue& clue) {
    const Record& record = clue.course.record();
    const double length_s = record.time_s.back() - record.time_s.front();
    Scenario pushed;
    pushed.model = clue.scenario.model;
    pushed.model.gain = 0.0;
    pushed.forces.pushes.push_back({0.0, 2.0 * length_s, clue.scales.force});
    const std::vector<double> response = clue.course.nodes_of(pushed);
    constexpr int places = 40;
    std::vector<std::vector<double>> begun;
    for (int place = 0; place <= places; ++place) {
        std::vector<double> times_s = record.time_s;
        for (double& t : times_s) {
            t -= length_s * place / places;
        }
        begun.push_back(read_at(clue.course.grid(), response, times_s));
        for (std::size_t i = 0; i < times_s.size(); ++i) {
            begun.back()[i] = times_s[i] <= record.time_s.front() ? 0.0 : begun.back()[i];
        }
    }
    std::vector<double> with_left(begun.size(), 0.0);
    for (std::size_t a = 0; a < begun.size(); ++a) {
        for (std::size_t i = 0; i < clue.residuals.size(); ++i) {
            with_left[a] += begun[a][i] * clue.residuals[i];
        }
    }
    double most = 0.0;
    std::vector<double> best = {0.35 * length_s, 0.5 * length_s, 0.0};
    for (std::size_t a = 0; a + 1 < begun.size(); ++a) {
        for (std::size_t b = a + 1; b < begun.size(); ++b) {
            double square = 0.0;
            for (std::size_t i = 0; i < clue.residuals.size(); ++i) {
                const double by = begun[a][i] - begun[b][i];
                square += by * by;
            }
            const double along = with_left[a] - with_left[b];
            if (square > 0.0 && along * along / square > most) {
                most = along * along / square;
                best = {length_s * static_cast<double>(a) / places, length_s * static_cast<double>(b) / places,
                        along / square * clue.scales.force};
            }
        }
    }
    return best;
}

}  // namespace

const Effect& load_disturbance() {
    static const Effect effect{
        .name = "load_disturbance",
        .kind = Kind::event,
        .parameters = parameters,
        .add_to = add,
        .guess = guess,
        .place = Place::plant,
        .numbers = {{"from_s"}, {"to_s"}, {"size"}},
    };
    return effect;
}

}  // namespace gap
