// Fields, quotes and separators of a CSV file, line by line, and decimal commas that look like separators.
#include "drive/csv_dialect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drive/decimal_pairs.hpp"
#include "tests/drive/refused.hpp"

namespace {

using drive::Field;
using drive::Separator;
using testing::ElementsAre;
using testing::HasSubstr;
using Texts = std::vector<std::string>;
using test::refusal_of;

// Each field's text, quoted ones between < and >; nothing where a quote has no end.
std::optional<Texts> split(std::string_view line, Separator separator) {
    std::vector<Field> fields = {{"of the line before", true}};
    if (!drive::split_fields(line, separator, fields)) {
        return std::nullopt;
    }
    Texts texts;
    for (const Field& field : fields) {
        texts.push_back(field.quoted ? '<' + std::string(field.text) + '>' : std::string(field.text));
    }
    return texts;
}

TEST(CsvFields, StandBetweenTheirSeparators) {
    EXPECT_EQ(split("a,b", Separator::comma), (Texts{"a", "b"}));
    EXPECT_EQ(split("a", Separator::comma), (Texts{"a"}));
    EXPECT_EQ(split("", Separator::comma), (Texts{""}));
    EXPECT_EQ(split(",", Separator::comma), (Texts{"", ""}));
    EXPECT_EQ(split("a,", Separator::comma), (Texts{"a", ""}));
    EXPECT_EQ(split(",,a", Separator::comma), (Texts{"", "", "a"}));
    EXPECT_EQ(split(" a\t,\tb c ", Separator::comma), (Texts{"a", "b c"}));
    EXPECT_EQ(split("1,5;2", Separator::semicolon), (Texts{"1,5", "2"}));
    EXPECT_EQ(split("a b \t c\t\td", Separator::tab), (Texts{"a b", "c", "", "d"}));
    EXPECT_EQ(split("\t", Separator::tab), (Texts{"", ""}));
    // A run of blanks and tabs is one separator, and none at the ends of a line.
    EXPECT_EQ(split("  a \t b\tc,d  ", Separator::blank), (Texts{"a", "b", "c,d"}));
    EXPECT_EQ(split("a", Separator::blank), (Texts{"a"}));
}

TEST(CsvFields, BetweenQuotesHoldAnything) {
    EXPECT_EQ(split("\"a,b\",c", Separator::comma), (Texts{"<a,b>", "c"}));
    EXPECT_EQ(split("\"a\" ,\t\"b\"", Separator::comma), (Texts{"<a>", "<b>"}));
    EXPECT_EQ(split("\"a\",", Separator::comma), (Texts{"<a>", ""}));
    EXPECT_EQ(split("x,\" a \" ", Separator::comma), (Texts{"x", "<a>"}));
    EXPECT_EQ(split("\"\",\"\"", Separator::comma), (Texts{"<>", "<>"}));
    EXPECT_EQ(split("\"a\"\"b\",\"\"\"\"", Separator::comma), (Texts{"<a\"\"b>", "<\"\">"}));
    EXPECT_EQ(split("a\"b", Separator::comma), (Texts{"a\"b"}));  // a quote within a field is a letter
    EXPECT_EQ(split("\"a\tb\" \tc", Separator::tab), (Texts{"<a\tb>", "c"}));
    EXPECT_EQ(split("\"a b\" \"c\"\td", Separator::blank), (Texts{"<a b>", "<c>", "d"}));
    EXPECT_EQ(split("\"a b\"", Separator::blank), (Texts{"<a b>"}));
}

TEST(CsvFields, OfQuotesThatDoNotEndTheirFieldAreNone) {
    for (const char* line : {"\"", "\"a", "\"a\"\"", "\"a\"b", "\"a\" b,c", "a,\"b", "a,\"b\"c,d"}) {
        EXPECT_EQ(split(line, Separator::comma), std::nullopt) << line;
    }
    EXPECT_EQ(split("\"a\"b", Separator::blank), std::nullopt);
    EXPECT_EQ(split("\"a\"\"b\" c\" \"d", Separator::blank), std::nullopt);
}

// Quotes that were doubled between quotes are one each; elsewhere they are as they stand.
TEST(CsvFields, HaveTheirQuotesOnce) {
    EXPECT_EQ(drive::text_of({"a\"\"b", true}), "a\"b");
    EXPECT_EQ(drive::text_of({"\"\"\"\"", true}), "\"\"");
    EXPECT_EQ(drive::text_of({"\"\"a\"\"", true}), "\"a\"");
    EXPECT_EQ(drive::text_of({"a\"\"b", false}), "a\"\"b");
}

TEST(CsvSeparator, IsNamedInAWord) {
    EXPECT_EQ(drive::separator_named("comma"), Separator::comma);
    EXPECT_EQ(drive::separator_named("semicolon"), Separator::semicolon);
    EXPECT_EQ(drive::separator_named("tab"), Separator::tab);
    EXPECT_EQ(drive::separator_named("blank"), Separator::blank);
    EXPECT_EQ(refusal_of([] { (void)drive::separator_named(""); }),
              "--separator: expected comma, semicolon, tab or blank, found nothing");
}

// By commas two fields each, until a line comes that has no comma: it counts among the first 64 lines.
TEST(CsvSeparator, IsFoundByTheFirst64Lines) {
    const auto found = [](int before) {
        std::string text;
        for (int i = 0; i < before; ++i) {
            text += "a,b;c\n";
        }
        return drive::find_separator(text + "a;b\n", "l.csv");
    };
    EXPECT_EQ(found(63), Separator::semicolon);
    EXPECT_EQ(found(64), Separator::comma);
}

TEST(CsvSeparator, GivesTheLargestShareOfNumbers) {
    const auto found = [](const std::string& line) {
        return drive::find_separator(line + "\n" + line + "\n", "l.csv");
    };
    EXPECT_EQ(found("1,x;y"), Separator::comma);
    EXPECT_EQ(found("x,y;1"), Separator::semicolon);
    EXPECT_EQ(found("1 2\t3"), Separator::blank);
    EXPECT_EQ(found("1\t2"), Separator::tab);           // a tab is a blank, too
    EXPECT_EQ(found("1;2;x;y;z,5"), Separator::comma);  // two of five by semicolons, one of two by commas
    // Commas and semicolons are equally good, one of two; blanks are better, three of five.
    EXPECT_EQ(found("1,a 3 4 5 b;2"), Separator::blank);
    EXPECT_THAT(refusal_of([&] { (void)found("1,x;2"); }), HasSubstr("--separator comma or semicolon decides"));
    EXPECT_THAT(refusal_of([&] { (void)found("1,x y\t2"); }), HasSubstr("--separator comma or tab decides"));
    EXPECT_THAT(refusal_of([&] { (void)found("1,x 2"); }), HasSubstr("--separator comma or blank decides"));
    EXPECT_EQ(found("x,y;z"), Separator::comma);  // without numbers nothing tells them apart, and the first is taken
}

// Of separators that are equally good the likeliest two are named: blanks never, where the file has tabs.
TEST(CsvSeparator, IsAskedForByTheLikeliestNames) {
    const auto asked = [](const std::string& line) {
        return refusal_of([&] { (void)drive::find_separator(line + "\n" + line + "\n", "l.csv"); });
    };
    EXPECT_EQ(asked("1,x\t2"),
              "l.csv:2: 2 fields by comma: '1', 'x\t2', or 2 fields by tab: '1,x', '2'? --separator comma or tab "
              "decides");
    EXPECT_THAT(asked("1;x\t2"), HasSubstr("--separator semicolon or tab decides"));
    EXPECT_THAT(asked("1,5;x\t2"), HasSubstr("--separator comma or semicolon decides"));
}

TEST(CsvSeparator, GivesEachLineEquallyManyFields) {
    // Two of five are numbers by commas, but unevenly; one of four by semicolons.
    EXPECT_EQ(drive::find_separator("a,b;c\n1;2,3,4\n", "l.csv"), Separator::semicolon);
    // Where no separator does, that of the first line is taken.
    EXPECT_EQ(drive::find_separator("a,b\n1,2,3\n", "l.csv"), Separator::comma);
    EXPECT_EQ(drive::find_separator("a;b\n1\n", "l.csv"), Separator::semicolon);
    // What leaves a quote open splits no line.
    EXPECT_EQ(drive::find_separator("\"a\" b,c\n", "l.csv"), Separator::blank);
    EXPECT_EQ(refusal_of([] { (void)drive::find_separator("# none\nvalues\n1\n", "l.csv"); }),
              "l.csv:3: expected columns apart by commas, semicolons, tabs or blanks, found one: 'values'");
    EXPECT_THAT(refusal_of([] { (void)drive::find_separator("", "l.csv"); }), HasSubstr("found one: nothing"));
}

std::vector<Field> by_commas(std::string_view line) {
    std::vector<Field> fields;
    EXPECT_TRUE(drive::split_fields(line, Separator::comma, fields)) << line;
    return fields;
}

TEST(DecimalCommas, JoinFieldsInTwos) {
    Texts joined;
    for (const Field& field : drive::joined_pairs(by_commas("0,5,-1,25,3,0"))) {
        EXPECT_FALSE(field.quoted);
        joined.emplace_back(field.text);
    }
    EXPECT_THAT(joined, ElementsAre("0,5", "-1,25", "3,0"));
}

TEST(DecimalCommas, AreShownAsFarAsALineCanHaveThem) {
    const auto said = [](std::string_view line, std::size_t expected) {
        return drive::as_decimal_commas(by_commas(line), expected);
    };
    const std::string otherwise = "; quote such fields or put semicolons between them";
    EXPECT_EQ(said("1,5,2", 2), ": with decimal commas it may be '1,5 2' or '1 5,2'" + otherwise);
    EXPECT_EQ(said("1,5,2,5", 3), ": with decimal commas it may be '1,5 2 5' or '1 5,2 5' or '1 5 2,5'" + otherwise);
    EXPECT_EQ(said("1,5,2,5", 2), ": with decimal commas it may be '1,5 2,5'; --decimal comma reads it so");
    EXPECT_EQ(said("a,5,2", 2), ": with decimal commas it may be 'a 5,2'" + otherwise);
    EXPECT_EQ(said("1,5,b", 2), ": with decimal commas it may be '1,5 b'" + otherwise);
    EXPECT_EQ(said("1,5,", 2), ": with decimal commas it may be '1,5 '" + otherwise);
    // Too few fields, too many for twos, none that can be joined, quotes that say where a field ends.
    EXPECT_EQ(said("1,5", 2), "");
    EXPECT_EQ(said("1,5,2,5,3", 2), "");
    EXPECT_EQ(said("a,b,c", 2), "");
    EXPECT_EQ(said("1,5,\"2\"", 2), "");
    // Up to 16 fields.
    const std::string fifteen = "a,b,c,d,e,f,g,h,i,j,k,l,m,n,1";
    EXPECT_EQ(said(fifteen + ",5", 15),
              ": with decimal commas it may be 'a b c d e f g h i j k l m n 1,5'" + otherwise);
    EXPECT_EQ(said("o," + fifteen + ",5", 16), "");
}

TEST(DecimalCommas, AreSuspectedWhereAWholeNumberBeginsWithNought) {
    const auto said = [](const std::vector<std::string>& lines) {
        drive::CommaDoubt doubt;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            doubt.see(by_commas(lines[i]), 3 + i);
        }
        return refusal_of([&] { doubt.refuse_if_any("l.csv"); });
    };
    EXPECT_EQ(said({"0,5,1,2", "0,05,1,03", "0,07,1,04"}),
              "l.csv:4: expected a header or decimal points, found '05' in '0,05,1,03': 4 fields, or fewer with "
              "decimal commas? --decimal point or comma decides");
    EXPECT_THAT(said({"1,00"}), HasSubstr("l.csv:3: expected a header or decimal points, found '00' in '1,00': 2"));
    EXPECT_EQ(said({}), "accepted");
    EXPECT_EQ(said({"0,0,10,-05,x5"}), "accepted");
    // A point or a quote in any line tells that the commas stand between fields.
    EXPECT_EQ(said({"0,05", "0.5,1"}), "accepted");
    EXPECT_EQ(said({"1.,5", "0,05"}), "accepted");
    EXPECT_EQ(said({"0,05", "\"0\",1"}), "accepted");
}

}  // namespace
