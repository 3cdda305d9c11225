// Texts of headers: what of them stands in one, by its facts, and what is refused.
#include "bench/texts/template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "bench/generate/header.hpp"

namespace {

using generate::Facts;
using generate::HeaderText;
using testing::HasSubstr;
using testing::Not;

// Of a kernel of these texts, with places that stand for themselves.
HeaderText text_of(const Facts& facts, const std::vector<std::string>& history,
                   const std::string& technique = "multi") {
    HeaderText text;
    text.facts = facts;
    for (const char* place : {"name", "sample", "coefficient", "accumulator", "output", "call", "own summary",
                              "own fields", "weight", "rounded_once"}) {
        text.places[place] = place;
    }
    text.places["NAME"] = "N";
    text.places["rolled"] = "";
    text.places["history"] = "mirror";
    text.chains = {{"history", history}, {"sum", {technique, "history"}}, {"header", {"header"}}};
    return text;
}

const std::vector<std::string> window = {"mirror", "window", "history"};

TEST(Template, ASectionIsTheFirstOfItsChain) {
    HeaderText wrapped = text_of({{"fixed", 1}}, {"delta", "mirror", "window", "history"});
    EXPECT_EQ(wrapped.section("history", "summary"), "of increments d_k = x_k - x_(k-1): own summary\n");
    EXPECT_EQ(wrapped.section("history", "closing"), "");
    EXPECT_THAT(wrapped.section("history", "reset"), HasSubstr("        S->past[i] = 0;\n    }\n    S->before = 0;\n"));
    EXPECT_THAT(wrapped.section("history", "before"), HasSubstr("name_saturate((int64_t)(newest) - S->before)"));
    EXPECT_THAT(wrapped.section("history", "window"), HasSubstr("    const sample* const newer = "));
    EXPECT_TRUE(generate::has_section("delta", "before"));
    EXPECT_FALSE(generate::has_section("delta", "push"));
    EXPECT_FALSE(generate::has_section("no such text", "push"));
}

TEST(Template, FactsDecide) {
    const auto integrator = [](long modes, long decaying, long past) {
        HeaderText text =
            text_of({{"modes", modes}, {"decaying", decaying}, {"past", past}}, {"integrator", "modes", "history"});
        return text.section("history", "constants") + text.section("history", "before");
    };
    EXPECT_EQ(integrator(0, 0, 0), "");
    EXPECT_THAT(integrator(1, 0, 0), HasSubstr("INTEGRATOR_WEIGHT weight "));
    EXPECT_THAT(integrator(1, 0, 0), HasSubstr("const sample added = newest;\n"));
    EXPECT_THAT(integrator(1, 0, 1), HasSubstr("added = S->past[N_PAST - 1U];\n"));
    EXPECT_THAT(integrator(1, 0, 1), Not(HasSubstr("_MODES")));
    EXPECT_THAT(integrator(3, 2, 1), HasSubstr("#define N_MODES 2U "));
    // A comparison, "or" and "not".
    const auto hidden = [](long past, const char* fact) {
        HeaderText text = text_of({{"past", past}, {fact, 1}}, window);
        const std::string sum = text.section("sum", "sum");
        return std::string(sum.find("KEEP_WORD(samples)") != sum.npos ? "samples " : "") +
               (sum.find("KEEP_WORD(past)") != sum.npos ? "past" : "");
    };
    EXPECT_EQ(hidden(3, "two_pieces"), "samples past");
    EXPECT_EQ(hidden(4, "two_pieces"), "");
    EXPECT_EQ(hidden(3, "f32"), "");
    EXPECT_EQ(hidden(4, "f32"), "");
    EXPECT_EQ(hidden(4, "fused"), "past");
    EXPECT_EQ(hidden(4, "in_software"), "past");
    const auto takes_the_cores_loop = [](const Facts& facts) {
        HeaderText text = text_of(facts, window);
        return !text.section("sum", "declared").empty();
    };
    EXPECT_TRUE(takes_the_cores_loop({{"f32", 1}, {"past", 16}}));
    EXPECT_FALSE(takes_the_cores_loop({{"f32", 1}, {"past", 15}}));
    EXPECT_FALSE(takes_the_cores_loop({{"f32", 1}, {"past", 16}, {"fused", 1}}));
    EXPECT_TRUE(takes_the_cores_loop({{"q31", 1}, {"past", 16}}));
    EXPECT_FALSE(takes_the_cores_loop({{"past", 16}}));
}

TEST(Template, ItemsOfAListAreGoneThrough) {
    HeaderText text =
        text_of({{"octave", 2}, {"octave.0.up", 0}, {"octave.0.end", 1}, {"octave.1.up", 3}, {"octave.1.end", 7}},
                window, "scaled");
    const std::string sum = text.section("sum", "sum");
    EXPECT_THAT(sum, HasSubstr("for (; i < 1U; ++i)"));
    EXPECT_THAT(sum, HasSubstr("for (; i < 7U; ++i)"));
    EXPECT_THAT(sum, HasSubstr("<< (3))"));
    EXPECT_LT(sum.find("i < 1U"), sum.find("<< (3)"));
    EXPECT_THAT(sum, Not(HasSubstr("<< (0)")));
    EXPECT_THAT(text_of({}, window, "scaled").section("sum", "sum"), Not(HasSubstr("for (")));
}

// Those alone that are called, also from another, each before its call and once.
TEST(Template, HelpersAreThoseThatAreCalled) {
    HeaderText text = text_of({{"f32", 1}}, window);
    text.chains["format"] = {"floating"};
    text.chains["again"] = {"floating"};
    const std::string found = text.helpers({"format", "again"}, "s = name_multiply_add(s, a, x);");
    EXPECT_THAT(found, HasSubstr(" name_multiply("));
    EXPECT_LT(found.find("HELPER accumulator name_product("), found.find("HELPER accumulator name_multiply("));
    EXPECT_EQ(found.find("name_product(accumulator"), found.rfind("name_product(accumulator"));
    EXPECT_THAT(found, Not(HasSubstr("name_finish")));
    EXPECT_EQ(text.helpers({"format"}, "nothing"), "");
}

TEST(Template, WhatIsNotThereIsRefused) {
    HeaderText text = text_of({}, window);
    EXPECT_THROW((void)text.section("history", "no such section"), std::out_of_range);
    EXPECT_THROW((void)text.section("no such chain", "push"), std::out_of_range);
    text.places.erase("NAME");
    EXPECT_THROW((void)text.section("history", "push"), std::out_of_range);
}

}  // namespace
