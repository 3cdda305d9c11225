// What the search has to know of an effect follows from its law.
#include <gtest/gtest.h>

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

}  // namespace
