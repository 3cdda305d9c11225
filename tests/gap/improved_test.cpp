// What is said of an improved model that cannot be read: in short, whatever stands there.
#include "gap/drive/improved.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/failure.hpp"
#include "drive/model.hpp"
#include "made_records.hpp"

namespace {

using testing::EndsWith;

std::string said_of(const std::string& notes) {
    drive::Model model = drive::make_fopdt(2.0, 1.0, 0.0);
    model.notes = notes;
    try {
        (void)gap::simulate_improved(model, gap_test::record_of(40, gap_test::levels), "m.json");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "read";
}

// Sixty letters of it.
TEST(Improved, SaysWhatItFoundInShort) {
    const std::string long_one(80, 'x');
    EXPECT_THAT(said_of(R"({"effects": [")" + long_one + R"("]})"),
                EndsWith(R"(m.json: effects: expected {"effect", "parameters"}, found ")" + std::string(59, 'x')));
    EXPECT_THAT(
        said_of(R"({"effects": [{"effect": "gain_error", "parameters": {"gain": {")" + long_one + R"(": 1}}}]})"),
        EndsWith("m.json: effects: gain: expected a number, a word or a list of numbers, found {\"" +
                 std::string(58, 'x')));
    EXPECT_THAT(said_of(R"({"effects": 1})"), EndsWith("m.json: effects: expected an array"));
    EXPECT_THAT(said_of(R"({"effects": [], "idle_input": "a"})"), EndsWith("m.json: idle_input: expected a number"));
    EXPECT_EQ(said_of(R"({"effects": [{"effect": "gain_error", "parameters": {"gain": 1.5}}]})"), "read");
}

}  // namespace
