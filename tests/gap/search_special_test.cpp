// Beside a fitted form few partners of each lead are fitted to the end: special cases of the best set are fitted, too,
// so that what is named can be the simpler one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "gap/drive/search.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::Contains;

using Set = std::set<std::string>;

gap::Record read(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2e-3);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 400; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(i % 20 == 0 ? even(engine) : record.input.back());
        record.output.push_back(0.0);
    }
    gap::Scenario scenario;
    scenario.model = drive::make_fopdt(2.0, 1.0, 0.0);
    gap::effect_named("backlash").add_to(scenario, std::vector{0.3});
    gap::effect_named("direction_asymmetry").add_to(scenario, std::vector{0.4, 0.0});
    record.output = gap::simulate(scenario, gap::Course(record, 8));
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

TEST(SearchBesideAForm, FitsTheSpecialCasesOfTheBestSet) {
    gap::Question question{
        gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), true, {read(1)}, {read(2)}, {}, gap::Metric::simulation, {}, 1};
    question.given_form = true;
    gap::Ground ground = gap::prepare(question);
    ground.list.clear();
    for (const char* name : {"backlash", "direction_asymmetry", "sensor_lag", "actuator_lag", "quadratic_drag"}) {
        ground.list.push_back(&gap::effect_named(name));
    }
    const gap::Found found = gap::search({ground, 1, [](const std::string&) {}});
    std::vector<Set> tried;
    for (const gap::Ranked& ranked : found.ranking) {
        Set names;
        for (const gap::Effect* effect : ranked.trained.effects) {
            names.insert(effect->name);
        }
        tried.push_back(names);
    }
    ASSERT_THAT(tried, Contains(Set{"backlash", "direction_asymmetry"}));
    // Both lags are special cases of one that differs by direction, and each lead's finalists are two.
    EXPECT_THAT(tried, Contains(Set{"backlash", "sensor_lag"}));
    EXPECT_THAT(tried, Contains(Set{"backlash", "actuator_lag"}));
}

}  // namespace
