// Beside a fitted form few partners of each lead are fitted to the end: special cases of the best set are fitted, too,
// so that what is named can be the simpler one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "gap/drive/near_best.hpp"
#include "gap/drive/search.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

using Set = std::set<std::string>;

gap::Record read(unsigned seed, double step = 0.0) {
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
        z = step > 0.0 ? step * std::round(z / step) : z;
    }
    return record;
}

// \param list  what is looked for; empty: all there is \param said  takes what is told of progress
std::vector<Set> tried_of(const std::vector<std::string>& list, double step = 0.0,
                          std::vector<std::string>* said = nullptr) {
    gap::Question question{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)),
                           true,
                           {read(1, step)},
                           {read(2, step)},
                           {},
                           gap::Metric::simulation,
                           {},
                           1};
    question.given_form = true;
    gap::Ground ground = gap::prepare(question);
    if (!list.empty()) {
        ground.list.clear();
    }
    for (const std::string& name : list) {
        ground.list.push_back(&gap::effect_named(name));
    }
    const gap::Found found = gap::search({ground, 1, [&](const std::string& line) {
                                              if (said != nullptr) {
                                                  said->push_back(line);
                                              }
                                          }});
    std::vector<Set> tried;
    for (const gap::Ranked& ranked : found.ranking) {
        Set names;
        for (const gap::Effect* effect : ranked.trained.effects) {
            names.insert(effect->name);
        }
        tried.push_back(names);
    }
    return tried;
}

TEST(SearchBesideAForm, FitsTheSpecialCasesOfTheBestSet) {
    const std::vector<Set> tried =
        tried_of({"backlash", "direction_asymmetry", "sensor_lag", "actuator_lag", "quadratic_drag"});
    ASSERT_THAT(tried, Contains(Set{"backlash", "direction_asymmetry"}));
    // Both lags are special cases of one that differs by direction, and each lead's finalists are two.
    EXPECT_THAT(tried, Contains(Set{"backlash", "sensor_lag"}));
    EXPECT_THAT(tried, Contains(Set{"backlash", "actuator_lag"}));
}

// A valve that sticks and never jumps is a play: that is fitted from the numbers that say so, not from its own starts.
// Here they are wider than the input ever moves, so that no number has a slope and all stay where they begin.
TEST(SearchBesideAForm, FitsWhatTheBestOneOnlyIs) {
    gap::Question question{
        gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), true, {read(1)}, {read(2)}, {}, gap::Metric::simulation, {}, 1};
    question.given_form = true;
    gap::Ground ground = gap::prepare(question);
    const gap::Search search{ground, 1, [](const std::string&) {}};
    const gap::Effect& valve = gap::effect_named("valve_stiction");
    const auto simplified = [&](double jump) {
        gap::Found found;
        gap::Candidate sticks = gap::fit(ground.study, {}, {}, nullptr);
        sticks.effects = {&valve};
        sticks.lasting = {gap::parameters_of(valve, ground.study.scales, 0)};
        sticks.lasting[0][0].value = 100.0;
        sticks.lasting[0][1].value = jump;
        found.ranking.emplace_back();
        found.ranking[0].trained = sticks;
        return gap::simplified({search, found, nullptr}, 1);
    };
    const std::vector<gap::Candidate> simpler = simplified(1e-4);
    ASSERT_EQ(simpler.size(), 1U);
    EXPECT_EQ(simpler[0].name(), "input_hysteresis");
    const std::vector<gap::FreeParameter>& numbers = simpler[0].lasting[0];
    EXPECT_EQ(numbers[0].name, "input_hysteresis.width");
    EXPECT_EQ(numbers[0].value, numbers[0].upper);
    EXPECT_THAT(simplified(10.5), testing::IsEmpty());
    // What is not looked for is not named.
    std::erase(ground.list, &gap::effect_named("input_hysteresis"));
    EXPECT_THAT(simplified(1e-4), testing::IsEmpty());
}

// Friction that may be even was fitted before, with another base, and stayed at none.
TEST(SearchBesideAForm, FitsASpecialCaseAnewThatLeavesMore) {
    gap::Question question{
        gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), true, {read(1)}, {read(2)}, {}, gap::Metric::simulation, {}, 1};
    question.given_form = true;
    const gap::Ground ground = gap::prepare(question);
    const gap::Search search{ground, 1, [](const std::string&) {}};
    gap::Found found;
    for (const char* name : {"direction_dependent_friction", "coulomb_friction"}) {
        gap::Candidate one = gap::fit(ground.study, {}, {}, nullptr);
        one.effects = {&gap::effect_named(name)};
        one.lasting = {gap::parameters_of(*one.effects[0], ground.study.scales, 0)};
        one.cost = 1.0;
        found.ranking.emplace_back();
        found.ranking.back().trained = one;
    }
    found.ranking[1].trained.cost = 1.19;
    EXPECT_THAT(gap::simplified({search, found, nullptr}, 1), IsEmpty());
    found.ranking[1].trained.cost = 1.21;
    const std::vector<gap::Candidate> anew = gap::simplified({search, found, nullptr}, 1);
    ASSERT_EQ(anew.size(), 1U);
    EXPECT_EQ(anew[0].name(), "coulomb_friction");
}

// A bend of the readings and one of the outflow: where training leaves as much with both, validation is asked.
TEST(SearchBesideAForm, FitsTheVariantsThatTrainingDoesNotTell) {
    gap::Question question{
        gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), true, {read(1)}, {read(2)}, {}, gap::Metric::simulation, {}, 1};
    question.given_form = true;
    gap::Ground ground = gap::prepare(question);
    ground.study.scales.drains = ground.study.scales.steady = true;
    ground.study.scales.swings = false;
    const gap::Search search{ground, 1, [](const std::string&) {}};
    const gap::Effect& curve = gap::effect_named("output_curve");
    gap::Found found;
    found.ranking.resize(2);
    found.ranking[1].trained = gap::fit(ground.study, {}, {}, nullptr);
    gap::Candidate& bent = found.ranking[0].trained;
    gap::Effort first;
    first.only_start = 0;
    bent = gap::fit(ground.study, {&curve}, found.ranking[1].trained, nullptr, first);
    bent.cost = 1e9;
    const std::vector<gap::Candidate> all = gap::variants({search, found, nullptr}, 1);
    ASSERT_EQ(all.size(), 2U);  // from both starts of the other one
    for (const gap::Candidate& other : all) {
        EXPECT_EQ(other.name(), "output_curve");
        EXPECT_EQ(other.lasting[0][2].value, 1.0);
    }
    // As much: 2 %.
    const double least = std::min(all[0].cost, all[1].cost);
    bent.cost = least / 1.0199;
    EXPECT_THAT(gap::variants({search, found, nullptr}, 1), Not(IsEmpty()));
    bent.cost = least / 1.0201;
    EXPECT_THAT(gap::variants({search, found, nullptr}, 1), IsEmpty());
    // Where it was not fitted without it there is nothing to begin from.
    bent.cost = 1e9;
    found.ranking.pop_back();
    EXPECT_THAT(gap::variants({search, found, nullptr}, 1), IsEmpty());
}

// Small moves and one as far as the range: of a play that only the large one passes its own starts know nothing.
gap::Record played(unsigned seed, double width) {
    gap::Record record = read(seed);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.input[i] *= i >= 200 && i < 220 ? 1.0 / std::fabs(record.input[i]) : 0.1;
    }
    gap::Scenario scenario;
    scenario.model = drive::make_fopdt(2.0, 1.0, 0.0);
    gap::effect_named("input_hysteresis").add_to(scenario, std::vector{width, 1.0});
    record.output = gap::simulate(scenario, gap::Course(record, 8));
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2e-3);
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

// One cause, too, is fitted from where the best says that it lies.
TEST(SearchBesideAForm, FitsWhatTheBestSingleOnlyIs) {
    constexpr double width = 0.8;
    gap::Question question{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)),
                           true,
                           {played(1, width)},
                           {played(2, width)},
                           {},
                           gap::Metric::simulation,
                           {},
                           1};
    question.given_form = true;
    gap::Ground ground = gap::prepare(question);
    const gap::Effect& play = gap::effect_named("input_hysteresis");
    ground.list = {&gap::effect_named("valve_stiction"), &play};
    const gap::Found found = gap::search({ground, 1, [](const std::string&) {}});
    const auto single = std::ranges::find_if(found.ranking, [&](const gap::Ranked& ranked) {
        return ranked.trained.effects == std::vector<const gap::Effect*>{&play};
    });
    ASSERT_NE(single, found.ranking.end());
    EXPECT_NEAR(single->trained.lasting[0][0].value, width, 0.01 * width);
    EXPECT_NEAR(single->trained.lasting[0][1].value, 1.0, 0.01);
}

// Of the best set each is exchanged for the closest of what acts at the same place: as partners of a lead none of these
// is fitted to the end.
TEST(SearchBesideAForm, FitsTheRivalsOfTheBestSet) {
    const std::vector<Set> tried = tried_of({});
    ASSERT_THAT(tried, Contains(Set{"backlash", "direction_asymmetry"}));
    EXPECT_THAT(tried, Contains(Set{"backlash", "structural_resonance"}));
    EXPECT_THAT(tried, Contains(Set{"direction_asymmetry", "output_curve"}));
    EXPECT_THAT(tried, Not(Contains(Set{"backlash", "gain_drift"})));
}

// Of the best single, too, which may be what is named: all of these act at one place.
TEST(SearchBesideAForm, FitsTheRivalsOfTheBestSingle) {
    const auto rivals_said = [](const std::vector<std::string>& list) {
        std::vector<std::string> said;
        (void)tried_of(list, 0.0, &said);
        std::erase_if(said, [](const std::string& line) { return line.find(" rivals") == std::string::npos; });
        return said;
    };
    EXPECT_THAT(rivals_said({"backlash", "direction_asymmetry", "structural_resonance"}),
                ElementsAre("fitting 2 rivals", "fitting 2 rivals"));
    EXPECT_THAT(rivals_said({"backlash", "structural_resonance"}), ElementsAre("fitting 1 rivals"));
    EXPECT_THAT(rivals_said({"backlash"}), IsEmpty());
}

// Finalist or not: a step of the readings that shows is seen, so it is tried beside the best.
TEST(SearchBesideAForm, FitsAStepThatShowsBesideTheBest) {
    EXPECT_THAT(tried_of({}, 0.04), Contains(Set{"direction_asymmetry", "encoder_quantisation"}));
    EXPECT_THAT(tried_of({"backlash", "direction_asymmetry", "encoder_quantisation"}, 1e-3),
                Not(Contains(Set{"backlash", "encoder_quantisation"})));
}

}  // namespace
