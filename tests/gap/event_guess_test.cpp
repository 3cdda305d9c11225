// Where residuals say that a load pushed, up to the record's ends.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

namespace {

// 10 s at a constant input; the places that are tried are a fortieth apart.
TEST(DisturbanceGuess, MayBeginOrEndWithTheRecord) {
    gap::Record record;
    record.name = "held";
    record.usual_interval_s = 0.01;
    for (int k = 0; k <= 1000; ++k) {
        record.time_s.push_back(5.0 + 0.01 * k);
        record.input.push_back(2.0);
        record.output.push_back(0.0);
    }
    const gap::Course course(record, 1);
    gap::Scenario plant;
    plant.model.gain = 3.0;
    plant.model.denominator = {{0.4, 1.0}, {2.0, 0.0}};
    gap::Scales scales{};
    scales.force = 5.0;
    const std::vector<double> without = gap::simulate(plant, course);
    for (const auto& [from_s, to_s] : {std::pair(0.0, 0.25), std::pair(0.0, 10.0), std::pair(0.25, 0.5),
                                       std::pair(9.5, 9.75), std::pair(9.75, 10.0)}) {
        gap::Scenario pushed = plant;
        pushed.forces.pushes.push_back({from_s, to_s, -0.8});
        std::vector<double> residuals = gap::simulate(pushed, course);
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            residuals[i] -= without[i];
        }
        const std::vector<double> found =
            gap::effect_named("load_disturbance").guess({course, plant, residuals, scales});
        ASSERT_EQ(found.size(), 3U);
        EXPECT_NEAR(found[0], from_s, 1e-9) << from_s << " to " << to_s;
        EXPECT_NEAR(found[1], to_s, 1e-9) << from_s << " to " << to_s;
        EXPECT_NEAR(found[2], -0.8, 0.01) << from_s << " to " << to_s;
    }
}

}  // namespace
