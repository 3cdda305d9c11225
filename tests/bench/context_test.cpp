// What a result file says of its run, and what a row says of modelled cycles.
#include "bench/run/context.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "bench/run/commit.hpp"
#include "bench/target/target_build.hpp"
#include "bench/target/target_rows.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/effects.hpp"

namespace {

bench::Sweep small() {
    bench::Sweep sweep;
    sweep.kernels = {"ring_plain_f32"};
    sweep.peers = {"peer_std_f32"};
    sweep.orders = {0.5, -0.25};
    sweep.lengths = {{50}, {600, true}};
    sweep.signals = {"step", "noise"};
    sweep.targets = {"host"};
    sweep.cores = {"count"};
    sweep.design_errors = {1e-3};
    sweep.samples = 600;
    sweep.seed = 77;
    return sweep;
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name\t: ")) {
            return line.substr(13);
        }
    }
    return "";
}

// Git refuses what is no repository, as it would be missing on an empty Debian.
TEST(Context, HasTheCommitWithoutGit) {
    const base::Scratch checkout;
    EXPECT_EQ(bench::commit_of(checkout.file("")).hash, "unknown");
    const std::string hash = "0123456789abcdef0123456789abcdef01234567";
    std::filesystem::create_directories(checkout.file(".git/refs/heads"));
    base::write_file(checkout.file(".git/HEAD"), "ref: refs/heads/main\n");
    EXPECT_EQ(bench::commit_of(checkout.file("")).hash, "unknown");
    base::write_file(checkout.file(".git/refs/heads/main"), hash + "\n");
    EXPECT_EQ(bench::commit_of(checkout.file("")).hash, hash);
    EXPECT_EQ(bench::commit_of(checkout.file("")).dirty, "unknown");
    base::write_file(checkout.file(".git/HEAD"), hash + "\n");
    EXPECT_EQ(bench::commit_of(checkout.file("")).hash, hash);
}

TEST(Context, SaysWhatWasRunWhereAndOfWhichBuild) {
    const bench::Json context = bench::make_context({}, small(), {});
    const auto text = [&](const char* field) { return context.at(field).get<std::string>(); };
    EXPECT_EQ(text("schema"), "glsum-results-1");
    EXPECT_TRUE(std::regex_match(text("date"), std::regex("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\d[+-]\\d{4}")));
    EXPECT_FALSE(text("host_name").empty());
    EXPECT_EQ(text("host_name").find('\n'), std::string::npos);
    EXPECT_EQ(text("executable"), "glsum bench");
    EXPECT_EQ(text("library_build_type"), "release");
    EXPECT_TRUE(std::regex_match(text("glsum_version"), std::regex("\\d+\\.\\d+.*"))) << text("glsum_version");
    EXPECT_TRUE(std::regex_match(text("commit"), std::regex("[0-9a-f]{40}|unknown"))) << text("commit");
    EXPECT_TRUE(std::regex_match(text("dirty"), std::regex("true|false|unknown")));
    EXPECT_TRUE(text("dirty") == "unknown" || text("commit") != "unknown");
    EXPECT_NE(text("compiler").find('.'), std::string::npos);
    EXPECT_NE(text("flags").find("-O"), std::string::npos) << text("flags");
    EXPECT_FALSE(text("contraction").empty());
    EXPECT_NE(text("peer_flags").find("-ffast-math"), std::string::npos);
    if (!processor().empty()) {
        EXPECT_EQ(text("cpu"), processor());
    }
    EXPECT_EQ(text("core_file"), "none");
    EXPECT_EQ(text("weights"), "gl");
    for (const char* of_a_board : {"target_compiler", "target_flags", "qemu_version", "elf_sha256", "placement"}) {
        EXPECT_FALSE(context.contains(of_a_board)) << of_a_board;
    }
    EXPECT_EQ(context.at("n_samples"), 600);
    EXPECT_EQ(context.at("seed"), 77);
    EXPECT_EQ(context.at("first_weights"), bench::Json::parse(R"({"0.5": 1.0, "-0.25": 1.0})"));
    EXPECT_EQ(context.at("sweep"), bench::Json::parse(R"({
        "kernels": ["ring_plain_f32"], "peers": ["peer_std_f32"], "orders": [0.5, -0.25], "taps": ["50", "full"],
        "signals": ["step", "noise"], "targets": ["host"], "cores": ["count"], "design_errors": [0.001]})"));
    bench::Sweep other = small();
    other.weights = bench::Discretisation::bdf2;
    EXPECT_EQ(bench::make_context({}, other, {}).at("weights"), "bdf2");
    EXPECT_NEAR(bench::make_context({}, other, {}).at("first_weights").at("0.5").get<double>(), std::sqrt(1.5), 1e-12);
}

// What Google Benchmark says of the machine stays.
TEST(Context, OfATimingIsAddedTo) {
    const bench::Json context = bench::make_context({{"date", "then"}, {"caches", {1, 2}}}, small(), {});
    EXPECT_EQ(context.at("date"), "then");
    EXPECT_EQ(context.at("caches"), bench::Json({1, 2}));
    EXPECT_FALSE(context.contains("host_name"));
    EXPECT_EQ(context.at("schema"), "glsum-results-1");
}

// Of emulated machines: the first's fields have plain names, another's its word before them.
TEST(Context, SaysWhichFirmwareEachMachineRan) {
    const base::Scratch folder;
    std::vector<qemu::Board> boards(base::machines.size());
    for (std::size_t i = 0; i < boards.size(); ++i) {
        boards[i].machine = &base::machines[i];
        boards[i].cores = std::string(TEST_PROJECT) + "/qemu/cores";
        const std::filesystem::path build = folder.file(std::string(base::machines[i].word).c_str());
        std::filesystem::create_directories(build);
        boards[i].measure_elf = build / "measure.elf";
        std::ofstream(boards[i].measure_elf) << (i == 0 ? "abc" : "");
        std::ofstream(build / "build_info.json")
            << R"({"compiler": "GNU )" << 12 + i << R"(", "flags": "-mcpu=)" << base::machines[i].core << "\"}";
    }
    const std::string emulator = folder.file("qemu").string();
    std::ofstream(emulator) << "#!/bin/sh\necho QEMU emulator version 7.2.22\necho and its licence\n";
    std::filesystem::permissions(emulator, std::filesystem::perms::owner_all);
    setenv("GLSUM_QEMU", emulator.c_str(), 1);
    bench::Sweep sweep = small();
    sweep.cores = {"stm32f746-itcm", "count"};
    const bench::Json context = bench::make_context({}, sweep, boards);
    unsetenv("GLSUM_QEMU");
    EXPECT_EQ(context.at("target_compiler"), "GNU 12");
    EXPECT_EQ(context.at("target_flags"), "-mcpu=cortex-m7");
    EXPECT_EQ(context.at("m4_target_compiler"), "GNU 13");
    EXPECT_EQ(context.at("m4_target_flags"), "-mcpu=cortex-m4");
    // The published hashes of "abc" and of nothing.
    EXPECT_EQ(context.at("elf_sha256"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(context.at("m4_elf_sha256"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(context.at("qemu_version"), "QEMU emulator version 7.2.22");
    EXPECT_EQ(context.at("target_count_order"), "0.5");
    EXPECT_TRUE(context.contains("placement"));
    EXPECT_TRUE(
        std::regex_match(context.at("core_file").get<std::string>(), std::regex("stm32f746-itcm sha256:[0-9a-f]{64}")))
        << context.at("core_file");
}

TEST(TargetBuild, IsTheCompilerAndTheFlagsOfTheFirmware) {
    const bench::TargetBuild build = bench::parse_target_build(
        R"({"compiler": "GNU 12.2.1", "flags": "-O3", "more": {"a": [{"b": 1}]}})", "build_info.json");
    EXPECT_EQ(build.compiler, "GNU 12.2.1");
    EXPECT_EQ(build.flags, "-O3");
    const auto of = [](const std::string& compiler, const std::string& flags) {
        return R"({"compiler": ")" + compiler + R"(", "flags": ")" + flags + "\"}";
    };
    // 4096 bytes each, and no more.
    const std::string longest(4096, 'x');
    EXPECT_EQ(bench::parse_target_build(of(longest, longest), "a file").flags, longest);
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            (void)bench::parse_target_build(text, "a file");
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            return failure.what();
        }
        return "not refused";
    };
    EXPECT_EQ(refusal(of(longest + "x", "-O3")), "a file: expected JSON with the text compiler");
    EXPECT_EQ(refusal(of("GNU", longest + "x")), "a file: expected JSON with the text flags");
    EXPECT_EQ(refusal(R"({"compiler": "GNU"})"), "a file: expected JSON with the text flags");
    EXPECT_EQ(refusal(R"({"compiler": "GNU", "flags": 3})"), "a file: expected JSON with the text flags");
    for (const std::string text :
         {"", "[1]", "3", R"({"compiler": "GNU", "flags": "-O3")", R"(["compiler", "flags"])"}) {
        EXPECT_EQ(refusal(text), "a file: expected JSON with the text compiler") << text;
    }
    // Of any depth, and no larger than a build writes it.
    const std::string deep = std::string(8000, '[') + std::string(8000, ']');
    EXPECT_EQ(refusal(R"({"flags": "-O3", "compiler": )" + deep + "}"), "a file: expected JSON with the text compiler");
    EXPECT_EQ(bench::parse_target_build(R"({"compiler": "a", "flags": "b", "c": )" + deep + "}", "a file").flags, "b");
    EXPECT_EQ(refusal(of("GNU", "-O3") + std::string(4 * 4096, ' ')), "a file: expected JSON with the text compiler");
}

TEST(TargetRows, HoldTheModelsFigures) {
    qemu::ModelledCall call{};
    call.cycles = 300.0;
    call.low = 290.0;
    call.high = 330.0;
    call.first_cycles = 900.0;
    call.worst_cycles = 310.0;
    call.latency_cycles = 120.0;
    call.double_in_software = 40.0;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        call.lost[e] = 1.0 + static_cast<double>(e);
    }
    bench::Row made{bench::Json()};
    bench::add_modelled(made, call, 200e6);
    const bench::Json row = std::move(made).take();
    EXPECT_DOUBLE_EQ(row.at("real_time").get<double>(), 1500.0);  // ns, of 5 each
    EXPECT_EQ(row.at("cpu_time"), row.at("real_time"));
    EXPECT_EQ(row.at("model_cycles_per_sample"), 300.0);
    EXPECT_EQ(row.at("model_cycles_low"), 290.0);
    EXPECT_EQ(row.at("model_cycles_high"), 330.0);
    EXPECT_EQ(row.at("first_model_cycles"), 900.0);
    EXPECT_EQ(row.at("worst_model_cycles"), 310.0);
    EXPECT_EQ(row.at("latency_model_cycles"), 120.0);
    EXPECT_EQ(row.at("stall_double_precision_in_software"), 40.0);
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        EXPECT_EQ(row.at("stall_" + std::string(timing::effect_names[e])), 1.0 + static_cast<double>(e));
    }
    EXPECT_EQ(row.size(), 9U + timing::effect_count);
    for (const auto& [field, value] : row.items()) {
        EXPECT_NE(bench::find_counter(field), nullptr) << field;
    }
}

TEST(TargetRows, AskForTheCoresByName) {
    const auto request =
        bench::timing_request(std::string(TEST_PROJECT) + "/qemu/cores", {"stm32f746-itcm", "m7-ideal"});
    ASSERT_EQ(request.cores.size(), 2U);
    EXPECT_EQ(request.cores[0].name, "stm32f746-itcm");
    EXPECT_EQ(request.cores[1].name, "m7-ideal");
    const std::vector<double> clocks = bench::clocks_of(request);
    ASSERT_EQ(clocks.size(), 2U);
    EXPECT_EQ(clocks[0], 216e6);
}

}  // namespace
