// Which measurements of an earlier run hold for this one.
#include "bench/choose/earlier.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

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

}  // namespace
