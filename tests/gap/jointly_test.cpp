// What a base leaves that is fitted to the validation, too: of readings that two gains made it is in between.
#include "gap/drive/base/jointly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "gap/drive/start.hpp"
#include "gap/drive/study.hpp"
#include "made_records.hpp"

namespace {

using gap_test::levels;

// Of a gain of 1; of 1.2 where it is asked.
gap::Record record_with(const std::vector<char>& stronger) {
    gap::Record record = gap_test::record_of(960, [](double t) { return levels(t) - 0.2; });
    record.output = gap_test::response(record, gap_test::of({{2.0, 1.0}, {1.0, 0.0}}));
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] *= stronger[i] != 0 ? 1.2 : 1.0;
    }
    return record;
}

gap::Question question_of(std::vector<gap::Record> train, std::vector<gap::Record> validate) {
    return {gap::form_of(drive::make_fopdt(1.0, 2.0, 0.0)),
            true,
            std::move(train),
            std::move(validate),
            {},
            gap::Metric::simulation,
            {},
            1};
}

const std::vector<char> never(960, 0);
const std::vector<char> always(960, 1);

// A gain of 1.1 leaves a tenth of what a gain of 1 makes, over 1.2 times its deviation.
TEST(JointGap, IsOfWhatIsFittedToBothAndJudgedByTheValidation) {
    EXPECT_NEAR(gap::joint_gap(question_of({record_with(never)}, {record_with(always)})), 0.1 / 1.2, 0.005);
    EXPECT_NEAR(gap::joint_gap(question_of({record_with(always)}, {record_with(never)})), 0.1, 0.005);
    // Two records weigh twice as much as one.
    EXPECT_NEAR(gap::joint_gap(question_of({record_with(never), record_with(never)}, {record_with(always)})),
                0.4 / 3.0 / 1.2, 0.005);
}

// Where parts of the training judge, all of it is fitted: a third of the samples that has the other gain.
TEST(JointGap, IsOfWhatIsFittedToAllWherePartsJudge) {
    const std::vector<char> aside = gap::part_counts({record_with(never)}, {}, true).front();
    const double share = static_cast<double>(std::count(aside.begin(), aside.end(), 1)) / 960.0;
    ASSERT_GT(share, 0.2);
    ASSERT_LT(share, 0.4);
    EXPECT_NEAR(gap::joint_gap(question_of({record_with(aside)}, {})), 0.2 * (1.0 - share) / 1.2, 0.02);
}

}  // namespace
