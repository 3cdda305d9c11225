// Models: what is written is read back to the last bit, and what cannot be is refused with its place.
#include "drive/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "drive/model_file.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

std::string refusal(const std::string& text) {
    try {
        (void)drive::parse_model(text, "m.json");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    ADD_FAILURE() << "not refused: " << text.substr(0, 200);
    return "";
}

TEST(ModelFile, IsWrittenBackWithoutLoss) {
    for (const std::string text :
         {R"({"kind":"fotf","gain":1.1,"numerator":[{"coefficient":30,"order":1},{"coefficient":90.1,"order":0.3}],)"
          R"("denominator":[{"coefficient":0.1,"order":3.5},{"coefficient":-1e-300,"order":0}],"delay_s":0.1,)"
          R"("sample_time_s":0.001,"author":{"name":"x"}})",
          R"({"kind":"fopdt","gain":-2,"time_constant_s":0.1,"delay_s":0.3})",
          R"({"kind":"sopdt","gain":1,"time_constant_s":0.319,"delay_s":1.064})",
          R"({"kind":"niopdt","gain":1,"denominator":[{"coefficient":0.18234,"order":1.9909}],"delay_s":0})"}) {
        const drive::Model model = drive::parse_model(text, "m.json");
        const std::string written = drive::to_json(model);
        EXPECT_EQ(drive::parse_model(written, "m.json"), model);
        EXPECT_EQ(drive::to_json(drive::parse_model(written, "m.json")), written);
    }
    EXPECT_THAT(drive::to_json(drive::parse_model(R"({"denominator":[{"coefficient":1,"order":1}],"a":3})", "m")),
                HasSubstr("\"a\": 3"));
}

TEST(ModelFile, ShorthandsAreTheTransferFunctionsOfThePaper) {
    const auto first = drive::parse_model(R"({"kind":"fopdt","time_constant_s":0.5,"delay_s":1})", "m");
    EXPECT_EQ(first.denominator, (std::vector<drive::Term>{{0.5, 1}, {1, 0}}));
    const auto second = drive::parse_model(R"({"kind":"sopdt","gain":3,"time_constant_s":0.5})", "m");
    EXPECT_EQ(second.denominator, (std::vector<drive::Term>{{0.25, 2}, {1, 1}, {1, 0}}));
    EXPECT_EQ(drive::static_gain(second), 3.0);
    EXPECT_EQ(drive::to_text(first), "1 / (0.5 s + 1) exp(-1 s)");
}

TEST(ModelFile, RefusesWithItsPlace) {
    const std::string end = R"(,"denominator":[{"coefficient":1,"order":1},{"coefficient":1,"order":0}]})";
    EXPECT_THAT(refusal("{\"kind\": \"fotf\",\n\"gain\": }"), HasSubstr("m.json:2: expected JSON"));
    EXPECT_THAT(refusal("{\"kind\": \"fotf\",\n\"gain\""), HasSubstr("m.json:2: the file ends in the middle"));
    EXPECT_THAT(refusal(""), HasSubstr("ends in the middle"));
    EXPECT_THAT(refusal("[1]"), HasSubstr("expected an object, found [1]"));
    EXPECT_THAT(refusal(R"({"kind":"pid"})"), HasSubstr("kind: expected fotf, fopdt, sopdt or niopdt, found \"pid\""));
    EXPECT_THAT(refusal(R"({"kind":"fotf"})"), HasSubstr("expected the field denominator"));
    EXPECT_THAT(refusal(R"({"gain":0)" + end), HasSubstr("gain: expected a finite number other than 0"));
    EXPECT_THAT(refusal(R"({"gain":"1")" + end), HasSubstr("gain: expected a number, found \"1\""));
    EXPECT_THAT(refusal(R"({"gain":1e999)" + end), HasSubstr("beyond double precision"));
    EXPECT_THAT(refusal(R"({"delay_s":-1)" + end), HasSubstr("delay_s: expected 0 to"));
    EXPECT_THAT(refusal(R"({"sample_time_s":0)" + end), HasSubstr("sample_time_s: expected"));
    EXPECT_THAT(refusal(R"({"numerator":[{"coefficient":1,"order":1.5}])" + end), HasSubstr("improper"));
    EXPECT_THAT(refusal(R"({"numerator":[{"coefficient":1,"order":-1}])" + end),
                HasSubstr("numerator[0].order: expected 0 to 20, found -1"));
    EXPECT_THAT(refusal(R"({"denominator":[{"coefficient":0,"order":1},{"coefficient":1,"order":0}]})"),
                HasSubstr("denominator: the coefficient of the highest order, 1, is 0"));
    EXPECT_THAT(refusal(R"({"denominator":[{"coefficient":1,"order":1},{"coefficient":2,"order":1}]})"),
                HasSubstr("denominator[1].order: expected each order once"));
    EXPECT_THAT(refusal(R"({"denominator":[{"coefficient":1,"ordre":1}]})"), HasSubstr("expected the field order"));
    EXPECT_THAT(refusal(R"({"denominator":[]})"), HasSubstr("expected 1 to 64 terms, found 0"));
    EXPECT_THAT(refusal(R"({"kind":"fopdt","time_constant_s":-1})"), HasSubstr("time_constant_s: expected"));
    EXPECT_THAT(refusal(R"({"kind":"fopdt","denominator":[]})"), HasSubstr("of kind fopdt has no denominator"));
    EXPECT_THAT(refusal(R"({"kind":"sopdt","numerator":[])" + end), HasSubstr("of kind sopdt has no numerator"));
    EXPECT_THAT(refusal(R"({"kind":"niopdt","numerator":[])" + end), HasSubstr("of kind niopdt has no numerator"));
    EXPECT_THAT(refusal(R"({"kind":"fotf","time_constant_s":1)" + end),
                HasSubstr("of kind fotf has no time_constant_s"));
    EXPECT_THAT(refusal(R"({"kind":"niopdt","time_constant_s":1)" + end),
                HasSubstr("of kind niopdt has no time_constant_s"));
    EXPECT_THAT(refusal(R"({"kind":"fopdt","time_constant_s":0})"), HasSubstr("time_constant_s: expected"));
    EXPECT_THAT(refusal(std::string(100, '[')), HasSubstr("nested"));
    // Eight levels are read, of notes; nine are not.
    EXPECT_NO_THROW((void)drive::parse_model(R"({"gain":1,"note":[[[[[[[1]]]]]]])" + end, "m.json"));
    EXPECT_THAT(refusal(R"({"gain":1,"note":[[[[[[[[[1]]]]]]]]])" + end), HasSubstr("nested"));
    // The line is that of the fault, and what stands there.
    EXPECT_THAT(refusal("{\n\n\"gain\": 1 2}"), HasSubstr("m.json:3: expected JSON, found '"));
}

TEST(ModelFile, IsReadFieldByField) {
    const auto model = drive::parse_model(
        R"({"kind":"niopdt","gain":2,"delay_s":0.5,"sample_time_s":0.25,"author":"me","denominator":[{"coefficient":4,"order":1.5},{"coefficient":1,"order":0}]})",
        "m");
    EXPECT_EQ(model.kind, drive::Kind::niopdt);
    EXPECT_EQ(model.gain, 2.0);
    EXPECT_EQ(model.delay_s, 0.5);
    EXPECT_EQ(model.sample_time_s, 0.25);
    EXPECT_EQ(model.denominator, (std::vector<drive::Term>{{4.0, 1.5}, {1.0, 0.0}}));
    EXPECT_EQ(model.numerator, (std::vector<drive::Term>{{1.0, 0.0}}));
    const std::string text = drive::to_json(model);
    for (const char* field : {"\"kind\": \"niopdt\"", "\"gain\": 2.0", "\"delay_s\": 0.5", "\"sample_time_s\": 0.25",
                              "\"author\": \"me\"", "\"order\": 1.5", "\"coefficient\": 4.0"}) {
        EXPECT_THAT(text, HasSubstr(field));
    }
    EXPECT_THAT(text, Not(HasSubstr("numerator")));
    const std::string second = drive::to_json(drive::make_sopdt(3.0, 0.5, 0.25));
    EXPECT_THAT(second, HasSubstr("\"time_constant_s\": 0.5"));
    EXPECT_THAT(drive::to_json(drive::make_fopdt(3.0, 0.5, 0.25)), HasSubstr("\"time_constant_s\": 0.5"));
    EXPECT_THAT(second, Not(HasSubstr("sample_time_s")));
    const auto free = drive::parse_model(
        R"({"kind":"fotf","numerator":[{"coefficient":3,"order":0.5}],"denominator":[{"coefficient":4,"order":1.5}]})",
        "m");
    EXPECT_EQ(free.gain, 1.0);
    EXPECT_EQ(free.delay_s, 0.0);
    EXPECT_FALSE(free.sample_time_s);
    EXPECT_THAT(drive::to_json(free), HasSubstr("\"numerator\""));
}

}  // namespace
