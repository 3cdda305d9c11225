// What the search has to know of an effect follows from its law.
#include <gtest/gtest.h>

#include <vector>

#include "gap/drive/effect.hpp"
#include "gap/drive/scenario.hpp"

namespace {

// A law that lets no small level pass shifts the operating point as long as no input lies within it: a fitted base has
// to follow it before its numbers can be told. One that rounds levels lets the rest pass and shifts nothing.
TEST(EffectTraits, LawsThatLetNoSmallLevelPassLeadTheBase) {
    gap::Scales scales;
    scales.input_max = 2.0;
    scales.time_constant_s = 1.0;
    scales.output_span = 1.0;
    std::size_t leading = 0;
    for (const gap::Effect* effect : gap::effects()) {
        if (effect->kind != gap::Kind::lasting || effect->place != gap::Place::actuator) {
            continue;
        }
        std::vector<double> values;
        for (const gap::EffectParameter& parameter : effect->parameters(scales)) {
            values.push_back(parameter.starts.front());
        }
        gap::Scenario scenario;
        if (values.empty()) {
            continue;
        }
        effect->add_to(scenario, values);
        const auto passed = [&](double before, double level) {
            std::vector<double> levels{before, level};
            for (const auto& law : scenario.levels) {
                law(levels);
            }
            return levels.back();
        };
        // What sticks lets none pass that differs little from the last, wherever that was.
        const bool sticks = passed(2.0, 1.99) == passed(2.0, 2.0);
        const bool dead =
            passed(0.01, 0.01) == 0.0 && passed(-0.01, -0.01) == 0.0 && passed(2.0, 2.0) != 0.0 && !sticks;
        EXPECT_EQ(effect->leads_base, dead) << effect->name;
        leading += dead ? 1 : 0;
    }
    EXPECT_EQ(leading, 2U);
}

// A motor starts beyond its threshold, not at it; where it has no width, at once.
TEST(EffectTraits, AtItsThresholdAMotorStands) {
    for (const double stops_below : {0.0, 1.0}) {
        gap::Scenario scenario;
        gap::effect_named("start_up_threshold").add_to(scenario, std::vector{0.5, stops_below, 0.0});
        std::vector<double> levels{0.5, -0.5, 0.5001, 0.5};
        scenario.levels.at(0)(levels);
        EXPECT_EQ(levels, (std::vector{0.0, 0.0, 0.5001, stops_below > 0.0 ? 0.0 : 0.5}));
    }
}

}  // namespace
