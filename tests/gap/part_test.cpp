// What would part two causes that explain these records alike: which record, or that none does, by how far the one,
// refitted, misses the other there, over the noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gap/drive/experiment.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A lag of 1 s that stood at 0 and came up to 1, and two causes of a size, as they were fitted.
struct Alike {
    std::vector<gap::Record> records;
    gap::Study study;
    std::vector<gap::Candidate> causes;
    explicit Alike(const std::vector<const char*>& effects, double value)
        : study{{gap::form_of(drive::make_fopdt(1.0, 1.0, 0.0)), false}, {}, {}, {}, 0.01, 0.001, 0} {
        gap::Record record;
        record.name = "made";
        record.usual_interval_s = 0.1;
        for (int i = 0; i < 201; ++i) {
            record.time_s.push_back(0.1 * i);
            record.input.push_back(i < 20 ? 0.0 : 1.0);
            record.output.push_back(i < 20 ? 0.0 : 1.0 - std::exp(-0.1 * (i - 20)));
        }
        records = {record};
        study.counts = gap::all_count(records);
        study.courses.emplace_back(records[0], 1);
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
        for (const char* effect : effects) {
            gap::Candidate cause;
            cause.effects = {&gap::effect_named(effect)};
            cause.own.push_back(gap::state_of(study, records[0]));
            cause.lasting = {gap::parameters_of(*cause.effects[0], study.scales, 0)};
            cause.lasting[0][0].value = value;
            causes.push_back(cause);
        }
    }
    [[nodiscard]] gap::Proposal parted(double noise) const { return gap::part(study, {&causes[0], &causes[1]}, noise); }
};

// How far they are apart is over the noise; visible from three tenths of it on, and words and number say the same.
TEST(Part, IsProposedWhereItIsVisible) {
    const Alike alike({"input_saturation", "quadratic_drag"}, 0.5);
    const double apart = alike.parted(1.0).apart;
    ASSERT_GT(apart, 0.0);
    const gap::Proposal hidden = alike.parted(apart / 0.299);
    EXPECT_NEAR(hidden.apart, 0.299, 1e-9);
    EXPECT_THAT(hidden.text, StartsWith("no input parts them: of the excitations simulated, the best ("));
    EXPECT_THAT(hidden.text,
                HasSubstr("leaves quadratic_drag within 0.3 of the noise of input_saturation once refitted"));
    EXPECT_FALSE(hidden.record);
    const gap::Proposal seen = alike.parted(apart / 0.301);
    EXPECT_NEAR(seen.apart, 0.301, 1e-9);
    ASSERT_TRUE(seen.record);
    EXPECT_THAT(seen.text, StartsWith(seen.record->text + ": simulated, quadratic_drag once refitted to "
                                                          "input_saturation still misses it by 0.3 times the noise"));
    // Of what is drawn the first is what the one makes of it, the second the other, refitted: they differ by so much.
    ASSERT_EQ(seen.record->outputs.size(), 2U);
    EXPECT_EQ(seen.record->outputs[0].first, "input_saturation");
    EXPECT_EQ(seen.record->outputs[1].first, "quadratic_drag, refitted");
    double squares = 0.0;
    const auto& one = seen.record->outputs[0].second;
    for (std::size_t i = 0; i < one.size(); ++i) {
        squares += std::pow(one[i] - seen.record->outputs[1].second[i], 2);
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(one.size())), apart, 1e-6 * apart);
    EXPECT_THAT(alike.parted(apart / 0.042).text, HasSubstr("within 0.042 of the noise of"));
}

// What runs away however it is refitted tells nothing of how far apart they would be: infinitely, a division would say.
TEST(Part, IsNotAskedOfWhatRunsAway) {
    Alike alike({"input_saturation", "quadratic_drag"}, 0.5);
    gap::FreeParameter& drag = alike.causes[1].lasting[0][0];
    drag.value = -1e6;
    drag.lower = -1e7;
    drag.upper = -1e5;
    const gap::Proposal proposed = alike.parted(0.01);
    EXPECT_THAT(proposed.text, StartsWith("a record at other levels and speeds"));
    EXPECT_FALSE(proposed.record);
}

TEST(Part, OfAnEventIsTheSameRecordAgain) {
    Alike alike({"sensor_lag", "load_disturbance"}, 0.3);
    alike.causes[1].lasting.clear();
    const auto numbers = gap::parameters_of(*alike.causes[1].effects[0], alike.study.scales, 0);
    alike.causes[1].own[0].insert(alike.causes[1].own[0].end(), numbers.begin(), numbers.end());
    EXPECT_THAT(alike.parted(0.01).text, StartsWith("the same record once more"));
}

}  // namespace
