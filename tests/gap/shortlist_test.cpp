// Which candidates a search goes on with, of lists made by hand.
#include "gap/drive/shortlist.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using testing::ElementsAre;
using Names = std::vector<std::string>;

gap::Candidate candidate_of(const Names& effects, double cost = 0.0) {
    gap::Candidate candidate;
    for (const std::string& name : effects) {
        candidate.effects.push_back(&gap::effect_named(name));
    }
    candidate.cost = cost;
    return candidate;
}

Names finalists(const std::vector<Names>& sets, bool beside_form) {
    std::vector<gap::Candidate> all;
    for (const Names& effects : sets) {
        all.push_back(candidate_of(effects));
    }
    gap::keep_finalists(all, beside_form);
    Names names;
    for (const gap::Candidate& one : all) {
        names.push_back(one.name());
    }
    return names;
}

TEST(Shortlist, BesideAModelEightAreFittedToTheEnd) {
    std::vector<Names> sets;
    for (const char* second : {"gain_error", "backlash", "end_stop", "rate_limit", "sensor_lag", "supply_sag",
                               "gain_drift", "load_disturbance"}) {
        sets.push_back({"cogging", second});
    }
    EXPECT_EQ(finalists(sets, false).size(), 8U);
    sets.push_back({"cogging", "sensor_offset"});
    const Names kept = finalists(sets, false);
    ASSERT_EQ(kept.size(), 8U);
    EXPECT_EQ(kept.back(), "cogging + load_disturbance");
}

// Two of each lead, and two that have events, whatever leads them.
TEST(Shortlist, BesideAFormTwoOfEachLeadAreFittedToTheEnd) {
    EXPECT_THAT(finalists({{"cogging", "gain_drift"},
                           {"backlash", "end_stop"},
                           {"cogging", "rate_limit"},
                           {"cogging", "supply_sag"},
                           {"backlash", "rate_limit"},
                           {"cogging", "load_disturbance"},
                           {"backlash", "missed_counts"},
                           {"end_stop", "load_disturbance"},
                           {"end_stop", "supply_sag"},
                           {"end_stop", "backlash", "supply_sag"},
                           {"backlash", "supply_sag"}},
                          true),
                ElementsAre("cogging + gain_drift", "backlash + end_stop", "cogging + rate_limit",
                            "backlash + rate_limit", "cogging + load_disturbance", "backlash + missed_counts",
                            "end_stop + supply_sag", "end_stop + backlash + supply_sag"));
}

// The best first by what was not fitted; each costs what training says.
std::vector<gap::Ranked> ranking_of(const std::vector<std::pair<Names, double>>& all) {
    std::vector<gap::Ranked> ranking;
    for (const auto& [effects, cost] : all) {
        ranking.emplace_back().trained = candidate_of(effects, cost);
    }
    return ranking;
}

// The two best by either, each once.
TEST(Shortlist, PartnersAreTriedWithTheBestByBoth) {
    const auto ranking = ranking_of({{{"backlash", "end_stop"}, 0.1},
                                     {{"backlash"}, 5.0},
                                     {{}, 9.0},
                                     {{"encoder_quantisation"}, 0.5},
                                     {{"end_stop"}, 2.0},
                                     {{"cogging"}, 4.0},
                                     {{"gain_drift"}, 1.0},
                                     {{"rate_limit"}, 6.0},
                                     {{"sensor_lag"}, 7.0},
                                     {{"supply_sag"}, 3.0}});
    const auto leads = [&](std::size_t size, bool more, bool with_steps) {
        Names names;
        for (const gap::Ranked* lead : gap::leads_of(ranking, size, more, with_steps)) {
            names.push_back(lead->trained.name());
        }
        return names;
    };
    EXPECT_THAT(leads(1, false, false), ElementsAre("backlash", "end_stop", "gain_drift"));
    EXPECT_THAT(leads(1, false, true), ElementsAre("backlash", "encoder_quantisation", "gain_drift"));
    EXPECT_THAT(leads(2, false, false), ElementsAre("backlash + end_stop"));
    EXPECT_THAT(leads(3, true, false), ElementsAre());
    EXPECT_THAT(leads(1, true, false),
                ElementsAre("backlash", "end_stop", "cogging", "gain_drift", "rate_limit", "supply_sag"));
}

}  // namespace
