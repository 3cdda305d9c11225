// Reading result files: what is whole is read to the last row, what is broken is told apart by kind and place.
#include "bench/result_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "bench/results.hpp"
#include "qemu/failure.hpp"

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
    try {
        (void)bench::parse_results(text, "a.json");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    ADD_FAILURE() << "not refused: " << text.substr(0, 200);
    return "";
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

}  // namespace
