// Reading result files: what is whole is read to the last row, what is broken is told apart by kind and place.
#include "bench/rows/result_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/refusal.hpp"

namespace {

using testing::HasSubstr;

bench::Json row(const std::string& name) {
    bench::Json row = bench::make_row(name, 1);
    row["error_max"] = 1e-6;
    return row;
}

std::string file_of(const std::vector<bench::Json>& rows) {
    bench::Json file;
    file["context"] = {{"compiler", "GNU 12.2.0"}, {"caches", bench::Json::array({{{"level", 1}}})}};
    file["benchmarks"] = rows;
    return file.dump(2) + "\n";
}

// What the refusal says; fails where there is none.
std::string refusal(const std::string& text) {
    return test::refusal(glsum::Exit::bad_input, [&] { (void)bench::parse_results(text, "a.json"); });
}

TEST(ResultFile, IsReadBackAsWritten) {
    const auto path = std::filesystem::temp_directory_path() / ("glsum_result_file." + std::to_string(getpid()));
    const std::vector<bench::Json> rows = {row("gl/a/order:0.5/taps:50/accuracy/signal:step"), row("b")};
    bench::write_results(path, {{"compiler", "x"}}, rows);
    const bench::Results results = bench::read_results(path);
    std::filesystem::remove(path);
    EXPECT_EQ(results.context, bench::Json({{"compiler", "x"}}));
    EXPECT_EQ(results.rows, rows);
}

TEST(ResultFile, RepetitionsAndAggregatesShareAName) {
    bench::Json first = row("a");
    bench::Json second = row("a");
    second["repetition_index"] = 1;
    bench::Json mean = row("a");
    mean["aggregate_name"] = "mean";
    EXPECT_EQ(bench::parse_results(file_of({first, second, mean}), "a.json").rows.size(), 3u);
    EXPECT_THAT(refusal(file_of({first, second, second})), HasSubstr("row 3 of benchmarks: the name a is there twice"));
}

TEST(ResultFile, EveryCutIsCalledACut) {
    const std::string whole = file_of({row("a"), row("b")});
    const std::size_t end = whole.find_last_of('}');
    for (std::size_t size = 1; size <= end; ++size) {
        EXPECT_THAT(refusal(whole.substr(0, size)), HasSubstr("ends in the middle")) << size << " bytes";
    }
    EXPECT_THAT(refusal(""), HasSubstr("found an empty one"));
}

TEST(ResultFile, NamesTheLineOfANaN) {
    for (const std::string word : {"NaN", "-nan", "Infinity", "-Infinity", "inf"}) {
        std::string text = file_of({row("a"), row("b")});
        const std::size_t at = text.rfind("1e-06");
        ASSERT_NE(at, std::string::npos);
        text.replace(at, 5, word);
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        EXPECT_EQ(refusal(text), "a.json:" + std::to_string(line) + ": expected a finite number, found " + word);
    }
    std::string text = file_of({row("a")});
    text.replace(text.rfind("1e-06"), 5, "1e999");
    EXPECT_THAT(refusal(text), HasSubstr("beyond double precision"));
}

TEST(ResultFile, OtherFilesAreRefusedWithAReason) {
    EXPECT_THAT(refusal("{\"context\": {}, \"benchmarks\": [}"), HasSubstr("a.json:1: expected JSON, found"));
    EXPECT_THAT(refusal("[1, 2]"), HasSubstr("found other JSON"));
    EXPECT_THAT(refusal("{\"context\": 3, \"benchmarks\": []}"), HasSubstr("context: expected an object"));
    EXPECT_THAT(refusal("{\"context\": {}}"), HasSubstr("found other JSON"));
    EXPECT_THAT(refusal("{\"benchmarks\": 3}"), HasSubstr("found other JSON"));
    EXPECT_THAT(refusal("{\"benchmarks\": {}}"), HasSubstr("found other JSON"));
    EXPECT_THAT(refusal("3"), HasSubstr("found other JSON"));
    EXPECT_THAT(refusal("{\"benchmarks\": [], \"benchmarks\": []}"), HasSubstr("benchmarks is there twice"));
    EXPECT_THAT(refusal("{\"context\": {}, \"benchmarks\": [3]}"),
                HasSubstr("row 1 of benchmarks: expected an object with a name, found 3"));
    EXPECT_THAT(refusal("{\"context\": {}, \"benchmarks\": [[]]}"),
                HasSubstr("row 1 of benchmarks: expected an object with a name, found []"));
    EXPECT_THAT(refusal("{\"context\": {}, \"benchmarks\": [{\"name\": \"a\", \"x\": [1]}]}"),
                HasSubstr("(a): x: expected"));
    EXPECT_THAT(refusal("{\"context\": {\"a\": " + std::string(100000, '[')), HasSubstr("nested"));
    EXPECT_THAT(refusal(file_of({row(std::string(bench::ResultLimits::text + 1, 'a'))})),
                HasSubstr("texts of at most"));
    EXPECT_THAT(refusal("{\"benchmarks\": [{\"name\": \"a\", \"error_occurred\": 1}]}"),
                HasSubstr("(a): error_occurred: expected a boolean, found 1"));
    EXPECT_THAT(refusal("{\"benchmarks\": [{\"label\": true, \"name\": \"a\"}]}"),
                HasSubstr("label: expected a text, found true"));
    EXPECT_THAT(refusal("{\"benchmarks\": [{\"name\": \"a\", \"x\": null}]}"), HasSubstr("(a): x: expected"));
    EXPECT_THAT(refusal("{\"benchmarks\": [{\"name\": \"a\", \"state_bytes\": \"two\"}]}"),
                HasSubstr("row 1 of benchmarks (a): state_bytes: expected a finite number, found \"two\""));
    EXPECT_THAT(refusal("{\"benchmarks\": [{\"name\": \"a\", \"stall_load_use\": false}]}"),
                HasSubstr("(a): stall_load_use: expected a finite number, found false"));
    EXPECT_THAT(refusal("{\"context\": {\"commit\": 3}, \"benchmarks\": []}"),
                HasSubstr("a.json: context: commit: expected a text, found 3"));
    EXPECT_THAT(refusal("{\"context\": {\"history\": {}}, \"benchmarks\": []}"),
                HasSubstr("history: expected an array, found {}"));
    std::string many = "{\"context\": {\"a\": [0";
    for (std::size_t i = 0; i < bench::ResultLimits::context_values; ++i) {
        many += ",0";
    }
    EXPECT_THAT(refusal(many + "]}, \"benchmarks\": []}"), HasSubstr("context: expected at most 100000 values"));
    bench::Json wide = row("a");
    for (std::size_t i = 0; i <= bench::ResultLimits::fields; ++i) {
        wide["counter" + std::to_string(i)] = 1;
    }
    EXPECT_THAT(refusal(file_of({wide})), HasSubstr("row 1: expected at most 256 fields"));
    EXPECT_THROW((void)bench::read_results("/nonexistent/a.json"), glsum::Failure);
}

// What is refused beyond a bound is read at it.
TEST(ResultFile, AtTheBoundsEverythingIsRead) {
    using bench::ResultLimits;
    bench::Json wide = row("a");
    while (wide.size() < ResultLimits::fields) {
        wide["counter" + std::to_string(wide.size())] = 1;
    }
    const std::string name(ResultLimits::text, 'n');
    const bench::Results results = bench::parse_results(file_of({wide, row(name), row("b")}), "a.json");
    ASSERT_EQ(results.rows.size(), 3U);
    EXPECT_EQ(results.rows[0], wide);
    EXPECT_EQ(results.rows[1].at("name"), name);
    wide["one_more"] = 1;
    EXPECT_THAT(refusal(file_of({row("b"), wide})), HasSubstr("row 2: expected at most 256 fields"));
    // Six deep: the file, its context, and four of the context's own.
    EXPECT_EQ(bench::parse_results(R"({"context": {"a": {"b": [[{}, 7]]}}, "benchmarks": []})", "a.json").context,
              bench::Json::parse(R"({"a": {"b": [[{}, 7]]}})"));
    EXPECT_THAT(refusal(R"({"context": {"a": {"b": [[[[]]]]}}, "benchmarks": []})"), HasSubstr("nested 7 deep"));
    std::string many = R"({"context": {"a": [0)";
    for (std::size_t i = 2; i < ResultLimits::context_values; ++i) {  // the array counts as well
        many += ",0";
    }
    EXPECT_EQ(bench::parse_results(many + R"(]}, "benchmarks": []})", "a.json").context.at("a").size(),
              ResultLimits::context_values - 1);
    EXPECT_THAT(refusal(many + R"(,0]}, "benchmarks": []})"), HasSubstr("context: expected at most 100000 values"));
}

// What no row nor context is, is passed over whole: other programs add parts of their own.
TEST(ResultFile, OtherPartsAreNoneOfOurs) {
    const bench::Results results = bench::parse_results(
        R"({"more": {"x": [1, {"name": "no row"}], "y": null}, "context": {"a": [1, {"b": 2}], "c": null, "d": "e"},
            "benchmarks": [{"name": "a", "flag": true, "text": "t", "negative": -3, "positive": 3, "real": 0.5}]})",
        "a.json");
    EXPECT_EQ(results.context, bench::Json::parse(R"({"a": [1, {"b": 2}], "c": null, "d": "e"})"));
    ASSERT_EQ(results.rows.size(), 1U);
    EXPECT_EQ(
        results.rows[0],
        bench::Json::parse(R"({"name": "a", "flag": true, "text": "t", "negative": -3, "positive": 3, "real": 0.5})"));
}

TEST(ResultFile, PartsComeInAnyOrderButOnce) {
    const bench::Results turned =
        bench::parse_results(R"({"benchmarks": [{"name": "a"}], "context": {"b": {"c": 1}}})", "a.json");
    EXPECT_EQ(turned.context, bench::Json::parse(R"({"b": {"c": 1}})"));
    ASSERT_EQ(turned.rows.size(), 1U);
    EXPECT_EQ(turned.rows[0], bench::Json::parse(R"({"name": "a"})"));
    EXPECT_EQ(bench::parse_results(R"({"benchmarks": []})", "a.json").context, bench::Json::object());
    EXPECT_EQ(refusal(R"({"context": {}, "benchmarks": [], "context": {}})"), "a.json: context is there twice");
}

TEST(ResultFile, ARowIsAnObjectWithAName) {
    EXPECT_EQ(refusal(R"({"benchmarks": [{"name": "a"}, {}]})"),
              "a.json: row 2 of benchmarks: expected an object with a name, found {}");
    EXPECT_EQ(refusal(R"({"benchmarks": [{}]})"),
              "a.json: row 1 of benchmarks: expected an object with a name, found {}");
    EXPECT_EQ(refusal(R"({"benchmarks": [{"x": 1}]})"),
              "a.json: row 1 of benchmarks: expected an object with a name, found {\"x\":1}");
    EXPECT_EQ(refusal(R"({"benchmarks": [{"name": ""}]})"),
              "a.json: row 1 of benchmarks: expected an object with a name, found {\"name\":\"\"}");
}

// Of a long value its beginning is shown, of broken JSON what stands about the place, with nothing a terminal obeys.
TEST(ResultFile, MessagesShowTheirPlaceAndNoMore) {
    const std::string digits = "0123456789012345678901234567890123456789012345678901234567890123456789";
    const std::string shown = "[12345678,\"" + digits.substr(0, 49);  // 60 letters
    const std::string value = "[12345678,\"" + digits + "\"]";
    EXPECT_TRUE(refusal("{\"context\": {\"commit\": " + value + "}, \"benchmarks\": []}")
                    .ends_with("expected a text, found " + shown));
    EXPECT_TRUE(refusal("{\"context\": \"" + digits + "\", \"benchmarks\": []}")
                    .ends_with("expected an object, found \"" + digits.substr(0, 59)));
    EXPECT_TRUE(refusal("{\"benchmarks\": [\"" + digits + "\"]}").ends_with("found \"" + digits.substr(0, 59)));
    EXPECT_TRUE(refusal("{\"benchmarks\": [{\"name\": \"a\", \"state_bytes\": \"" + digits + "\"}]}")
                    .ends_with("found \"" + digits.substr(0, 59)));
    // Twelve letters to the one that is wrong, here a bare tab, and twelve behind it.
    EXPECT_EQ(refusal("{\"context\": {},\n\"ab\tdefghijk?mnopqrstuvwxyz0123456789"),
              "a.json:2: expected JSON, found 't\": {}, \"ab defghijk?mno'");
    EXPECT_EQ(refusal("{\x7f\"a\": 1}"), "a.json:1: expected JSON, found '{ \"a\": 1}'");
    EXPECT_EQ(refusal("{\"a\" 1 }"), "a.json:1: expected JSON, found '{\"a\" 1 }'");
}

TEST(ResultFile, ANumberThatIsNoneIsFoundWhereverItStands) {
    EXPECT_EQ(refusal("NaN"), "a.json:1: expected a finite number, found NaN");
    EXPECT_EQ(refusal("\n-Infinity"), "a.json:2: expected a finite number, found -Infinity");
    EXPECT_EQ(refusal("{\"context\": nan}"), "a.json:1: expected a finite number, found nan");
    EXPECT_THAT(refusal("{\"context\": nano}"), HasSubstr("expected JSON, found"));  // begins like one
    EXPECT_THAT(refusal(" \n\t\r"), HasSubstr("found an empty one"));
}

}  // namespace
