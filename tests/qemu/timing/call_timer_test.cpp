// Where a call begins and ends, and what it is made of.
#include "qemu/timing/call_timer.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <sstream>

#include "probe.hpp"
#include "qemu/timing/band.hpp"
#include "qemu/timing/timing_log.hpp"

namespace {

// Executes instructions at fixed places, on the ideal core: half a cycle each.
class Program {
public:
    explicit Program(const char* core = "m7-ideal", std::set<std::uint32_t> entries = {0x100})
        : Program(timing::read_core(TEST_CORES, core), std::move(entries)) {}
    // Between 0x200 and 0x300 it computes in double precision.
    explicit Program(const timing::CoreFile& core, std::set<std::uint32_t> entries = {0x100})
        : timer_(std::move(entries), {core}, [this](const timing::TimedCall& call) { calls.push_back(call); },
                 {{0x200, 0x300}}) {}
    void run(std::uint32_t address, std::uint32_t encoding, std::uint8_t bytes) {
        const auto index = static_cast<std::uint32_t>(known_.size());
        timer_.executes(known_.try_emplace(address, qemu::Instruction{address, encoding, bytes, index}).first->second);
    }
    // All of them at once; what was executed before was so to its end.
    void block(const std::vector<qemu::Instruction>& instructions) {
        blocks_.push_back({instructions, static_cast<std::uint32_t>(blocks_.size())});
        timer_.executes_block(blocks_.back(), before_);
        before_ = instructions.size();
    }
    void call(std::uint32_t from) { run(from, 0xF000F876, 4); }
    void add(std::uint32_t address) { run(address, 0x3001, 2); }
    void jump(std::uint32_t address) { run(address, 0xE07E, 2); }
    void begin_mark(std::uint32_t address) { run(address, qemu::stretch_begins, 2); }
    void end_mark(std::uint32_t address) { run(address, qemu::stretch_ends, 2); }
    void give_back(std::uint32_t address) { run(address, 0x4770, 2); }
    timing::CallTimer& timer() { return timer_; }
    timing::CallTimer& finish() {
        timer_.finish();
        return timer_;
    }
    std::vector<timing::TimedCall> calls;

private:
    timing::CallTimer timer_;
    std::map<std::uint32_t, qemu::Instruction> known_;
    std::deque<qemu::TranslationBlock> blocks_;
    std::size_t before_ = 1;
};

TEST(CallTimer, ACallLastsFromItsFirstInstructionToTheFirstOneBehindIt) {
    Program p;
    p.add(0xE);
    p.call(0x10);
    p.add(0x100);
    p.add(0x102);
    p.give_back(0x104);
    p.add(0x14);
    p.add(0x16);
    p.finish();
    ASSERT_EQ(p.calls.size(), 1U);
    EXPECT_EQ(p.calls[0].instructions, 3U);
    EXPECT_EQ(p.calls[0].cores[0].half_cycles[0], 3);
}

TEST(CallTimer, CalleesCountAndTailCallsEndWhereControlReturnsToTheCaller) {
    Program p;
    p.call(0x10);
    p.add(0x100);
    p.call(0x102);  // a callee
    p.add(0x200);
    p.give_back(0x202);
    p.jump(0x106);  // a tail call
    p.add(0x300);
    p.add(0x302);
    p.give_back(0x304);
    p.add(0x14);
    p.finish();
    ASSERT_EQ(p.calls.size(), 1U);
    EXPECT_EQ(p.calls[0].instructions, 8U);
}

TEST(CallTimer, DoublePrecisionInSoftwareIsToldApartAndCanBeTakenAway) {
    const auto call_of = [](const timing::CoreFile& core) {
        Program p(core);
        for (int calls = 0; calls < 9; ++calls) {
            p.call(0x10);
            p.add(0x100);
            p.call(0x102);
            p.run(0x200, 0x4348, 2);      // muls r0, r1
            p.run(0x202, 0x4348, 2);      // again: waits
            p.run(0x204, 0xF3EF8010, 4);  // mrs r0, primask: issues alone
            p.give_back(0x208);
            p.add(0x106);
            p.give_back(0x108);
            p.add(0x14);
        }
        p.finish();
        return p.calls.at(8).cores.at(0);
    };
    const auto sum = [](const timing::Losses& losses) {
        return std::accumulate(losses.begin(), losses.end(), std::int64_t{0});
    };
    timing::CoreFile core = timing::read_core(TEST_CORES, "m7-ideal");
    EXPECT_EQ(call_of(core).half_cycles[0], 8);
    EXPECT_EQ(call_of(core).double_in_software, 4);
    core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    const timing::CoreTime paid = call_of(core);
    EXPECT_GT(paid.double_in_software, 4);
    EXPECT_EQ(paid.half_cycles[0], 4 + sum(paid.losses) + paid.double_in_software);
    ASSERT_TRUE(timing::switch_off(core, "double_precision_in_software"));
    const timing::CoreTime unpaid = call_of(core);
    EXPECT_EQ(unpaid.double_in_software, 0);
    EXPECT_EQ(unpaid.losses, paid.losses);
    EXPECT_EQ(unpaid.half_cycles[0], paid.half_cycles[0] - paid.double_in_software);
}

// Where a branch pairs with its target, its set takes less of a routine that branches: each set as if it were alone.
TEST(CallTimer, EachRuleSetIsTimedByItself) {
    const auto call_of = [](const timing::CoreFile& core) {
        Program p(core);
        for (int calls = 0; calls < 9; ++calls) {
            p.call(0x10);
            p.add(0x100);
            p.call(0x102);
            for (std::uint32_t address = 0x200; address < 0x240; address += 8) {
                p.add(address);
                p.add(address + 2);
                p.jump(address + 4);
            }
            p.give_back(0x240);
            p.add(0x106);
            p.give_back(0x108);
            p.add(0x14);
        }
        p.finish();
        return p.calls.at(8).cores.at(0);
    };
    timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    std::set<std::int64_t> in_double;
    for (const bool off : {false, true}) {
        if (off) {
            ASSERT_TRUE(timing::switch_off(core, "double_precision_in_software"));
        }
        std::vector<std::int64_t> alone;
        for (const auto& set : core.sets) {
            timing::CoreFile one = core;
            one.sets = {set};
            const timing::CoreTime time = call_of(one);
            alone.push_back(time.half_cycles[0]);
            in_double.insert(time.double_in_software);
        }
        const timing::CoreTime all = call_of(core);
        const timing::Band band =
            timing::band_of(core, alone, all.losses[timing::index(timing::Effect::branch_mispredict)]);
        EXPECT_EQ(all.half_cycles[0], alone[0]);
        EXPECT_EQ(all.half_cycles[1], band.low);
        EXPECT_EQ(all.half_cycles[2], band.high);
        timing::CoreFile nominal = core;
        nominal.sets.resize(1);
        EXPECT_EQ(all.double_in_software, call_of(nominal).double_in_software);
        EXPECT_EQ(all.losses, call_of(nominal).losses);
    }
    EXPECT_GT(in_double.size(), 2U);  // 0 where it is taken away, and else at least two
}

TEST(CallTimer, AFunctionThatIsEnteredByATailCallEndsInTheCallersCaller) {
    Program p;
    p.call(0x10);
    p.add(0x200);
    p.jump(0x202);
    p.add(0x100);
    p.give_back(0x102);
    p.add(0x14);
    p.finish();
    ASSERT_EQ(p.calls.size(), 1U);
    EXPECT_EQ(p.calls[0].instructions, 2U);
}

TEST(CallTimer, ALoopToTheEntryIsNoCallAndRecursionIsToldAndCountsOnce) {
    Program p;
    p.call(0x10);
    p.add(0x100);
    p.jump(0x102);
    p.add(0x100);  // a loop
    p.jump(0x102);
    EXPECT_FALSE(p.finish().recursive());
    Program r;
    r.call(0x10);
    r.add(0x100);
    r.call(0x102);
    r.add(0x100);
    r.give_back(0x106);
    r.give_back(0x106);
    r.add(0x14);
    EXPECT_TRUE(r.finish().recursive());
    ASSERT_EQ(r.calls.size(), 1U);
    EXPECT_EQ(r.calls[0].instructions, 5U);
}

TEST(CallTimer, ACallThatDoesNotReturnIsTold) {
    Program p;
    p.call(0x10);
    p.add(0x100);
    EXPECT_TRUE(p.finish().inside());
    EXPECT_TRUE(p.calls.empty());
}

TEST(CallTimer, AnUnknownEncodingIsCountedWithItsAddress) {
    Program p("stm32f746-itcm");
    p.call(0x10);
    p.run(0x100, 0xFFFFFFFF, 4);
    p.run(0x100, 0xFFFFFFFF, 4);
    p.give_back(0x104);
    p.add(0x14);
    EXPECT_EQ(p.finish().unknown(), (std::map<std::uint32_t, std::uint64_t>{{0x100, 2}}));
}

// What faulted behind an IT comes back to it: its member is conditional and sets no flags, whatever was known before.
TEST(CallTimer, AMemberIsOneThoughItsBlockWasCutWhenItWasNew) {
    const auto last_call = [](bool first_is_cut, std::uint32_t between) {
        Program p("stm32f746-itcm");
        for (int calls = 0; calls < 9; ++calls) {
            p.call(0x10);
            p.run(0x100, 0x4289, 2);  // cmp r1, r1
            for (std::uint32_t nth = 0; nth < between; ++nth) {
                p.run(0x102 + 2 * nth, 0x4680, 2);  // mov r8, r0
            }
            p.run(0x110, 0xBF18, 2);  // it ne
            if (first_is_cut && calls == 0) {
                p.give_back(0x180);
            } else {
                p.add(0x112);             // addne r0, 1: outside of a block it would set the flags
                p.run(0x114, 0x4151, 2);  // adcs r1, r2: waits for none
                p.give_back(0x116);
            }
            p.add(0x14);
        }
        p.finish();
        return p.calls.at(8).cores.at(0);
    };
    for (const std::uint32_t between : {4U, 5U}) {  // in either slot
        EXPECT_EQ(last_call(true, between), last_call(false, between)) << between;
    }
}

TEST(CallTimer, LossesAndHotAddressesSumToTheTotal) {
    Program p("stm32f746-flash");
    for (int i = 0; i < 3; ++i) {
        p.call(0x10);
        p.run(0x100, 0x4348, 2);      // muls r0, r1
        p.run(0x102, 0x4348, 2);      // again: waits
        p.run(0x104, 0xFBB0F0F1, 4);  // udiv r0, r0, r1
        p.give_back(0x108);
        p.add(0x14);
    }
    const auto hot = p.finish().hot();
    ASSERT_EQ(p.calls.size(), 3U);
    std::int64_t total = 0;
    for (const timing::TimedCall& call : p.calls) {
        const auto& losses = call.cores[0].losses;
        EXPECT_EQ(call.cores[0].half_cycles[0], 4 + std::accumulate(losses.begin(), losses.end(), std::int64_t{0}));
        total += call.cores[0].half_cycles[0];
    }
    EXPECT_GT(p.calls[0].cores[0].losses[timing::index(timing::Effect::mac_latency)], 0);
    // What the caller's next instruction moves is the return's doing.
    EXPECT_TRUE(hot[0].contains(0x104) && hot[0].contains(0x108));
    EXPECT_EQ(hot[0].size(), 3U);  // with 0x102; the call begins as its first one issues
    EXPECT_EQ(std::accumulate(hot[0].begin(), hot[0].end(), std::int64_t{0},
                              [](std::int64_t sum, const auto& row) { return sum + row.second.half_cycles; }),
              total);
    // Each address says what it lost most to: the first product waited for nothing, the second for it.
    EXPECT_EQ(hot[0].at(0x102).reason, timing::Effect::mac_latency);
    std::int64_t lost = 0;
    for (const timing::TimedCall& call : p.calls) {
        lost += call.cores[0].losses[timing::index(timing::Effect::mac_latency)];
        EXPECT_EQ(call.cores[0].sets.size(), timing::read_core(TEST_CORES, "stm32f746-flash").sets.size());
        EXPECT_EQ(call.cores[0].sets[0], call.cores[0].half_cycles[0]);
    }
    EXPECT_GT(hot[0].at(0x102).lost, 0);
    EXPECT_LE(hot[0].at(0x102).lost, lost);
}

// Two bit fields take two cycles: half a cycle is lost to single issue in each call, whatever was lost before it.
TEST(CallTimer, LossesAreThoseOfTheCallAlone) {
    Program p("stm32f746-itcm");
    for (int i = 0; i < 3; ++i) {
        p.call(0x10);
        p.run(0x100, 0xFA5FF081, 4);  // uxtb.w r0, r1
        p.run(0x104, 0xFA5FF283, 4);  // uxtb.w r2, r3
        p.give_back(0x108);
        p.add(0x14);
    }
    p.finish();
    ASSERT_EQ(p.calls.size(), 3U);
    for (const timing::TimedCall& call : p.calls) {
        EXPECT_EQ(call.cores[0].losses[timing::index(timing::Effect::single_issue)], 1);
    }
}

// What moves it as a block's last instruction counts as what moves it first.
TEST(CallTimer, TheStackIsFollowedThroughWholeBlocks) {
    Program p;
    p.block({{0x10, 0xF000F876, 4, 0}});
    p.block({{0x100, 0xB082, 2, 1}, {0x102, 0xB084, 2, 2}});                         // sub sp, #8; sub sp, #16
    p.block({{0x104, 0x3001, 2, 3}, {0x106, 0xB082, 2, 4}});                         // adds; sub sp, #8
    p.block({{0x108, 0xB082, 2, 5}, {0x10A, 0xB00A, 2, 6}, {0x10C, 0x4770, 2, 7}});  // sub sp, #8; add sp, #40; bx lr
    p.block({{0x14, 0x3001, 2, 8}});
    p.timer().finish(1);
    ASSERT_EQ(p.calls.size(), 1U);
    EXPECT_EQ(p.calls[0].stack_bytes, 40U);
}

TEST(CallTimer, AStretchLastsFromBehindItsFirstMarkToItsSecond) {
    Program p("m7-ideal", {});
    p.timer().watch_stretch(0x20);
    for (int turn = 0; turn < 2; ++turn) {
        p.add(0x1E);
        p.begin_mark(0x20);
        p.add(0x22);
        p.call(0x24);
        p.add(0x100);
        p.give_back(0x102);
        p.add(0x28);
        p.end_mark(0x2A);
        p.add(0x2C);
        p.begin_mark(0x2E);  // another's
        p.add(0x30);
        p.end_mark(0x32);
    }
    const timing::CallTimer& timer = p.finish();
    ASSERT_EQ(p.calls.size(), 2U);
    for (const timing::TimedCall& call : p.calls) {
        EXPECT_EQ(call.entry, 0x20U);
        EXPECT_EQ(call.instructions, 5U);
        EXPECT_EQ(call.cores[0].half_cycles[0], 5);
    }
    EXPECT_FALSE(timer.stretch_marks().open() || timer.stretch_marks().misused());
}

TEST(CallTimer, BetweenTwoMarksInARowThereIsNothing) {
    Program p("m7-ideal", {});
    p.timer().watch_stretch(0x20);
    p.begin_mark(0x20);
    p.end_mark(0x22);
    p.add(0x24);
    p.finish();
    ASSERT_EQ(p.calls.size(), 1U);
    EXPECT_EQ(p.calls[0].instructions, 0U);
    EXPECT_EQ(p.calls[0].cores[0].half_cycles[0], 0);
}

TEST(CallTimer, MarksThatDoNotPairAreToldWithTheirPlaces) {
    const auto marks_of = [](const std::function<void(Program&)>& runs) {
        Program p("m7-ideal", {});
        p.timer().watch_stretch(0x20);
        runs(p);
        return p.finish().stretch_marks();
    };
    const auto open = marks_of([](Program& p) { p.begin_mark(0x40); });
    EXPECT_EQ(open.open(), 0x40U);
    EXPECT_FALSE(open.misused());
    const auto end = marks_of([](Program& p) {
        p.end_mark(0x42);
        p.end_mark(0x44);
    });
    EXPECT_FALSE(end.open());
    EXPECT_EQ(end.misused(), (qemu::MisusedMark{0x42, std::nullopt}));
    const auto nested = marks_of([](Program& p) {
        p.begin_mark(0x20);
        p.begin_mark(0x40);
        p.end_mark(0x42);
    });
    EXPECT_EQ(nested.misused(), (qemu::MisusedMark{0x40, 0x20}));
    // Where none is watched a mark is an instruction like any other.
    Program p;
    p.end_mark(0x42);
    EXPECT_FALSE(p.finish().stretch_marks().misused());
}

// A handler at 0x100 and another at 0x180: no address says where they return to.
class Interrupted : public Program {
public:
    explicit Interrupted(std::set<std::uint32_t> handlers = {0x100, 0x180}) {
        timer().watch_exceptions(std::move(handlers));
    }
    std::vector<std::uint64_t> instructions() {
        EXPECT_FALSE(finish().inside());
        std::vector<std::uint64_t> each;
        for (const timing::TimedCall& call : calls) {
            each.push_back(call.instructions);
        }
        return each;
    }
};

TEST(CallTimer, AHandlerEndsWhereItReturnsToWhatItInterrupted) {
    for (const bool known : {true, false}) {  // one that the vector table does not name is known by being watched
        Interrupted p(known ? std::set<std::uint32_t>{0x100} : std::set<std::uint32_t>{});
        p.call(0x10);
        p.add(0x400);
        p.add(0x100);  // between two instructions of the callee
        p.call(0x102);
        p.add(0x300);
        p.give_back(0x302);
        p.add(0x106);
        p.give_back(0x108);
        p.add(0x402);
        p.add(0x404);
        p.give_back(0x406);
        p.add(0x100);  // behind its return
        p.give_back(0x108);
        p.add(0x14);
        EXPECT_EQ(p.instructions(), (std::vector<std::uint64_t>{6, 2})) << known;
    }
}

TEST(CallTimer, AHandlerBehindAHandlerIsACallOfItsOwn) {
    Interrupted p;
    p.add(0x10);
    for (const int adds : {0, 1, 0}) {  // tail-chained: no instruction of the program lies between
        p.add(0x100);
        for (int i = 0; i < adds; ++i) {
            p.add(0x102);
        }
        p.give_back(0x104);
    }
    p.add(0x180);
    p.give_back(0x182);
    p.add(0x100);
    p.give_back(0x104);
    p.add(0x12);
    EXPECT_EQ(p.instructions(), (std::vector<std::uint64_t>{2, 3, 2, 2}));
}

TEST(CallTimer, AHandlerWithinAHandlerCountsAndDoesNotEndIt) {
    Interrupted p;
    p.add(0x10);
    p.add(0x100);
    p.call(0x102);
    p.add(0x180);  // before the callee's first instruction
    p.give_back(0x182);
    p.add(0x300);
    p.give_back(0x302);
    p.add(0x180);  // before what the callee returns to
    p.add(0x184);
    p.give_back(0x186);
    p.add(0x106);
    p.add(0x180);
    p.give_back(0x182);
    p.give_back(0x108);
    p.add(0x12);
    EXPECT_EQ(p.instructions(), (std::vector<std::uint64_t>{13}));
}

// As any other function, too: called, jumped to, and with a loop to its first instruction.
TEST(CallTimer, AHandlerMayBeCalled) {
    Interrupted p;
    p.call(0x10);
    p.add(0x100);
    p.jump(0x102);  // a loop
    p.add(0x100);
    p.jump(0x102);
    p.add(0x100);
    p.give_back(0x104);
    p.add(0x14);
    p.call(0x20);
    p.add(0x300);
    p.jump(0x302);
    p.add(0x100);
    p.give_back(0x104);
    p.add(0x24);
    p.add(0x26);
    EXPECT_EQ(p.instructions(), (std::vector<std::uint64_t>{6, 2}));
}

// 0x600 restores all registers. The caller lies from 0x10, what it catches in from 0x700; the callees from 0x100,
// 0x300.
TEST(CallTimer, ACallThatAnExceptionLeavesEndsWhereItIsCaught) {
    Program p;
    p.timer().watch_unwinding(
        {{{0x600, 0x610}}, {{0x10, 1}, {0x100, 2}, {0x300, 3}, {0x600, 6}, {0x700, 1}, {0x720, 7}}});
    for (int calls = 0; calls < 2; ++calls) {
        p.call(0x10);
        p.add(0x100);
        p.call(0x102);
        p.add(0x300);
        p.call(0x302);
        p.give_back(0x600);
        p.add(0x108);  // the callee destroys what it has
        p.call(0x10A);
        p.give_back(0x600);
        p.add(0x700);
        p.jump(0x702);
        p.add(0x14);
    }
    p.finish();
    ASSERT_EQ(p.calls.size(), 2U);
    EXPECT_EQ(p.calls[0].instructions, 8U);
    EXPECT_EQ(p.calls[1].instructions, 8U);
    EXPECT_FALSE(p.timer().recursive());
}

TEST(CallTimer, KnowsWhereTheProgramFirstFaulted) {
    Program p;
    p.timer().watch_faults({0x80, 0x90});
    p.add(0x10);
    p.add(0x12);
    p.add(0x80);
    EXPECT_EQ(p.timer().fault(), 0x12U);
    p.add(0x82);
    p.add(0x90);
    p.add(0x92);
    EXPECT_EQ(p.finish().fault(), 0x12U);
    EXPECT_EQ(p.finish().last_address(), 0x92U);
}

TEST(TimingLog, IsReadAsItWasWrittenAndACutIsSeen) {
    Program p("stm32f746-flash");
    for (int i = 0; i < 3; ++i) {
        p.call(0x10);
        p.run(0x100, 0xFFFFFFFF, 4);
        p.give_back(0x104);
        p.add(0x14);
    }
    const timing::CallTimer& timer = p.finish();
    std::stringstream text;
    timing::TimingLogWriter writer(text);
    for (const auto& call : p.calls) {
        writer.add(call);
    }
    writer.finish(timer);
    const timing::TimingLog log = timing::read_timing_log(text);
    std::uint64_t calls = 0;
    for (const auto& run : log.runs) {
        calls += run.calls;
    }
    EXPECT_EQ(calls, 3U);
    EXPECT_EQ(log.runs[0].call.cores[0].half_cycles, p.calls[0].cores[0].half_cycles);
    EXPECT_EQ(log.runs[0].call.cores[0].losses, p.calls[0].cores[0].losses);
    EXPECT_EQ(log.runs[0].call.cores[0].sets, p.calls[0].cores[0].sets);
    EXPECT_EQ(log.unknown.at(0x100), 3U);
    EXPECT_EQ(log.hot, timer.hot());
    EXPECT_FALSE(log.hot.at(0).empty());
    EXPECT_FALSE(log.unfinished);
    EXPECT_FALSE(log.recursive);
    const std::string whole = text.str();
    std::istringstream cut(whole.substr(0, whole.size() - 4));
    EXPECT_THROW((void)timing::read_timing_log(cut), std::runtime_error);
}

}  // namespace
