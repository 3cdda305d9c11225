// Controller files: read, written without loss, refused by field.
#include "drive/controller_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/failure.hpp"
#include "drive/model_file.hpp"

namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
    try {
        (void)drive::parse_fopid(text, "pid.json");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "accepted";
}

const std::string whole =
    R"({"kind": "fopid", "kp": 0.3, "ki": 0.5, "kd": 0.02, "integral_order": 0.9, "derivative_order": 0.7,
        "filter_s": 0.01, "sample_time_s": 0.001, "low": -1, "high": 2, "setpoint_weight": 0.8, "plant": [1, 2]})";

TEST(ControllerFile, KeepsEveryField) {
    const drive::Fopid read = drive::parse_fopid(whole, "pid.json");
    EXPECT_EQ(read.gains.kp, 0.3);
    EXPECT_EQ(read.gains.ki, 0.5);
    EXPECT_EQ(read.gains.kd, 0.02);
    EXPECT_EQ(read.gains.integral_order, 0.9);
    EXPECT_EQ(read.gains.derivative_order, 0.7);
    EXPECT_EQ(read.gains.filter_s, 0.01);
    EXPECT_EQ(read.sample_time_s, 0.001);
    EXPECT_EQ(read.low, -1.0);
    EXPECT_EQ(read.high, 2.0);
    EXPECT_EQ(read.setpoint_weight, 0.8);
    const std::string written = drive::to_json(read);
    EXPECT_THAT(written, HasSubstr("\"plant\""));
    EXPECT_EQ(drive::to_json(drive::parse_fopid(written, "again")), written);
}

TEST(ControllerFile, LeavesOutWhatIsUsual) {
    const drive::Fopid read = drive::parse_fopid(R"({"kind": "fopid", "ki": 0.1, "sample_time_s": 0.01})", "p");
    EXPECT_EQ(read.gains.kp, 0.0);
    EXPECT_EQ(read.gains.integral_order, 1.0);
    EXPECT_EQ(read.setpoint_weight, 1.0);
    EXPECT_TRUE(std::isinf(read.low) && std::isinf(read.high));
    EXPECT_EQ(drive::to_json(read).find("low"), std::string::npos);
    EXPECT_EQ(drive::to_json(drive::parse_fopid(drive::to_json(read), "p")), drive::to_json(read));
}

// The same controller as a transfer function.
TEST(ControllerFile, IsAControllerOfALoopToo) {
    EXPECT_EQ(drive::parse_controller(whole, "pid.json"),
              drive::parse_controller(R"({"kind": "pid", "kp": 0.3, "ki": 0.5, "kd": 0.02, "integral_order": 0.9,
                                          "derivative_order": 0.7, "filter_s": 0.01})",
                                      "pid.json"));
}

TEST(ControllerFile, RefusesByField) {
    const auto with = [](const std::string& fields) {
        return refusal(R"({"kind": "fopid", "sample_time_s": 0.001, )" + fields + "}");
    };
    EXPECT_EQ(with(R"("kp": 1)"), "accepted");
    EXPECT_EQ(with(R"("kp": 1, "setpoint_weight": 0)"), "accepted") << "the set point then acts by the integral alone";
    EXPECT_EQ(with(R"("kp": 0)"), "pid.json: expected kp, ki or kd other than 0");
    EXPECT_EQ(with(R"("kp": "1")"), "pid.json: kp: expected a number, found \"1\"");
    EXPECT_THAT(with(R"("ki": 1, "integral_order": 1.01)"), HasSubstr("integral_order: expected an order above 0"));
    EXPECT_THAT(with(R"("kd": 1, "derivative_order": 0)"), HasSubstr("derivative_order: expected an order above 0"));
    EXPECT_THAT(with(R"("kp": 1, "filter_s": -1)"), HasSubstr("filter_s: expected 0 s or more, found -1"));
    EXPECT_THAT(with(R"("kp": 1, "low": 1, "high": 1)"), HasSubstr("low: expected a limit below high, found 1"));
    EXPECT_THAT(with(R"("kp": 1, "setpoint_weight": 1.5)"), HasSubstr("setpoint_weight: expected a weight of 0 to 1"));
    EXPECT_THAT(refusal(R"({"kind": "fopid", "kp": 1})"), HasSubstr("expected the field sample_time_s"));
    EXPECT_THAT(refusal(R"({"kind": "fopid", "kp": 1, "sample_time_s": 0})"), HasSubstr("sample_time_s: expected"));
    EXPECT_THAT(refusal(R"({"kind": "pid", "kp": 1})"), HasSubstr("kind: expected fopid, found \"pid\""));
    EXPECT_THAT(refusal("{\"kind\": \"fopid\",\n \"kp\": }"), HasSubstr("pid.json:2: expected JSON"));
    EXPECT_THAT(refusal("{\"kind\": \"fopid\",\n"), HasSubstr("expected a controller in JSON"));
}

}  // namespace
