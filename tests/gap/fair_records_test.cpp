// Records that judge: enough of them on both sides of a split, and none that is fitted.
#include "gap/drive/fair_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"

namespace {

using testing::HasSubstr;

// A sample a second.
gap::Record record_of(const std::string& name, std::size_t samples, double level) {
    gap::Record record;
    record.name = name;
    for (std::size_t i = 0; i < samples; ++i) {
        record.time_s.push_back(static_cast<double>(i));
        record.input.push_back(1.0);
        record.output.push_back(level * static_cast<double>(i));
    }
    return record;
}

std::string refusal(const std::function<void()>& check) {
    try {
        check();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "none";
}

TEST(FairRecords, ASplitLeaves32SamplesOnBothSides) {
    const std::vector<gap::Record> all{record_of("long", 100, 1.0), record_of("a.csv", 65, 1.0)};
    EXPECT_EQ(refusal([&] { gap::check_split("--split", 32.0, all); }), "none");
    EXPECT_EQ(refusal([&] { gap::check_split("--split", 33.0, all); }), "none");
    EXPECT_EQ(refusal([&] { gap::check_split("--split 31", 31.0, all); }),
              "--split 31: expected 32 samples or more on both sides, found 31 of 100 before it in long");
    EXPECT_EQ(refusal([&] { gap::check_split("q: split_s 34", 34.0, all); }),
              "q: split_s 34: expected 32 samples or more on both sides, found 34 of 65 before it in a.csv");
}

TEST(FairRecords, ATrainingLogDoesNotJudge) {
    const std::vector<gap::Record> train{record_of("a.csv", 40, 1.0), record_of("b.csv", 40, 2.0)};
    EXPECT_EQ(refusal([&] { gap::check_unseen(train, {record_of("c.csv", 40, 3.0)}); }), "none");
    // By what it holds, whatever it is called.
    EXPECT_THAT(refusal([&] {
                    gap::check_unseen(train, {record_of("c.csv", 40, 3.0), record_of("d.csv", 40, 2.0)});
                }),
                HasSubstr("d.csv: expected a log that is not fitted, found the training log itself"));
}

}  // namespace
