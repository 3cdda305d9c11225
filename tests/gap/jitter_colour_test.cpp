// Shifts of neighbouring stamps do not know of each other: what goes on from sample to sample is no jitter.
#include <gtest/gtest.h>

#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/jitter.hpp"
#include "gap/drive/start.hpp"

namespace {

// Three readings of a lag that comes up, each off by so much: from the first to the last it moves up.
gap::Candidate fitted(const std::vector<double>& off) {
    std::vector<gap::Record> records(1);
    gap::Record& record = records.front();
    record.name = "made";
    record.usual_interval_s = 0.5;
    record.time_s = {0.0, 0.5, 1.0};
    record.input = {2.0, 2.0, 2.0};
    record.output = {0.0, 0.0, 0.0};
    const drive::Model lag = drive::make_fopdt(2.0, 3.0, 0.0);
    gap::Study study{
        {gap::form_of(lag), false}, gap::scales_of(lag, records, {}), {}, gap::all_count(records), 0.01, 0.004, 0};
    study.courses.emplace_back(record, 1);
    gap::Candidate candidate;
    candidate.own.resize(1);
    const auto simulated = gap::simulate(gap::scenario_of(study, candidate, 0), study.courses[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        record.output[i] = simulated[i] + off[i];
    }
    candidate.effects = {&gap::effect_named("sampling_jitter")};
    candidate.lasting = {gap::parameters_of(*candidate.effects[0], study.scales, 0)};
    candidate.lasting[0][0].upper = 0.25;
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.001;
    gap::fit_jitter(study, candidate, whitener);
    return candidate;
}

double width(const std::vector<double>& off) { return fitted(off).lasting[0][0].value; }

TEST(JitterColour, IsOfEveryPairOfNeighbours) {
    // What leads once and lags once may be jitter; so may one reading alone.
    EXPECT_GT(width({0.1, -0.1, 0.1}), 0.0);
    EXPECT_GT(width({0.1, 0.0, 0.0}), 0.0);
    // Two that lead together are none, be they the first or the last.
    EXPECT_EQ(width({0.1, 0.1, 0.0}), 0.0);
    EXPECT_EQ(width({0.0, 0.1, 0.1}), 0.0);
    EXPECT_EQ(fitted({0.1, 0.1, 0.0}).lasting[0][1].value, 1.0);  // all that is left is noise
}

}  // namespace
