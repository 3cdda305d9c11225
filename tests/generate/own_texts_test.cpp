// How texts of headers are put together, on texts that stand here in the place of the kernels'.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "bench/texts/shared.hpp"
#include "bench/texts/template.hpp"

namespace generate {

const std::string_view kernel_sources = R"(int before;
    // C99: sum
        Sample sum = static_cast<Sample>(start > 0 ? start : Format::zero());
        GLSUM_ROLLED
        for (std::size_t i = 0; i < past; ++i) {
            sum = accumulate<Format, fused>(sum, table[i], window.older[i], scale);
        }
#if GLSUM_FAST

        GLSUM_KEEP(sum);
#endif
    // C99 end
int between;
// C99: types
Sample Samples MySample Sample_ my_Sample Output Accumulator Coefficient typename T std::min
if constexpr (a) { Format::template f<1>(x, state.scale); Format::g(Format::zero(), GLSUM_X, xGLSUM_Y); }
static_cast<std::uint32_t>(static_cast<Output>(x) > y)
// C99: extra
number two  spaces;
// C99 end
)";

const std::string_view header_texts = R"(%file-of deep
%# nothing of this
of all sections, and of none alone: @place@
%words number => @sample@
%words "two  spaces" => "one space "
%let both one and two
%section lines
first @place@ and @count@

  last
%section branches
%if one
one
%if two
one and two
%else
one alone
%end
%else
%if two
two alone
%else
none
%end
%end
end
%section let
%if one
%let set true
%else
%let unset true
%end
%if set
set
%end
%if both
both
%end
%if never
@nowhere@
%words number => @nowhere@
%let @nowhere@ true
%nowhere lines
%each nowhere
@nowhere@
%end
%end
%section items
%each item
@item.up@ of @count@
%if item.up > 1
    more
%end
%end
@item.up@
%section statements
  %text sum | table => a | past => 5
%optional extra
%optional none such
%section kept
above
%kept lines | shallow => deep
@kept words@!
%section other
%second lines | shallow => other | P => Q
(@second words@)
%section loops
%file core
%file none
%section helper unused
int @name@_unused(int x);
%section helper twice
int @name@_twice(int x);
%section helper add
int @name@_add(int x) { return @name@_twice(x); }
%section helper empty
%file-of shallow
%section lines
shallow @place@
%section words
kept words

%section helper add
another one
%section helper last
int @name@_last(int x);
%file-of core
#if GLSUM_CORTEX_M4 || GLSUM_M7
GLSUM_X GLSUM_Y
%section never
never
%file-of conditions
%section a < 3
%if a < 3
yes
%end
%section a > 3
%if a > 3
yes
%end
%section a >= 3
%if a >= 3
yes
%end
%section a == 3
%if a == 3
yes
%end
%section a % 4
%if a % 4
yes
%end
%section a < 9
%if a < 9
yes
%end
%section a < 09
%if a < 09
yes
%end
%section a < b
%if a < b
yes
%end
%section not a
%if not a
yes
%end
%section not a < 3
%if not a < 3
yes
%end
%section a and b
%if a and b
yes
%end
%section a or b
%if a or b
yes
%end
%section a and b or c and not d
%if a and b or c and not d
yes
%end
%section a > 1 and a < 4 or b == 2
%if a > 1 and a < 4 or b == 2
yes
%end
%section true
%if true
yes
%end
%section a ! 3
%if a ! 3
yes
%end
%section a < 3x
%if a < 3x
yes
%end
)";

}  // namespace generate

namespace {

using generate::Facts;
using generate::HeaderText;

HeaderText text_of(const Facts& facts = {}) {
    HeaderText text;
    text.facts = facts;
    text.facts["count"] = 7;
    text.places = {{"place", "P"},  {"sample", "float"}, {"name", "own"},
                   {"NAME", "OWN"}, {"call", "own_"},    {"rolled", ""}};
    text.chains = {{"first", {"deep", "absent", "shallow"}}, {"second", {"shallow"}}};
    return text;
}

std::string section(const char* name, const Facts& facts = {}) { return text_of(facts).section("first", name); }

template <class Ask>
std::string refused(Ask ask) {
    try {
        ask();
    } catch (const std::out_of_range& found) {
        return found.what();
    }
    return "";
}

// The first line begins at the indent and the others keep their distance from it, but for those left of it.
TEST(OwnTexts, AStatementIsC99InTheHeadersWords) {
    EXPECT_EQ(generate::shared("sum"),
              "    @sample@ sum = (@sample@)(start > 0 ? start : 0);\n"
              "@rolled@"
              "    for (size_t i = 0; i < past; ++i) {\n"
              "        sum = @call@multiply_add(sum, table[i], older[i]);\n"
              "    }\n"
              "#if @NAME@_FAST\n"
              "\n"
              "    @NAME@_KEEP(sum);\n"
              "#endif\n");
    // What is said of one text comes before what all have alike, the longer word before its beginning.
    const std::string own = generate::shared("sum", {{"Sample", "short"}, {"sum", "s"}, {"sum = ", "s += "}}, 0);
    EXPECT_EQ(own.substr(0, own.find('\n')), "short s += (short)(start > 0 ? start : 0);");
    EXPECT_NE(own.find("\n    s += @call@multiply_add(s, table[i], older[i]);\n"), std::string::npos);
}

TEST(OwnTexts, AWordIsNoPartOfAnother) {
    EXPECT_EQ(generate::shared("types", {}, 0),
              "@sample@ Samples MySample Sample_ my_Sample @output@ @accumulator@ @coefficient@ T min\n"
              "if (a) { @name@_f<1>(x); @name@_g(0, @NAME@_X, xGLSUM_Y); }\n"
              "(uint32_t)((@output@)(x) > y)\n");
}

TEST(OwnTexts, ATextIsFoundByItsWholeName) {
    const std::size_t found = generate::place_of("types");
    ASSERT_NE(found, std::string_view::npos);
    EXPECT_EQ(generate::kernel_sources.substr(found, 15), "Sample Samples ");
    EXPECT_EQ(generate::place_of("type"), std::string_view::npos);
    EXPECT_EQ(refused([] { (void)generate::shared("type"); }), "no kernel has the text type");
    EXPECT_TRUE(generate::has_section("deep", "lines"));
    EXPECT_FALSE(generate::has_section("deep", "line"));
    EXPECT_FALSE(generate::has_section("absent", "lines"));
    EXPECT_FALSE(generate::has_section("core", "lines"));
}

TEST(OwnTexts, LinesAreFilledWithPlacesAndFacts) {
    EXPECT_EQ(section("lines"), "first P and 7\n\n  last\n");
    EXPECT_EQ(text_of().section("second", "lines"), "shallow P\n");
    EXPECT_EQ(text_of().filled("a @first words@ b @count@ @place@"), "a kept words b 7 P");
}

TEST(OwnTexts, BranchesStandWithinEachOther) {
    EXPECT_EQ(section("branches", {{"one", 1}, {"two", 1}}), "one\none and two\nend\n");
    EXPECT_EQ(section("branches", {{"one", 1}}), "one\none alone\nend\n");
    EXPECT_EQ(section("branches", {{"two", 1}}), "two alone\nend\n");
    EXPECT_EQ(section("branches"), "none\nend\n");
}

// What does not stand there decides nothing, and what it names in vain is not missed.
TEST(OwnTexts, AFactIsMadeWhereItsLineStands) {
    HeaderText text = text_of({{"one", 1}});
    EXPECT_EQ(text.section("first", "let"), "set\n");
    EXPECT_EQ(text.facts.at("set"), 1);
    EXPECT_EQ(text.facts.at("both"), 0);
    EXPECT_FALSE(text.facts.contains("unset"));
    HeaderText other = text_of({{"two", 1}});
    EXPECT_EQ(other.section("first", "let"), "");
    EXPECT_FALSE(other.facts.contains("set"));
    EXPECT_EQ(other.facts.at("unset"), 1);
    EXPECT_EQ(section("let", {{"one", 1}, {"two", 1}}), "set\nboth\n");
}

TEST(OwnTexts, ItemsHaveFactsOfTheirOwn) {
    EXPECT_EQ(section("items", {{"item", 2}, {"item.0.up", 1}, {"item.1.up", 3}, {"item.up", 9}}),
              "1 of 7\n3 of 7\n    more\n9\n");
    EXPECT_EQ(section("items", {{"item.up", 9}}), "9\n");
}

TEST(OwnTexts, StatementsTakeTheWordsOfTheirTextAndTheirLine) {
    EXPECT_EQ(section("statements"),
              "  float sum = (float)(start > 0 ? start : 0);\n"
              "  for (size_t i = 0; i < 5; ++i) {\n"
              "      sum = own_multiply_add(sum, a[i], older[i]);\n"
              "  }\n"
              "#if OWN_FAST\n"
              "\n"
              "  OWN_KEEP(sum);\n"
              "#endif\n"
              "float one space ;\n");
}

TEST(OwnTexts, SectionsOfOthersAreTakenWithOtherWords) {
    EXPECT_EQ(section("kept"), "above\ndeep P\nkept words!\n");
    EXPECT_EQ(section("other"), "other Q\n(kept words)\n");
}

// Before its first section, in the header's names but for what is said to all headers at once.
TEST(OwnTexts, AFileIsTakenWhole) { EXPECT_EQ(section("loops"), "#if GLSUM_CORTEX_M4 || OWN_M7\nOWN_X OWN_Y\n"); }

TEST(OwnTexts, HelpersAreThoseThatAreCalledByEachOtherToo) {
    HeaderText text = text_of();
    const std::string twice = "\nint own_twice(int x);\n";
    const std::string add = "\nint own_add(int x) { return own_twice(x); }\n";
    EXPECT_EQ(text.helpers({"first"}, "own_add(1) + own_empty(2)"), twice + add);
    EXPECT_EQ(text.helpers({"first", "second"}, "own_last(own_add(1))"), twice + add + "\nint own_last(int x);\n");
    EXPECT_EQ(text.helpers({"first"}, "own_twice (1) + add(1)"), "");
}

bool yes(const char* condition, const Facts& facts) {
    HeaderText text = text_of(facts);
    text.chains["chain"] = {"conditions"};
    return text.section("chain", condition) == "yes\n";
}

// Each condition is a section that has it and says yes.
TEST(OwnTexts, ComparisonsAreOfNumbersAndFacts) {
    EXPECT_TRUE(yes("a < 3", {{"a", 2}}));
    EXPECT_FALSE(yes("a < 3", {{"a", 3}}));
    EXPECT_TRUE(yes("a > 3", {{"a", 4}}));
    EXPECT_FALSE(yes("a > 3", {{"a", 3}}));
    EXPECT_TRUE(yes("a >= 3", {{"a", 3}}));
    EXPECT_FALSE(yes("a >= 3", {{"a", 2}}));
    EXPECT_TRUE(yes("a == 3", {{"a", 3}}));
    EXPECT_FALSE(yes("a == 3", {{"a", 4}}));
    EXPECT_TRUE(yes("a % 4", {{"a", 5}}));
    EXPECT_TRUE(yes("a % 4", {{"a", 7}}));
    EXPECT_FALSE(yes("a % 4", {{"a", 8}}));
    EXPECT_TRUE(yes("a < 9", {{"a", 8}}));
    EXPECT_FALSE(yes("a < 9", {{"a", 9}}));
    EXPECT_TRUE(yes("a < 09", {{"a", 8}}));
    EXPECT_TRUE(yes("a < b", {{"a", 2}, {"b", 3}}));
    EXPECT_FALSE(yes("a < b", {{"a", 3}, {"b", 3}}));
    EXPECT_FALSE(yes("a < b", {{"a", 1}}));
}

TEST(OwnTexts, AndBindsCloserThanOr) {
    EXPECT_TRUE(yes("not a", {}));
    EXPECT_TRUE(yes("not a", {{"a", 0}}));
    EXPECT_FALSE(yes("not a", {{"a", 2}}));
    EXPECT_FALSE(yes("not a < 3", {{"a", 2}}));
    EXPECT_TRUE(yes("not a < 3", {{"a", 3}}));
    EXPECT_TRUE(yes("true", {}));
    for (int bits = 0; bits < 16; ++bits) {
        const bool a = (bits & 1) != 0;
        const bool b = (bits & 2) != 0;
        const bool c = (bits & 4) != 0;
        const bool d = (bits & 8) != 0;
        const Facts facts = {{"a", a ? 1 : 0}, {"b", b ? 1 : 0}, {"c", c ? 1 : 0}, {"d", d ? 1 : 0}};
        EXPECT_EQ(yes("a and b", facts), a && b) << bits;
        EXPECT_EQ(yes("a or b", facts), a || b) << bits;
        EXPECT_EQ(yes("a and b or c and not d", facts), (a && b) || (c && !d)) << bits;
    }
    for (long a = 0; a < 6; ++a) {
        for (long b = 0; b < 4; ++b) {
            EXPECT_EQ(yes("a > 1 and a < 4 or b == 2", {{"a", a}, {"b", b}}), (a > 1 && a < 4) || b == 2)
                << a << ' ' << b;
        }
    }
}

TEST(OwnTexts, WhatIsNamedInVainIsTold) {
    EXPECT_EQ(refused([] { (void)section("none"); }), "texts of headers: no none in first");
    EXPECT_EQ(refused([] { (void)text_of().filled("@x y@"); }), "texts of headers: no place x y");
    EXPECT_EQ(refused([] { (void)yes("a ! 3", {}); }), "texts of headers: no sign !");
    EXPECT_EQ(refused([] { (void)yes("a < 3x", {}); }), "no number");
}

}  // namespace
