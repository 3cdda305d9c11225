// Which candidates are tried, beside a short list of effects: each alone, pairs of those that lead where noise is not
// all that is left, each set once.
#include "gap/drive/search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "gap/drive/start.hpp"

namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

using Names = std::vector<std::string>;

struct Asked {
    std::vector<std::pair<std::string, std::vector<double>>> truth = {};
    Names list = {};
    double noise = 0.01;
    double step = 0.0;      // of the readings
    double jitter_s = 0.0;  // half width
    drive::Model model = drive::make_fopdt(2.0, 1.0, 0.0);
    bool refit = false;
};

gap::Record read(const Asked& asked, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, asked.noise);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 400; ++i) {
        record.time_s.push_back(0.1 * i);
        // Levels of both signs, which the seed draws, held for two seconds.
        record.input.push_back(i % 20 == 0 ? even(engine) : record.input.back());
        record.output.push_back(0.0);
    }
    gap::Scenario scenario;
    scenario.model = asked.model;
    for (const auto& [name, values] : asked.truth) {
        gap::effect_named(name).add_to(scenario, values);
    }
    record.output = gap::simulate(scenario, gap::Course(record, 8));
    for (std::size_t i = 0; i < record.size(); ++i) {
        const double speed = i > 0 ? (record.output[i] - record.output[i - 1]) / 0.1 : 0.0;
        record.output[i] += noise(engine) + (asked.jitter_s > 0.0 ? asked.jitter_s * even(engine) * speed : 0.0);
        record.output[i] = asked.step > 0.0 ? asked.step * std::round(record.output[i] / asked.step) : record.output[i];
    }
    return record;
}

struct Tried {
    gap::Found found;
    Names said;
    [[nodiscard]] Names names() const {
        Names all;
        for (const gap::Ranked& ranked : found.ranking) {
            all.push_back(ranked.trained.name());
        }
        return all;
    }
    [[nodiscard]] Names sized(std::size_t size) const {
        Names all;
        for (const gap::Ranked& ranked : found.ranking) {
            if (ranked.trained.effects.size() == size) {
                all.push_back(ranked.trained.name());
            }
        }
        return all;
    }
};

Tried search(const Asked& asked) {
    gap::Question question{
        gap::form_of(asked.model), asked.refit, {read(asked, 1)}, {read(asked, 2)}, {}, gap::Metric::simulation, {}, 1};
    question.given_form = asked.refit;
    gap::Ground ground = gap::prepare(question);
    ground.list.clear();
    for (const std::string& name : asked.list) {
        ground.list.push_back(&gap::effect_named(name));
    }
    Tried tried;
    tried.found = gap::search({ground, 1, [&](const std::string& what) { tried.said.push_back(what); }});
    return tried;
}

// The ranking is by score; each set of effects is in it once, in any order, and so is none.
void expect_a_ranking(const Tried& tried) {
    std::set<std::set<const gap::Effect*>> seen;
    for (std::size_t i = 0; i < tried.found.ranking.size(); ++i) {
        const gap::Ranked& ranked = tried.found.ranking[i];
        EXPECT_TRUE(seen.insert({ranked.trained.effects.begin(), ranked.trained.effects.end()}).second)
            << ranked.trained.name();
        if (i > 0) {
            EXPECT_LE(ranked.score(), tried.found.ranking[i - 1].score());
        }
    }
    EXPECT_THAT(tried.names(), Contains("none"));
}

// Where noise alone is left nothing is combined.
TEST(Search, OfNoiseTriesEachAlone) {
    const Tried tried = search({.list = {"sensor_offset", "sensor_drift", "backlash"}});
    expect_a_ranking(tried);
    EXPECT_THAT(tried.names(), UnorderedElementsAre("none", "sensor_offset", "sensor_drift", "backlash"));
    EXPECT_THAT(tried.said, ElementsAre("fitting the base: 1 record", "fitting 3 effects, each alone",
                                        "judging them by what was not fitted"));
    // Nothing to be tried is no failure.
    EXPECT_THAT(search({}).names(), ElementsAre("none"));
}

// Of three effects that lead there are three pairs, and of the best pair with the third one set of three.
TEST(Search, OfTwoCausesTriesPairs) {
    const Tried tried = search({.truth = {{"sensor_offset", {0.3}}, {"sensor_drift", {0.02}}},
                                .list = {"sensor_offset", "sensor_drift", "backlash"}});
    expect_a_ranking(tried);
    EXPECT_THAT(tried.said, Contains("fitting 3 pairs"));
    EXPECT_THAT(tried.said, Not(Contains(HasSubstr("exchanges"))));  // the best pair leaves noise
    EXPECT_EQ(tried.sized(1).size(), 3U);
    EXPECT_EQ(tried.sized(2).size(), 3U);
    EXPECT_TRUE(tried.names().front() == "sensor_offset + sensor_drift" ||
                tried.names().front() == "sensor_drift + sensor_offset")
        << tried.names().front();
    const gap::Ranked& best = tried.found.ranking.front();
    for (std::size_t e = 0; e < 2; ++e) {
        const bool offset = best.trained.effects[e]->name == "sensor_offset";
        EXPECT_NEAR(best.trained.lasting[e][0].value, offset ? 0.3 : 0.02, offset ? 0.01 : 5e-4);
    }
    // The whitener is the best one's: noise is white.
    EXPECT_NEAR(tried.found.whitener.deviation, 0.01, 0.001);
    EXPECT_NEAR(tried.found.whitener.stationary_deviation, 0.01, 0.001);
}

// What leads is two by validation and two by training: of seven effects these have 18 pairs at most. Five and five
// where no single one leaves noise alone: then all 21.
TEST(Search, TriesMorePairsWhereNoSingleLeavesNoise) {
    const Names list = {"sensor_offset",  "sensor_drift", "backlash",       "gain_drift",
                        "quadratic_drag", "supply_sag",   "input_dead_zone"};
    const auto pairs = [&](double drift) {
        const Tried tried = search({.truth = {{"sensor_offset", {0.3}}, {"sensor_drift", {drift}}}, .list = list});
        const auto said =
            std::ranges::find_if(tried.said, [](const std::string& what) { return what.ends_with(" pairs"); });
        return said == tried.said.end() ? 0 : std::stoi(said->substr(std::string("fitting ").size()));
    };
    const int few = pairs(0.0);
    EXPECT_GE(few, 11);  // of two leads
    EXPECT_LE(few, 18);
    EXPECT_EQ(pairs(0.02), 21);
}

// A special case says nothing beside what covers it.
TEST(Search, PairsNothingWithItsSpecialCase) {
    const Tried tried = search({.truth = {{"sensor_offset", {0.3}}, {"sensor_lag", {0.4}}},
                                .list = {"sensor_offset", "sensor_lag", "direction_asymmetry"}});
    expect_a_ranking(tried);
    EXPECT_EQ(tried.sized(2).size(), 2U);
    for (const std::string& pair : tried.sized(2)) {
        EXPECT_THAT(pair, HasSubstr("sensor_offset"));
    }
}

// Where one effect is all that is looked for nothing can be combined, though it leaves more than noise: neither beside
// a model that is given nor beside a form.
TEST(Search, OfOneEffectTriesNoPair) {
    for (const bool refit : {false, true}) {
        const Tried tried = search(
            {.truth = {{"backlash", {0.3}}, {"sensor_drift", {0.02}}}, .list = {"sensor_drift"}, .refit = refit});
        expect_a_ranking(tried);
        EXPECT_THAT(tried.names(), UnorderedElementsAre("none", "sensor_drift"));
        EXPECT_THAT(tried.said, Contains("fitting 0 pairs"));
        EXPECT_THAT(tried.said, Not(Contains(HasSubstr("exchanges"))));
    }
}

// Jitter moves no reading: it is asked for alone, and once beside the best one.
TEST(Search, AsksForJitterBesideTheBest) {
    const Tried tried = search({.truth = {{"sensor_offset", {0.3}}},
                                .list = {"sensor_offset", "sensor_drift", "sampling_jitter"},
                                .jitter_s = 0.05});
    expect_a_ranking(tried);
    EXPECT_THAT(tried.sized(1), UnorderedElementsAre("sensor_offset", "sensor_drift", "sampling_jitter"));
    EXPECT_THAT(tried.sized(2), Contains("sensor_offset + sampling_jitter"));
    EXPECT_EQ(tried.names().front(), "sensor_offset + sampling_jitter");
    EXPECT_THAT(tried.sized(2), Not(Contains("sampling_jitter + sensor_offset")));
    EXPECT_EQ(tried.sized(3).size(), 1U);  // beside the best pair
    EXPECT_NEAR(tried.found.ranking.front().trained.lasting[1][0].value, 0.05, 0.01);
}

// A step of the readings is paired where it shows: where it makes a tenth of what is left.
TEST(Search, PairsAStepThatShows) {
    const auto pairs = [](double step) {
        Asked asked{.truth = {{"sensor_offset", {0.3}}},
                    .list = {"sensor_offset", "sensor_drift", "encoder_quantisation"},
                    .noise = 1e-4,
                    .step = step};
        std::size_t rounding = 0;
        for (const std::string& pair : search(asked).sized(2)) {
            rounding += pair.find("encoder_quantisation") != std::string::npos ? 1 : 0;
        }
        return rounding;
    };
    // The base leaves an offset of 0.3: a step of 0.104 makes a tenth of that.
    EXPECT_EQ(pairs(0.095), 0U);
    EXPECT_GT(pairs(0.125), 0U);
}

// What was deployed is of the model that is given: beside what makes it another one it says nothing.
TEST(Search, PairsNoDeployedErrorWithAnotherModel) {
    drive::Model model;
    model.gain = 2.0;
    model.denominator = {{1.0, 0.8}, {1.0, 0.0}};
    const Tried tried = search({.truth = {{"finite_memory", {20.0, 0.1}}, {"sensor_offset", {0.2}}},
                                .list = {"sensor_offset", "finite_memory", "order_error", "time_scale_error"},
                                .model = model});
    expect_a_ranking(tried);
    const Names pairs = tried.sized(2);
    for (const std::string& pair : pairs) {
        const bool deployed = pair.find("finite_memory") != std::string::npos;
        EXPECT_TRUE(!deployed || pair.find("sensor_offset") != std::string::npos) << pair;
    }
    EXPECT_GT(pairs.size(), 1U);
}

// Of three causes three are found, each beside the two that were found before.
TEST(Search, OfThreeCausesTriesSetsOfThree) {
    const Tried tried = search({.truth = {{"sensor_offset", {0.3}}, {"sensor_drift", {0.02}}, {"backlash", {0.3}}},
                                .list = {"sensor_offset", "sensor_drift", "backlash", "gain_drift"}});
    expect_a_ranking(tried);
    EXPECT_EQ(tried.found.ranking.front().trained.effects.size(), 3U);
    EXPECT_THAT(tried.said, Contains(HasSubstr("sets of 3")));
    EXPECT_THAT(tried.said, Not(Contains(HasSubstr("sets of 4"))));  // beside a given model
    // The best pair leaves more than noise: each half of it was perhaps only a stand-in, and is tried with all others.
    // With each other that is one pair, and with the two that are left four.
    EXPECT_THAT(tried.said, Contains("fitting 5 exchanges"));
    EXPECT_EQ(tried.sized(4).size(), 0U);
}

// As many as are asked for at once on real rigs; beside a model that is given more are an expansion.
TEST(Search, TriesThreeEffectsBesideAModelAndFourBesideAForm) {
    gap::Base base{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0))};
    EXPECT_EQ(gap::most_effects_beside(base), 3U);
    base.refit = true;
    EXPECT_EQ(gap::most_effects_beside(base), 4U);
}

}  // namespace
