// Which measurements of an earlier run hold for this one.
#include "bench/choose/earlier.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "bench/sweep/designs.hpp"

namespace {

// A file on disk for as long as it is needed.
class File {
public:
    explicit File(const bench::Json& context)
        : path_(std::filesystem::temp_directory_path() / ("earlier_test-" + std::to_string(getpid()) + ".json")) {
        bench::write_results(path_, context, {bench::make_row("gl/ring_plain_f32/order:0.5/taps:50/host", 1)});
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

choose::Earlier read(const bench::Json& weights, const std::string& core = "",
                     const std::string& cores_there = "none") {
    bench::Json context = {{"glsum_version", "1"}, {"compiler", "c"},  {"flags", "f"},
                           {"contraction", "off"}, {"n_samples", 60},  {"seed", 2020},
                           {"commit", "c"},        {"dirty", "false"}, {"elf_sha256", "1"}};
    bench::Json there = context;
    if (!weights.is_null()) {
        there["weights"] = weights;
    }
    there["core_file"] = cores_there;
    context["weights"] = "gl";
    context["core_file"] = core;
    const File file(there);
    choose::Question question;
    question.conditions = {0.5, 1e-3, {"step"}, 60, 2020};
    question.results = file.path();
    question.core = core.substr(0, core.find(' '));
    return choose::read_earlier(question, context);
}

TEST(Earlier, OfOtherWeightsNothingIsTaken) {
    for (const bench::Json& weights : {bench::Json("bdf2"), bench::Json("shifted"), bench::Json(7)}) {
        const choose::Earlier earlier = read(weights);
        EXPECT_FALSE(earlier.errors) << weights;
        EXPECT_FALSE(earlier.on_target) << weights;
        EXPECT_TRUE(earlier.rows.empty()) << weights;
        EXPECT_NE(earlier.note.find("its weights are"), std::string::npos) << earlier.note;
    }
    for (const bench::Json& weights : {bench::Json(), bench::Json("gl")}) {  // older files do not say
        const choose::Earlier earlier = read(weights);
        EXPECT_TRUE(earlier.errors) << earlier.note;
        EXPECT_TRUE(earlier.on_target) << earlier.note;
        EXPECT_EQ(earlier.rows.size(), 1U);
    }
}

TEST(Earlier, CyclesAreTakenOfTheVeryCoreFile) {
    const std::string core = "m7-ideal sha256:12";
    for (const char* there : {"m7-ideal sha256:12", "stm32h747-dtcm sha256:5, m7-ideal sha256:12"}) {
        EXPECT_TRUE(read({}, core, there).on_target) << there;
    }
    for (const char* there : {"none", "m7-ideal sha256:13", "stm32h747-dtcm sha256:12"}) {
        const choose::Earlier earlier = read({}, core, there);
        EXPECT_FALSE(earlier.on_target) << there;
        EXPECT_TRUE(earlier.errors) << there;
        EXPECT_NE(earlier.note.find("is not among its cores"), std::string::npos) << earlier.note;
    }
    EXPECT_TRUE(read({}, "", "m7-ideal sha256:13").on_target);  // instructions have no core
}

// What is taken of a file in which these fields are others, and there are all else.
choose::Earlier taken(const bench::Json& changed_there, const bench::Json& changed_here = {}, double step_s = 1e-3) {
    bench::Json there = {{"glsum_version", "1"}, {"compiler", "c"},  {"flags", "f"},
                         {"contraction", "off"}, {"n_samples", 60},  {"seed", 2020},
                         {"commit", "c"},        {"dirty", "false"}, {"elf_sha256", "1"}};
    bench::Json here = there;
    there.update(changed_there.is_null() ? bench::Json::object() : changed_there);
    here.update(changed_here.is_null() ? bench::Json::object() : changed_here);
    const File file(there);
    choose::Question question;
    question.conditions = {0.5, step_s, {"step"}, 60, 2020};
    question.results = file.path();
    return choose::read_earlier(question, here);
}

// Errors are of a host's build, costs of a firmware.
TEST(Earlier, WhatAnotherBuildMeasuredIsMeasuredAfresh) {
    const choose::Earlier same = taken({});
    EXPECT_TRUE(same.errors);
    EXPECT_TRUE(same.on_target);
    EXPECT_NE(same.note.find("errors: of earlier_test-"), std::string::npos) << same.note;
    EXPECT_NE(same.note.find("; instructions: of earlier_test-"), std::string::npos) << same.note;
    for (const char* field : {"glsum_version", "compiler", "flags", "contraction"}) {
        const choose::Earlier other = taken({{field, "other"}});
        EXPECT_FALSE(other.errors) << field;
        EXPECT_TRUE(other.on_target) << field;
        EXPECT_NE(other.note.find(std::string(field) + " is \"other\" there and \""), std::string::npos) << other.note;
        // What this run cannot say of itself is never the same.
        EXPECT_FALSE(taken({{field, ""}}, {{field, ""}}).errors) << field;
    }
    for (const char* field : {"n_samples", "seed"}) {
        EXPECT_FALSE(taken({{field, 7}}).errors) << field;
        EXPECT_TRUE(taken({{field, 7}}).on_target) << field;
    }
    EXPECT_FALSE(taken({}, {}, 2e-3).errors);
    EXPECT_TRUE(taken({}, {}, 2e-3).on_target);
    EXPECT_NE(taken({}, {}, 2e-3).note.find("its records are sampled at 1 ms"), std::string::npos);
}

// Of another firmware the same commit without changes has the same host build; its costs are others.
TEST(Earlier, OfAnotherFirmwareTheCommitDecides) {
    EXPECT_TRUE(taken({{"elf_sha256", "2"}}).errors);
    EXPECT_FALSE(taken({{"elf_sha256", "2"}}).on_target);
    EXPECT_NE(taken({{"elf_sha256", "2"}}).note.find("measured afresh: elf_sha256 is"), std::string::npos);
    EXPECT_FALSE(taken({{"elf_sha256", "2"}, {"commit", "d"}}).errors);
    EXPECT_TRUE(taken({{"commit", "d"}}).errors);
    for (const auto& [there, here] : {std::pair("true", "false"), {"false", "true"}, {"true", "true"}}) {
        EXPECT_FALSE(taken({{"elf_sha256", "2"}, {"dirty", there}}, {{"dirty", here}}).errors) << there << here;
        EXPECT_TRUE(taken({{"dirty", there}}, {{"dirty", here}}).errors) << there << here;
    }
}

TEST(Earlier, WithoutAFileNothingIsTaken) {
    choose::Question question;
    EXPECT_EQ(choose::read_earlier(question, {}).note, "no earlier measurements were asked for");
    question.results = "/nonexistent/baseline.json";
    const choose::Earlier none = choose::read_earlier(question, {});
    EXPECT_EQ(none.note, "baseline.json is not there; everything is measured afresh");
    EXPECT_FALSE(none.errors);
    EXPECT_FALSE(none.on_target);
    question.results_asked_for = true;
    EXPECT_ANY_THROW((void)choose::read_earlier(question, {}));
}

// A row counts where its length is one that would be asked for.
TEST(Earlier, LengthsAreThoseThatWouldBeAskedFor) {
    const auto taps = [](const std::string& kernel, const std::string& length, std::size_t samples) {
        return choose::taps_of(bench::parse_key("gl/" + kernel + "/order:0.5/taps:" + length + "/host").value(), 0.5,
                               samples);
    };
    EXPECT_EQ(taps("ring_plain_f32", "150", 150), 150U);
    EXPECT_EQ(taps("ring_plain_f32", "151", 150), std::nullopt);
    EXPECT_EQ(taps("ring_plain_f32", "full", 150), 150U);
    EXPECT_EQ(taps("modes_plain_f32", "2+7", 5000), 16U);
    EXPECT_EQ(taps("modes_plain_f32", "9+1", 5000), std::nullopt);
    const std::string blocks = bench::length_of("nested_plain_f32", 0.5, 16, 5000).text();
    EXPECT_NE(blocks.find('+'), std::string::npos);
    EXPECT_EQ(taps("nested_plain_f32", blocks, 5000), 16U);
    EXPECT_EQ(taps("nested_plain_f32", "15+1", 5000), std::nullopt);
}

}  // namespace
