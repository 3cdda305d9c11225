// What the firmware answers, and what is taken from it.
#include "qemu/emulate/answers.hpp"

#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "base/words.hpp"

namespace {

TEST(Words, AreTakenOneByOneAndNumbersAreWhole) {
    base::Words words("  row 7 ff ff 8x -1 +1 256 ");
    EXPECT_EQ(words.next(), "row");
    EXPECT_EQ(words.number<std::uint8_t>(), 7);
    EXPECT_EQ(words.number<std::uint8_t>(16), 255);
    EXPECT_FALSE(words.number<std::uint8_t>());
    EXPECT_FALSE(words.number<std::uint8_t>());
    EXPECT_FALSE(words.number<std::uint8_t>());
    EXPECT_FALSE(words.number<std::uint8_t>());
    EXPECT_FALSE(words.done());
    EXPECT_FALSE(words.number<std::uint8_t>());  // beyond its range
    EXPECT_TRUE(words.done());
    EXPECT_EQ(words.next(), "");
    EXPECT_FALSE(words.number<std::uint8_t>());
}

TEST(Answers, RowsAreTakenInTheirOrder) {
    qemu::Answers answers(2);
    EXPECT_FALSE(answers.take_measured("qemu: a word of its own"));
    const auto row = answers.take_measured("row 0 0 00000000000000ff 120 48 2400");
    ASSERT_TRUE(row);
    EXPECT_EQ(row->status, glsum::Status::ok);
    EXPECT_EQ(row->hash, 255U);
    EXPECT_EQ(row->stack_bytes, 120U);
    EXPECT_EQ(row->state_bytes, 48U);
    EXPECT_EQ(row->coefficient_bytes, 2400U);
    EXPECT_THROW(answers.check_complete(), glsum::Failure);
    EXPECT_EQ(answers.take_measured("row 1 5")->status, glsum::Status::format_too_narrow);
    EXPECT_THROW(answers.check_complete(), glsum::Failure);
    EXPECT_FALSE(answers.take_measured("end 2"));
    answers.check_complete();
}

TEST(Answers, RefusesRowsOutOfTurnOrDamaged) {
    for (const char* line : {"row 1 0 ff", "row 0", "row 0 9", "row 0 0", "row 0 0 xyz", "row 0 0 ff 1", "row 0 -1 ff",
                             "row x 0 ff", "row 0 5 ff", "row 0 0 10000000000000000"}) {
        qemu::Answers answers(1);
        EXPECT_THROW((void)answers.take_replayed(line), glsum::Failure) << line;
    }
    qemu::Answers none(0);
    EXPECT_THROW((void)none.take_replayed("row 0 0 ff"), glsum::Failure);
    qemu::Answers early(1);
    (void)early.take_replayed("end 1");  // before its row
    EXPECT_THROW(early.check_complete(), glsum::Failure);
    (void)early.take_replayed("row 0 0 ff");
    EXPECT_THROW(early.check_complete(), glsum::Failure);
}

}  // namespace
