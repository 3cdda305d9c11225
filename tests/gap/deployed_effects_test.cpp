// What each effect of a deployed simulation says that ran: which kernel, in which steps, over how long a memory.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gap/drive/effect.hpp"

namespace {

gap::Deployed deployed(const std::string& effect, const std::vector<double>& values) {
    gap::Scenario scenario;
    gap::effect_named(effect).add_to(scenario, values);
    return scenario.deployed.value_or(gap::Deployed{-1.0, -1.0, "none"});
}

void expect(const gap::Deployed& found, const gap::Deployed& wanted) {
    EXPECT_EQ(found.step_s, wanted.step_s);
    EXPECT_EQ(found.taps, wanted.taps);
    EXPECT_EQ(found.kernel, wanted.kernel);
    EXPECT_EQ(found.increments, wanted.increments);
}

// Oldest first, increments, step: variants are 0 or 1.
TEST(DeployedEffects, SinglePrecisionIsSummedEitherWay) {
    expect(deployed("single_precision", {0.0, 0.0, 0.25}), {0.25, 0.0, "ring_plain_f32", false});
    expect(deployed("single_precision", {1.0, 0.0, 0.25}), {0.25, 0.0, "ring_oldest_f32", false});
    expect(deployed("single_precision", {0.0, 1.0, 0.5}), {0.5, 0.0, "ring_plain_f32", true});
    expect(deployed("single_precision", {1.0, 1.0, 0.0}), {0.0, 0.0, "ring_oldest_f32", true});
}

TEST(DeployedEffects, FixedPointIsOfItsBits) {
    expect(deployed("fixed_point", {31.0, 0.0, 0.25}), {0.25, 0.0, "ring_plain_q31", false});
    expect(deployed("fixed_point", {15.0, 0.0, 0.5}), {0.5, 0.0, "ring_plain_q15", false});
    expect(deployed("fixed_point", {31.0, 1.0, 0.25}), {0.25, 0.0, "ring_plain_q31", true});
    expect(deployed("fixed_point", {15.0, 1.0, 0.0}), {0.0, 0.0, "ring_plain_q15", true});
}

// As files name them.
TEST(DeployedEffects, FixedPointIsReadByItsName) {
    const gap::Effect& effect = gap::effect_named("fixed_point");
    for (const auto& [name, bits] : {std::pair("q31", 31.0), std::pair("q15", 15.0)}) {
        const std::vector<double> read = effect.from_contract(effect, {{"format", std::string(name)}});
        EXPECT_EQ(read.at(0), bits);
        EXPECT_EQ(std::get<std::string>(
                      effect.to_contract(effect, std::vector<gap::Fitted>{{bits, bits, bits}, {}, {}}).at(0).value),
                  name);
    }
}

// Also between whole numbers of taps, in double.
TEST(DeployedEffects, AFiniteMemoryIsOfItsTaps) {
    expect(deployed("finite_memory", {40.0, 0.25}), {0.25, 40.0, "", false});
    expect(deployed("finite_memory", {40.5, 0.0}), {0.0, 40.5, "", false});
}

}  // namespace
