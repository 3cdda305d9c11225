// What a proposed experiment narrows: what is known now is what the fit's own deviations say of it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/drive/deviations.hpp"
#include "gap/drive/experiment.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/start.hpp"

namespace {

gap::Record read(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.02);
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
    gap::effect_named("input_saturation").add_to(scenario, std::vector{0.7});
    gap::effect_named("sensor_lag").add_to(scenario, std::vector{0.3});
    record.output = gap::simulate(scenario, gap::Course(record, 4));
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

// The base is fitted with it: each number's slope is taken with all others where they are.
TEST(Sharpen, BeginsAtTheDeviationsOfTheFit) {
    const gap::Question question{
        gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), true, {read(1)}, {read(2)}, {}, gap::Metric::simulation, {}, 1};
    const gap::Ground ground = gap::prepare(question);
    const std::vector<const gap::Effect*> effects{&gap::effect_named("input_saturation"),
                                                  &gap::effect_named("sensor_lag")};
    gap::Candidate fitted = gap::fit(ground.study, effects, ground.base, nullptr);
    const gap::Whitener whitener = gap::whitener_of(ground.study, fitted);
    gap::add_deviations(ground.study, fitted, &whitener);
    const std::string text = gap::sharpen(ground.study, fitted, whitener).text;
    const std::string before = " instead of ";
    std::size_t told = 0;
    for (const auto& list : fitted.lasting) {
        const std::size_t of = text.find(" narrower for " + list[0].name + " (");
        const std::size_t at = of == std::string::npos ? of : text.find(before, of);
        if (at == std::string::npos) {
            continue;
        }
        ++told;
        const double within = 1.96 * list[0].deviation;
        EXPECT_NEAR(std::stod(text.substr(at + before.size())), within, 0.06 * within) << text;  // of two digits
    }
    EXPECT_EQ(told, 2U) << text;
}

}  // namespace
