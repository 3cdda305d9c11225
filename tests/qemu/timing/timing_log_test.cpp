// The log between the emulator and its judge: written as documented, joined where calls are alike, refused where it is
// damaged; and what a request changes of a core file.
#include "qemu/timing/timing_log.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "base/failure.hpp"
#include "tests/refusal.hpp"

namespace {

timing::CoreTime core_time(std::vector<std::int64_t> half_cycles, std::int64_t first_loss, std::int64_t in_double) {
    timing::CoreTime time;
    time.half_cycles = std::move(half_cycles);
    for (std::size_t e = 0; e < time.losses.size(); ++e) {
        time.losses[e] = first_loss + static_cast<std::int64_t>(e);
    }
    time.double_in_software = in_double;
    return time;
}

std::string losses_from(int first) {
    std::string text;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        text += ' ' + std::to_string(first + static_cast<int>(e));
    }
    return text;
}

TEST(TimingLog, JoinsCallsThatAreAlikeInEverything) {
    const timing::TimedCall call{0x100, 7, {core_time({20, 18, 22}, 100, 3), core_time({30}, 200, 0)}};
    timing::TimedCall other = call;
    std::ostringstream out;
    timing::TimingLogWriter writer(out);
    writer.add(call);
    writer.add(call);
    const auto change = [&](auto how) {
        other = call;
        how(other);
        writer.add(other);
        writer.add(call);
    };
    change([](auto& c) { c.entry = 0x102; });
    change([](auto& c) { c.instructions = 8; });
    change([](auto& c) { c.cores[1].half_cycles[0] = 31; });
    change([](auto& c) { c.cores[1].losses[0] = 0; });
    change([](auto& c) { c.cores.pop_back(); });
    writer.finish(timing::CallTimer({}, {}, [](const timing::TimedCall&) {}));
    const std::string first = "core 3 20 18 22" + losses_from(100) + " 3";
    const std::string whole = first + " core 1 30" + losses_from(200) + " 0\n";
    std::string changed = losses_from(200);
    changed.replace(0, 4, " 0");
    EXPECT_EQ(out.str(), "calls 2 256 7 " + whole + "calls 1 258 7 " + whole + "calls 1 256 7 " + whole +
                             "calls 1 256 8 " + whole + "calls 1 256 7 " + whole + "calls 1 256 7 " + first +
                             " core 1 31" + losses_from(200) + " 0\ncalls 1 256 7 " + whole + "calls 1 256 7 " + first +
                             " core 1 30" + changed + " 0\ncalls 1 256 7 " + whole + "calls 1 256 7 " + first +
                             "\ncalls 1 256 7 " + whole + "end\n");
    std::istringstream in(out.str());
    const timing::TimingLog log = timing::read_timing_log(in);
    ASSERT_EQ(log.runs.size(), 11U);
    EXPECT_EQ(log.runs[0].calls, 2U);
    EXPECT_EQ(log.runs[1].call.entry, 0x102U);
    EXPECT_EQ(log.runs[3].call.instructions, 8U);
    EXPECT_EQ(log.runs[0].call.cores, call.cores);
    EXPECT_EQ(log.runs[9].call.cores.size(), 1U);
    EXPECT_FALSE(log.recursive);
    EXPECT_FALSE(log.unfinished);
    EXPECT_TRUE(log.hot.empty());
}

TEST(TimingLog, HoldsWhatElseWasSeen) {
    std::istringstream in(
        "at 770\nfault 768\nhot 1 256 40 load_use 3\nhot 1 258 2 single_issue 0\nhot 0 256 6 store_buffer 6\nunknown "
        "512 "
        "9\nopen 772\nmisused 774 770\nrecursive\nunfinished\nend\ncalls x\n");
    const timing::TimingLog log = timing::read_timing_log(in);
    ASSERT_EQ(log.hot.size(), 2U);
    EXPECT_EQ(log.hot[0], (std::map<std::uint32_t, timing::HotSpot>{{256, {6, timing::Effect::store_buffer, 6}}}));
    EXPECT_EQ(log.hot[1], (std::map<std::uint32_t, timing::HotSpot>{{256, {40, timing::Effect::load_use, 3}},
                                                                    {258, {2, timing::Effect::single_issue, 0}}}));
    EXPECT_EQ(log.unknown, (std::map<std::uint32_t, std::uint64_t>{{512, 9}}));
    EXPECT_EQ(log.last_address, 770U);
    EXPECT_EQ(log.fault, 768U);
    EXPECT_TRUE(log.recursive);
    EXPECT_TRUE(log.unfinished);
    EXPECT_EQ(log.open_stretch, 772U);
    EXPECT_EQ(log.misused_mark, (qemu::MisusedMark{774, 770}));
    EXPECT_TRUE(log.runs.empty());
}

TEST(TimingLog, RefusesDamagedLines) {
    const std::string core = " core 1 30" + losses_from(200) + " 0";
    for (const std::string& line :
         {std::string("calls 0 256 7") + core, std::string("calls 1 256"), "calls 1 256 7" + core + " core 1",
          "calls 1 256 7 cone 1 30" + losses_from(200) + " 0", "calls 1 256 7 core 1 30" + losses_from(200),
          std::string("hot 0 256"), std::string("hot 1001 256 1 load_use 0"), std::string("hot x 256 1 load_use 0"),
          std::string("hot 0 256 1 no_effect 0"), std::string("hot 0 256 1 load_use"),
          "calls 1 256 7" + core + " sets 2 1", std::string("calls 1 256 7 sets 1 1"), std::string("unknown 512"),
          std::string("at"), std::string("fault x"), std::string("open"), std::string("misused"),
          std::string("other 1"), std::string()}) {
        std::istringstream in(line + "\nend\n");
        EXPECT_THROW((void)timing::read_timing_log(in), std::runtime_error) << line;
    }
    for (const std::string& line : {"calls 1 256 7" + core, "calls 1 256 7" + core + " sets 2 1 2" + core,
                                    std::string("hot 1000 256 1 load_use 0"), std::string("unknown 512 1")}) {
        std::istringstream in(line + "\nend\n");
        EXPECT_NO_THROW((void)timing::read_timing_log(in)) << line;
        std::istringstream cut(line + "\n");
        EXPECT_THROW((void)timing::read_timing_log(cut), std::runtime_error) << line;
    }
}

// What the timer finds amiss with marks, written and read.
TEST(TimingLog, HoldsMarksThatDoNotPair) {
    const auto log_of = [](const std::vector<qemu::Instruction>& executed) {
        timing::CallTimer timer({}, {}, [](const timing::TimedCall&) {});
        timer.watch_stretch(0x20);
        for (const qemu::Instruction& instruction : executed) {
            timer.executes(instruction);
        }
        timer.finish();
        std::stringstream text;
        timing::TimingLogWriter(text).finish(timer);
        return timing::read_timing_log(text);
    };
    const timing::TimingLog nested = log_of({{0x20, qemu::stretch_begins, 2, 0}, {0x22, qemu::stretch_begins, 2, 1}});
    EXPECT_EQ(nested.misused_mark, (qemu::MisusedMark{0x22, 0x20}));
    EXPECT_EQ(nested.open_stretch, 0x22U);
    const timing::TimingLog end = log_of({{0x22, qemu::stretch_ends, 2, 0}});
    EXPECT_EQ(end.misused_mark, (qemu::MisusedMark{0x22, std::nullopt}));
    EXPECT_FALSE(end.open_stretch);
}

TEST(TimingRequest, ChangesACoreFileAsItSays) {
    timing::TimingRequest request;
    request.cores_folder = TEST_CORES;
    request.cores = {
        {"stm32f746-flash", "", ""}, {"stm32f746-flash", "itcm", "axi"}, {"stm32f746-flash", "", "", false}};
    const auto cores = timing::cores_of(request);
    ASSERT_EQ(cores.size(), 3U);
    const timing::CoreFile own = timing::read_core(TEST_CORES, "stm32f746-flash");
    EXPECT_EQ(cores[0].placement.code, own.placement.code);
    EXPECT_EQ(cores[0].placement.data, own.placement.data);
    EXPECT_EQ(cores[1].placement.code, timing::code_place_named("itcm"));
    EXPECT_EQ(cores[1].placement.data, timing::data_place_named("axi"));
    EXPECT_NE(own.placement.code, timing::code_place_named("itcm"));
    EXPECT_NE(own.placement.data, timing::data_place_named("axi"));
    ASSERT_GT(own.sets.size(), 1U);
    for (std::size_t s = 0; s < own.sets.size(); ++s) {
        EXPECT_GT(own.sets[s].figures.cache_instruction_bytes, 0);
        EXPECT_EQ(cores[0].sets[s].figures.cache_instruction_bytes, own.sets[s].figures.cache_instruction_bytes);
        EXPECT_EQ(cores[2].sets[s].figures.cache_instruction_bytes, 0);
    }
    // One rule set alone.
    const std::string last = own.sets.back().name;
    request.cores = {{"stm32f746-flash", "", "", true, last}};
    ASSERT_EQ(timing::cores_of(request)[0].sets.size(), 1U);
    EXPECT_EQ(timing::cores_of(request)[0].sets[0].name, last);
    const auto message_of = [&] {
        return test::refusal(glsum::Exit::bad_input, [&] { (void)timing::cores_of(request); });
    };
    request.cores = {{"stm32f746-flash", "", "", true, "no-set"}};
    EXPECT_EQ(
        message_of().find("no-set: no such rule set of the core stm32f746-flash; expected one of " + own.sets[0].name),
        0U)
        << message_of();
    EXPECT_NE(message_of().find(" " + last), std::string::npos);
    request.cores = {{"stm32f746-flash", "", "", true, "", {"no_effect"}}};
    EXPECT_EQ(message_of().find("no_effect: no such effect; expected one of single_issue "), 0U) << message_of();
    EXPECT_NE(message_of().find(" double_precision_in_software call_overhead"), std::string::npos) << message_of();
}

TEST(TimingLog, ACoresNumberIsAtMostAThousand) {
    std::istringstream most("hot 1000 256 7 load_use 7\nend\n");
    const timing::TimingLog log = timing::read_timing_log(most);
    ASSERT_EQ(log.hot.size(), 1001U);
    EXPECT_EQ(log.hot[1000].at(256).half_cycles, 7);
    for (const char* damaged :
         {"hot 1001 256 7 load_use 7\nend\n", "hot 0 256\nend\n", "unknown 256\nend\n", "calls 0 1 1\nend\n",
          "calls 1 1\nend\n", "calls 1 1 1 core 1 5\nend\n", "else\nend\n"}) {
        std::istringstream in(damaged);
        EXPECT_THROW((void)timing::read_timing_log(in), std::runtime_error) << damaged;
    }
}

}  // namespace
