// What the pages say of effects: that each shows itself, as its equation says, and which look alike.
#include "docs/site/facts/facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docs/site/facts/effects.hpp"

namespace {

const docs::ShownEffect& shown(const std::string& name) {
    static const std::vector<docs::ShownEffect> all = docs::shown_effects();
    return *std::ranges::find_if(all, [&](const docs::ShownEffect& one) { return one.effect->name == name; });
}

double number(const docs::ShownEffect& one, const std::string& name) {
    return std::get<double>(std::ranges::find(one.numbers, name, &gap::Written::name)->value);
}

double likeness(const std::string& one, const std::string& other) {
    for (const auto& [name, cosine] : shown(one).alike) {
        if (name == other) {
            return cosine;
        }
    }
    return 0.0;
}

TEST(DocsEffects, EveryEffectOfTheListChangesItsLog) {
    for (const gap::Effect* effect : gap::effects()) {
        const docs::ShownEffect& one = shown(effect->name);
        ASSERT_EQ(one.time_s.size(), one.with.size()) << effect->name;
        EXPECT_EQ(one.with != one.without, !effect->only_spreads) << effect->name;
        EXPECT_TRUE(std::ranges::all_of(one.with, [](double y) { return std::isfinite(y); })) << effect->name;
    }
}

TEST(DocsEffects, ThePictureIsOfTheNumbersBesideIt) {
    const docs::ShownEffect& gain = shown("gain_error");
    const docs::ShownEffect& offset = shown("sensor_offset");
    const docs::ShownEffect& limit = shown("sensor_saturation");
    for (std::size_t i = 0; i < gain.time_s.size(); ++i) {
        EXPECT_NEAR(gain.with[i], number(gain, "gain") * gain.without[i], 1e-9);
        EXPECT_NEAR(offset.with[i], offset.without[i] + number(offset, "offset"), 1e-12);
        EXPECT_NEAR(limit.with[i], std::min(limit.without[i], number(limit, "limit")), 1e-12);
    }
    const auto& jumps = std::get<std::vector<double>>(shown("missed_counts").numbers[1].value);
    EXPECT_NEAR(jumps.at(0), 0.2, 0.01);
}

// A lag before a linear plant is one behind it, and friction alike in both directions a special case.
TEST(DocsEffects, WhatLooksAlikeIsSaid) {
    EXPECT_NEAR(likeness("actuator_lag", "sensor_lag"), 1.0, 1e-6);
    EXPECT_GT(likeness("direction_dependent_friction", "coulomb_friction"), 0.9);
    EXPECT_EQ(likeness("actuator_lag", "backlash"), 0.0);
    for (const gap::Effect* effect : gap::effects()) {
        double before = 1.0;
        for (const auto& [name, cosine] : shown(effect->name).alike) {
            EXPECT_NE(name, effect->name);
            EXPECT_GE(cosine, 0.8);
            EXPECT_LE(cosine, before) << "the largest first";
            before = cosine;
        }
    }
}

// Gain and offset are a fitted base's own: what is left of a saturation has no part of them.
TEST(DocsEffects, WhatAFittedBaseTakesUpIsNoLikeness) {
    EXPECT_EQ(likeness("sensor_lag", "logger_filter"), 0.0) << "both are late alike, which a dead time is";
    EXPECT_GT(likeness("dead_time_error", "logger_filter"), 0.9);
}

TEST(DocsFacts, EveryKernelIsOfOneFamily) {
    std::size_t kernels = 0;
    for (const auto& family : docs::families()) {
        for (const auto& kernel : family["kernels"]) {
            ++kernels;
            const bool integrals = kernel["history"] == "modessum";
            EXPECT_EQ(kernel["orders"], integrals ? "integrals" : "all") << kernel["name"];
        }
    }
    EXPECT_GT(kernels, 70U);
}

TEST(DocsFacts, EveryFigureOfACoreHasItsSource) {
    const auto cores = docs::cores(GLSUM_CORES);
    EXPECT_GE(cores.size(), 15U);
    for (const auto& core : cores) {
        EXPECT_GE(core["figures"].size(), 30U) << core["name"];
        for (const auto& figure : core["figures"]) {
            EXPECT_FALSE(figure["source"].get<std::string>().empty()) << core["name"] << figure["key"];
        }
    }
    const auto itcm = std::ranges::find_if(cores, [](const auto& core) { return core["name"] == "stm32f746-itcm"; });
    EXPECT_EQ((*itcm)["code"], "itcm");
    EXPECT_FALSE((*itcm)["rivals"].empty());
}

}  // namespace
