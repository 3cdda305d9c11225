// Which further bases are asked, once what was found beside the best ones is known.
#include "gap/drive/beside_found_base.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gap/drive/base/find.hpp"

namespace {

using gap::Outcome;
using testing::ElementsAre;

// Steps a plant on by `dt` and says its output.
using Plant = std::function<double(double u, double dt)>;

constexpr double interval_s = 0.1;

gap::Record logged(const Plant& plant, const std::function<double(double)>& input, unsigned seed) {
    constexpr int substeps = 200;
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    double y = plant(0.0, 0.0);
    for (int k = 0; k < 900; ++k) {
        record.time_s.push_back(interval_s * k);
        record.input.push_back(input(record.time_s.back()));
        record.output.push_back(y + noise(engine));
        for (int i = 0; i < substeps; ++i) {
            y = plant(record.input.back(), interval_s / substeps);
        }
    }
    return record;
}

double levels(double time_s) {
    constexpr double held[] = {0.0, 1.0, 0.3, 0.8, -0.5, 0.6, -1.0, 0.2, 0.9, -0.3, 0.5, 0.0};
    return held[static_cast<int>(time_s / 5.0) % 12];
}
double other_levels(double time_s) { return 0.9 * levels(7.0 + 1.7 * time_s); }
double on_off(double time_s) { return static_cast<int>(time_s / 15.0) % 2 == 1 ? 1.0 : 0.0; }

// What it names beside which base, of these effects.
struct Told {
    std::vector<std::string> effects;
    std::string base;
};
Told told_of(const std::function<Plant()>& plant, const std::function<double(double)>& training, gap::Domain domain,
             const std::set<std::string>& listed) {
    gap::Question question{gap::form_to_find(),
                           true,
                           {logged(plant(), training, 1)},
                           {logged(plant(), other_levels, 2)},
                           {},
                           gap::Metric::simulation,
                           {},
                           2};
    question.find = true;
    question.domain = domain;
    for (const gap::Effect* effect : gap::effects()) {
        if (!listed.contains(effect->name)) {
            question.without.push_back(effect->name);
        }
    }
    const gap::Answer answer = gap::answer_beside_found_base(question, [](const std::string&) {});
    Told told{{}, answer.base_name};
    if (answer.decision.outcome == Outcome::attributed) {
        for (const gap::Effect* effect : answer.chosen().trained.effects) {
            told.effects.push_back(effect->name);
        }
    }
    return told;
}

// Its own lag is a hundredth of the damper's: no record tells it, and beside one lag no spring is asked for.
TEST(FurtherBase, FindsASpringWhereTheMassIsTooSmallToTell) {
    const auto plant = [] {
        return [y = 0.0, speed = 0.0](double u, double dt) mutable {
            speed += dt * (u - y - 2.0 * y * y * y - speed) / 0.01;
            return y += dt * speed;
        };
    };
    const Told told = told_of(plant, levels, gap::Domain::mechanical, {"cubic_stiffness", "quadratic_drag"});
    EXPECT_THAT(told.effects, ElementsAre("cubic_stiffness"));
    EXPECT_EQ(told.base, "second_order");
}

// Ramps that are all alike are three lags' as well, until the steps have another size.
TEST(FurtherBase, AsksTheSimplestBaseWhereARicherOneHasBentToTheEffect) {
    const auto plant = [] {
        return [y = 0.0, w = 0.0](double u, double dt) mutable {
            w += std::clamp(u - w, -0.25 * dt, 0.25 * dt);
            return y += dt * (w - y) / 2.0;
        };
    };
    const Told told = told_of(plant, on_off, gap::Domain::thermal, {"rate_limit"});
    EXPECT_THAT(told.effects, ElementsAre("rate_limit"));
    EXPECT_EQ(told.base, "first_order");
}

}  // namespace
