#include "docs/site/facts/effects.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/failure.hpp"
#include "gap/drive/audit.hpp"
#include "gap/drive/candidate.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/drive/study.hpp"

namespace docs {
namespace {

using Values = std::vector<double>;

struct Plant {
    std::string words;
    drive::Model model;
    gap::Record record;
    // What some effects are told by is in the readings alone: rounded, repeated, folded ones.
    void (*read)(Values& readings) = nullptr;
};

void rounded(Values& readings) {
    for (double& y : readings) {
        y = 0.05 * std::nearbyint(y / 0.05);
    }
}

void repeated(Values& readings) {
    for (std::size_t i = 1; i < readings.size(); ++i) {
        readings[i] = i % 7 < 3 ? readings[i - 1] : readings[i];
    }
}

void without_sign(Values& readings) {
    for (double& y : readings) {
        y = std::fabs(y);
    }
}

void jumped(Values& readings) {
    const std::size_t from = readings.size() * 3 / 5;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const double noise = i % 2 == 0 ? 1e-3 : -1e-3;
        readings[i] += noise + (i < from ? 0.0 : 0.2);
    }
}

void wrapped(Values& readings) {
    const double turn = 2.0 * std::numbers::pi;
    for (double& y : readings) {
        y -= turn * std::floor(y / turn);
    }
}

// Rest, steps up and down, a slow and a fast slope, a swing that grows faster: what any of the effects shows itself in.
double input_at(double t_s) {
    if (t_s < 1.0) {
        return 0.0;
    }
    if (t_s < 5.0) {
        return 0.4;
    }
    if (t_s < 9.0) {
        return 1.0;
    }
    if (t_s < 13.0) {
        return 1.0 - 0.35 * (t_s - 9.0);
    }
    if (t_s < 16.0) {
        return -0.4;
    }
    if (t_s < 17.0) {
        return -0.4 + 0.9 * (t_s - 16.0);
    }
    if (t_s < 20.0) {
        return 0.5;
    }
    const double since = t_s - 20.0;
    return 0.7 * std::sin(2.0 * std::numbers::pi * (0.1 + 0.05 * since) * since);
}

gap::Record record_of(double low) {
    gap::Record record;
    record.name = "shown";
    record.usual_interval_s = 0.02;
    for (int k = 0; k <= 1600; ++k) {
        const double t_s = 0.02 * k;
        record.time_s.push_back(t_s);
        record.input.push_back(low < 0.0 ? input_at(t_s) : std::fabs(input_at(t_s)));
        record.output.push_back(0.0);
    }
    Values second;
    for (const double t_s : record.time_s) {
        second.push_back(std::fmod(t_s, 8.0) < 4.0 ? 0.0 : 1.0);
    }
    record.more_inputs = {second};
    return record;
}

std::vector<Plant> plants() {
    drive::Model arm;
    arm.denominator = {{0.25, 2.0}, {0.6, 1.0}, {1.0, 0.0}};
    arm.delay_s = 0.1;
    drive::Model fractional;
    fractional.denominator = {{0.4, 1.6}, {1.0, 0.7}, {1.0, 0.0}};
    fractional.sample_time_s = 0.02;
    drive::Model turning;
    turning.gain = 4.0;
    turning.denominator = {{0.3, 2.0}, {1.0, 1.0}};
    const std::string swings =
        "a lightly damped plant of second order, 1 / (0.25 s^2 + 0.6 s + 1), with a dead time of 0.1 s";
    const std::string turns = "a plant that turns on, 4 / (s (0.3 s + 1))";
    return {{swings, arm, record_of(-1.0)},
            {"a fractional plant, 1 / (0.4 s^1.6 + s^0.7 + 1), stepped at 50 Hz", fractional, record_of(-1.0)},
            {swings, arm, record_of(-1.0), jumped},
            {swings, arm, record_of(-1.0), rounded},
            {swings, arm, record_of(-1.0), repeated},
            {swings, arm, record_of(-1.0), without_sign},
            {turns, turning, record_of(0.0), wrapped}};
}

gap::Scenario scenario_of(const Plant& plant) {
    gap::Scenario scenario;
    scenario.model = plant.model;
    return scenario;
}

Values simulated(const Plant& plant, const gap::Effect* effect, const Values& values) {
    gap::Scenario scenario = scenario_of(plant);
    if (effect != nullptr) {
        effect->add_to(scenario, values);
    }
    return gap::simulate(scenario, gap::Course(plant.record, 4));
}

double rms_apart(const Values& one, const Values& other) {
    double squares = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        squares += (one[i] - other[i]) * (one[i] - other[i]);
    }
    return std::sqrt(squares / static_cast<double>(one.size()));
}

// One plant with what is simulated on it.
struct Stage {
    Plant plant;
    gap::Scales scales{};
    Values without;
    double deviation = 0.0;
};

Stage stage_of(Plant plant) {
    Stage stage{.plant = std::move(plant), .scales = {}, .without = {}};
    stage.without = simulated(stage.plant, nullptr, {});
    stage.plant.record.output = stage.without;
    if (stage.plant.read != nullptr) {
        stage.plant.read(stage.plant.record.output);
    }
    stage.deviation = gap::deviation_of({stage.plant.record});
    stage.scales = gap::scales_of(stage.plant.model, {stage.plant.record}, gap::audit({stage.plant.record}));
    return stage;
}

struct Example {
    Values values;
    Values with;
};

// An effect's own starts; of an event that the readings show, what it guesses from them.
std::vector<Values> candidates_of(const Stage& stage, const gap::Effect& effect) {
    if (effect.guess != nullptr && stage.plant.read != nullptr) {
        const gap::Scenario scenario = scenario_of(stage.plant);
        const gap::Course course(stage.plant.record, 4);
        Values residuals = stage.plant.record.output;
        std::ranges::transform(residuals, stage.without, residuals.begin(), std::minus());
        return {effect.guess({course, scenario, residuals, stage.scales})};
    }
    std::vector<Values> all;
    for (std::size_t start = 0; start < gap::starts_of(effect, stage.scales); ++start) {
        all.emplace_back();
        for (const gap::FreeParameter& parameter : gap::parameters_of(effect, stage.scales, start)) {
            all.back().push_back(parameter.value);
        }
    }
    return all;
}

std::optional<Example> example_of(const Stage& stage, const gap::Effect& effect) {
    std::optional<Example> best;
    double least = 0.0;
    for (Values& values : candidates_of(stage, effect)) {
        Values with = simulated(stage.plant, &effect, values);
        const double apart = rms_apart(with, stage.without) / stage.deviation;
        if (!std::isfinite(apart) || (apart == 0.0 && !effect.only_spreads)) {
            continue;
        }
        const double off = std::fabs(std::log((apart + 1e-6) / 0.2));
        if (!best || off < least) {
            best = {std::move(values), std::move(with)};
            least = off;
        }
    }
    return best;
}

using Column = Eigen::VectorXd;

Column change_of(const Stage& stage, const Values& with) {
    Column change(static_cast<Eigen::Index>(with.size()));
    for (std::size_t i = 0; i < with.size(); ++i) {
        change[static_cast<Eigen::Index>(i)] = with[i] - stage.without[i];
    }
    return change;
}

struct Change {
    const gap::Effect* effect;
    Column column;
};

double cosine(const Column& one, const Column& other) {
    const double both = one.norm() * other.norm();
    return both > 0.0 ? std::fabs(one.dot(other)) / both : 0.0;
}

// Of the changes on one stage: what a fitted base leaves of each.
class Remainders {
public:
    explicit Remainders(const std::vector<Change>& changes) {
        std::vector<Column> taken;
        for (const Change& change : changes) {
            if (change.effect->of_fitted_base && change.column.norm() > 0.0) {
                taken.push_back(change.column.normalized());
            }
        }
        base_.resize(taken.empty() ? 0 : taken.front().size(), static_cast<Eigen::Index>(taken.size()));
        for (std::size_t i = 0; i < taken.size(); ++i) {
            base_.col(static_cast<Eigen::Index>(i)) = taken[i];
        }
    }
    [[nodiscard]] Column of(const Column& change) const {
        if (base_.cols() == 0) {
            return change;
        }
        const Column left = change - base_ * base_.colPivHouseholderQr().solve(change);
        return left.norm() > 1e-6 * change.norm() ? left : Column::Zero(change.size());
    }

private:
    Eigen::MatrixXd base_;
};

std::vector<std::pair<std::string, double>> alike(const Change& one, const std::vector<Change>& all,
                                                  const Remainders& remainders) {
    std::vector<std::pair<std::string, double>> found;
    for (const Change& other : all) {
        if (other.effect == one.effect) {
            continue;
        }
        const bool whole = one.effect->of_fitted_base || other.effect->of_fitted_base;
        const double share =
            whole ? cosine(one.column, other.column) : cosine(remainders.of(one.column), remainders.of(other.column));
        if (share >= 0.8) {
            found.emplace_back(other.effect->name, std::min(1.0, share));
        }
    }
    std::ranges::sort(found, std::greater(), &std::pair<std::string, double>::second);
    return found;
}

std::vector<gap::Written> written(const gap::Effect& effect, const Stage& stage, const Values& values) {
    const std::vector<gap::EffectParameter> parameters = effect.parameters(stage.scales);
    std::vector<gap::Fitted> numbers;
    for (std::size_t i = 0; i < values.size(); ++i) {
        numbers.push_back({values[i], values[i], values[i], parameters[i].unit});
    }
    return effect.to_contract(effect, numbers);
}

}  // namespace

std::vector<ShownEffect> shown_effects() {
    std::vector<std::optional<ShownEffect>> shown(gap::effects().size());
    for (Plant& plant : plants()) {
        const Stage stage = stage_of(std::move(plant));
        std::vector<Change> changes;
        std::vector<std::size_t> here;
        for (std::size_t i = 0; i < gap::effects().size(); ++i) {
            const gap::Effect& effect = *gap::effects()[i];
            if (!gap::applies(effect, stage.scales)) {
                continue;
            }
            std::optional<Example> example = example_of(stage, effect);
            if (!example) {
                continue;
            }
            changes.push_back({&effect, change_of(stage, example->with)});
            if (!shown[i]) {
                shown[i] = ShownEffect{&effect,
                                       stage.plant.words,
                                       written(effect, stage, example->values),
                                       stage.plant.record.time_s,
                                       stage.plant.record.input,
                                       stage.without,
                                       std::move(example->with),
                                       {}};
                here.push_back(i);
            }
        }
        const Remainders remainders(changes);
        for (const std::size_t i : here) {
            const auto mine = std::ranges::find(changes, shown[i]->effect, &Change::effect);
            shown[i]->alike = alike(*mine, changes, remainders);
        }
    }
    std::vector<ShownEffect> all;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!shown[i]) {
            throw glsum::Failure(glsum::Exit::check_failed,
                                 gap::effects()[i]->name + ": none of the plants of docs/site can have it");
        }
        all.push_back(std::move(*shown[i]));
    }
    return all;
}

}  // namespace docs
