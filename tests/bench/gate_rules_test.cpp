// Thresholds: what is written is what is judged by, and what cannot be meant is refused with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/build_info.hpp"
#include "bench/gate/rules.hpp"
#include "tests/refusal.hpp"

namespace {

using namespace bench::gate;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string good = R"([[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = ["error_max", "error_rms"]
better = "lower"
relative = 0.01
level = "fail"
reason = "because"
)";

// `good` with `from` replaced by `to`.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
    return test::refusal(glsum::Exit::bad_input, [&] { (void)parse_rules(text, "t.toml"); });
}

TEST(GateRules, AreReadAsWritten) {
    const Rules rules = parse_rules(good + changed("\"fail\"", "\"warn\""), "t.toml");
    ASSERT_EQ(rules.size(), 2u);
    EXPECT_EQ(rules[0].layer, Layer::accuracy);
    EXPECT_THAT(rules[0].rows, ElementsAre("gl/*/accuracy/*"));
    EXPECT_THAT(rules[0].counters, ElementsAre("error_max", "error_rms"));
    EXPECT_EQ(rules[0].better, Better::lower);
    EXPECT_EQ(rules[0].relative, 0.01);
    EXPECT_EQ(rules[0].absolute, 0.0);
    EXPECT_TRUE(rules[0].fails);
    EXPECT_FALSE(rules[1].fails);
    EXPECT_EQ(rules[0].reason, "because");
    EXPECT_EQ(rules[1].line, 9u);
}

TEST(GateRules, AllowSoMuchByItself) {
    const Rules rules = parse_rules(changed("relative = 0.01", "absolute = 3.5"), "t.toml");
    ASSERT_EQ(rules.size(), 1u);
    EXPECT_EQ(rules[0].absolute, 3.5);
    EXPECT_EQ(rules[0].relative, 0.0);
}

TEST(GateRules, OfHostTimeHaveAnAnchor) {
    std::string text = changed("\"accuracy\"", "\"host_time\"");
    EXPECT_THAT(refusal(text), HasSubstr("expected the key anchor"));
    text += "anchor = \"peer_std_f32\"\nconfidence = 0.95\n";
    const Rules rules = parse_rules(text, "t.toml");
    EXPECT_EQ(rules[0].anchor, "peer_std_f32");
    EXPECT_TRUE(rules[0].witnesses.empty());
    EXPECT_EQ(parse_rules(text + "witnesses = \"peer_*\"\n", "rules")[0].witnesses, std::vector<std::string>{"peer_*"});
    EXPECT_THAT(refusal(text + "witnesses = 3\n"), HasSubstr("witnesses"));
    EXPECT_EQ(rules[0].confidence, 0.95);
    const std::string without = changed("\"accuracy\"", "\"host_time\"") + "anchor = \"peer_std_f32\"\n";
    for (const double taken : {0.5, 0.9999}) {
        EXPECT_EQ(parse_rules(without + "confidence = " + std::to_string(taken) + "\n", "rules")[0].confidence, taken);
    }
    for (const char* refused : {"0.4999", "0.99991", "1.0"}) {
        EXPECT_THAT(refusal(without + "confidence = " + refused + "\n"), HasSubstr("from 0.5 to 0.9999")) << refused;
    }
    EXPECT_EQ(parse_rules(without, "rules")[0].confidence, 0.99);
    EXPECT_THAT(refusal(text + "absolute = 1\n"), HasSubstr("t.toml:11:12: absolute: times of two runs"));
    EXPECT_THAT(refusal(good + "anchor = \"peer_std_f32\"\n"), HasSubstr("only rules of the layer host_time"));
}

TEST(GateRules, NameThePlaceOfWhatIsWrong) {
    EXPECT_THAT(refusal("[[rule]\n"), HasSubstr("t.toml:1:"));
    EXPECT_THAT(refusal(""), HasSubstr("expected at least one [[rule]]"));
    EXPECT_THAT(refusal("rule = []\n"), HasSubstr("t.toml:1:1"));
    EXPECT_THAT(refusal("rule = 3\n"), HasSubstr("t.toml:1:1: expected rules"));
    EXPECT_THAT(refusal("[other]\n"), HasSubstr("t.toml:1:2: expected rules, [[rule]], found the key other"));
    EXPECT_THAT(refusal(changed("reason", "reasno")), HasSubstr("t.toml:8:1: expected one of layer"));
    EXPECT_THAT(refusal(changed("reason = \"because\"\n", "")), HasSubstr("t.toml:1:1: expected the key reason"));
    EXPECT_THAT(refusal(changed("\"because\"", "\" \"")), HasSubstr("t.toml:8:10: reason: expected a text"));
    EXPECT_THAT(refusal(changed("\"accuracy\"", "\"speed\"")),
                HasSubstr("t.toml:2:9: layer: expected one of accuracy, instructions_and_bytes, model_cycles, "
                          "host_time, found speed"));
    EXPECT_THAT(refusal(changed("\"lower\"", "\"less\"")), HasSubstr("t.toml:5:10: better: expected one of lower"));
    EXPECT_THAT(refusal(changed("\"fail\"", "true")), HasSubstr("t.toml:7:9: level"));
    EXPECT_THAT(refusal(changed("relative = 0.01\n", "")), HasSubstr("t.toml:1:1: expected relative, absolute"));
    for (const std::string number : {"-0.01", "nan", "inf", "\"1 %\"", "true"}) {
        EXPECT_THAT(refusal(changed("0.01", number)),
                    HasSubstr("t.toml:6:12: relative: expected a finite number of at least 0"))
            << number;
    }
    EXPECT_THAT(refusal(changed("[\"error_max\", \"error_rms\"]", "[]")), HasSubstr("t.toml:4:12: counters"));
    EXPECT_THAT(refusal(changed("\"error_rms\"", "3")), HasSubstr("t.toml:4:26: counters"));
}

TEST(GateRules, AllowWhatTheySay) {
    Rule rule;
    rule.relative = 0.1;
    EXPECT_GT(rule.excess(10.0, 11.01), 0.0);
    EXPECT_LE(rule.excess(10.0, 10.99), 0.0);
    EXPECT_LE(rule.excess(10.0, 5.0), 0.0);
    EXPECT_GT(rule.excess(0.0, 1e-300), 0.0);  // a share of nothing is nothing
    rule.absolute = 2.0;
    EXPECT_LE(rule.excess(10.0, 12.0), 0.0);  // the larger of both
    EXPECT_GT(rule.excess(100.0, 110.1), 0.0);
    rule.better = Better::higher;
    EXPECT_GT(rule.excess(10.0, 7.9), 0.0);
    EXPECT_LE(rule.excess(10.0, 20.0), 0.0);
    rule.better = Better::equal;
    EXPECT_GT(rule.excess(10.0, 12.1), 0.0);
    EXPECT_GT(rule.excess(10.0, 7.9), 0.0);
    EXPECT_LE(rule.excess(-10.0, -11.0), 0.0);
    Rule exact;
    EXPECT_GT(exact.excess(3615.0, 3616.0), 0.0);
    EXPECT_EQ(exact.excess(3615.0, 3615.0), 0.0);
}

TEST(GateRules, ThatAreCommittedSpeakOfEveryLayer) {
    const Rules rules = read_rules(std::string(build_info::source_folder) + "/results/thresholds.toml");
    for (const Layer layer : {Layer::accuracy, Layer::instructions_and_bytes, Layer::model_cycles, Layer::host_time}) {
        EXPECT_TRUE(std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) {
            return rule.layer == layer && rule.fails;
        })) << name_of(layer);
    }
    EXPECT_EQ(better_of(rules, "gl/a/order:1/taps:2/accuracy/signal:step", "effective_taps"), Better::higher);
    EXPECT_EQ(better_of(rules, "gl/a/order:1/taps:2/m7:count", "instructions_per_sample"), Better::lower);
    EXPECT_FALSE(better_of(rules, "gl/a/order:1/taps:2/m7:count", "no_such_counter"));
}

// What is beyond the allowed change, by which way is better; at most 0 within it.
TEST(GateRules, AllowAsMuchAsTheySayAndNoMore) {
    Rule rule;
    rule.relative = 0.25;
    rule.absolute = 1.0;
    EXPECT_EQ(rule.allowed(8.0), 2.0);
    EXPECT_EQ(rule.allowed(-8.0), 2.0);
    EXPECT_EQ(rule.allowed(2.0), 1.0);  // the larger of both
    rule.better = Better::lower;
    EXPECT_EQ(rule.excess(8.0, 10.0), 0.0);
    EXPECT_EQ(rule.excess(8.0, 11.0), 1.0);
    EXPECT_EQ(rule.excess(8.0, 4.0), -6.0);
    rule.better = Better::higher;
    EXPECT_EQ(rule.excess(8.0, 6.0), 0.0);
    EXPECT_EQ(rule.excess(8.0, 5.0), 1.0);
    EXPECT_EQ(rule.excess(8.0, 12.0), -6.0);
    rule.better = Better::equal;
    EXPECT_EQ(rule.excess(8.0, 6.0), 0.0);
    EXPECT_EQ(rule.excess(8.0, 10.0), 0.0);
    EXPECT_EQ(rule.excess(8.0, 5.0), 1.0);
    EXPECT_EQ(rule.excess(8.0, 11.0), 1.0);
}

TEST(GateRules, OfTimesWantLessOfThem) {
    const std::string times = changed("\"accuracy\"", "\"host_time\"") + "anchor = \"peer_std_f32\"\n";
    EXPECT_EQ(parse_rules(times, "t.toml")[0].better, Better::lower);
    std::string more = times;
    more.replace(more.find("\"lower\""), 7, "\"higher\"");
    EXPECT_THAT(refusal(more), HasSubstr("t.toml:5:10: better: expected lower for times"));
}

TEST(GateRules, RefuseAListWithNothingInIt) {
    EXPECT_THAT(refusal(changed("\"error_rms\"", "\"\"")), HasSubstr("t.toml:4:26: counters: expected a text"));
    EXPECT_THAT(refusal(changed("[\"error_max\", \"error_rms\"]", "[]")), HasSubstr("at least one glob"));
    EXPECT_THAT(refusal("rule = [1]\n"), HasSubstr("expected rules"));
    EXPECT_THAT(refusal(good + "[other]\n"), HasSubstr("found the key other"));
}

TEST(GateRules, AreAThousandAtMost) {
    const auto rules_of = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) {
            text += good;
        }
        return text;
    };
    EXPECT_EQ(parse_rules(rules_of(1000), "t.toml").size(), 1000U);
    EXPECT_THAT(refusal(rules_of(1001)), HasSubstr("expected at most 1000 rules"));
}

// The first rule that wants both the row and the counter tells which way is better.
TEST(GateRules, TellTheBetterWayOfARowAndACounter) {
    const Rules rules = parse_rules(good + changed("\"lower\"", "\"higher\""), "t.toml");
    const std::string row = "gl/a/order:1/taps:2/accuracy/signal:step";
    EXPECT_EQ(better_of(rules, row, "error_max"), Better::lower);
    EXPECT_FALSE(better_of(rules, row, "error_mean"));
    EXPECT_FALSE(better_of(rules, "gl/a/order:1/taps:2/m7:count", "error_max"));
}

}  // namespace
