// The counter on programs written by hand, told of instruction by instruction and block by block.
#include "qemu/stream/call_counter.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <utility>

#include "qemu/stream/thumb.hpp"

namespace {

constexpr std::uint32_t entry = 0x100;
constexpr std::size_t no_blocks = 0;

// A program of instructions at fixed places.
class Program {
public:
    // Blocks end at a branch or, as the emulator may cut them anywhere, at this length.
    explicit Program(std::size_t longest_block) : longest_block_(longest_block) {}

    void run(std::uint32_t address, std::uint32_t encoding, std::uint8_t bytes) {
        const auto index = static_cast<std::uint32_t>(instructions_.size());
        const qemu::Instruction& instruction =
            instructions_.try_emplace(address, qemu::Instruction{address, encoding, bytes, index}).first->second;
        if (longest_block_ == no_blocks) {
            counter_.executes(instruction);
            return;
        }
        if (!pending_.empty() && (pending_.size() == longest_block_ || qemu::is_branch(pending_.back()))) {
            execute_block();
        }
        pending_.push_back(instruction);
    }
    void call() { run(0x10, 0xF000F876, 4); }  // bl 0x100
    void add(std::uint32_t address) { run(address, 0x3001, 2); }
    void load(std::uint32_t address, bool store = false) {
        run(address, 0x6808, 2);
        if (longest_block_ == no_blocks) {
            counter_.accesses({0x20000000, 4, store});
        } else {
            ++(store ? accesses_.stores : accesses_.loads);
        }
    }
    void give_back(std::uint32_t address) { run(address, 0x4770, 2); }  // bx lr

    const qemu::CallCounter& counter() {
        execute_block();
        return counter_;
    }

private:
    void execute_block() {
        if (pending_.empty()) {
            return;
        }
        const auto index = static_cast<std::uint32_t>(blocks_.size());
        const std::pair place(pending_.front().address, pending_.size());
        counter_.executes_block(blocks_.try_emplace(place, qemu::TranslationBlock{pending_, index}).first->second);
        counter_.totals().loads += std::exchange(accesses_.loads, 0);
        counter_.totals().stores += std::exchange(accesses_.stores, 0);
        pending_.clear();
    }

    std::size_t longest_block_;
    qemu::CallCounter counter_{{entry}};
    std::map<std::uint32_t, qemu::Instruction> instructions_;
    std::map<std::pair<std::uint32_t, std::size_t>, qemu::TranslationBlock> blocks_;
    std::vector<qemu::Instruction> pending_;
    qemu::AccessTotals accesses_;
};

class CallCounter : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Told, CallCounter, testing::Values(no_blocks, 1, 2, 100), [](const auto& told) {
    return told.param == no_blocks ? "instructions" : "blocksOf" + std::to_string(told.param);
});

TEST_P(CallCounter, CountsFromTheEntryToTheReturnAndNothingElse) {
    Program p(GetParam());
    p.load(0x8);
    p.call();
    p.add(0x100);
    p.load(0x102);
    p.load(0x104, true);
    p.give_back(0x106);
    p.load(0x14);  // behind the call
    ASSERT_EQ(p.counter().runs().size(), 1U);
    EXPECT_EQ(p.counter().runs()[0].entry, entry);
    EXPECT_EQ(p.counter().runs()[0].calls, 1U);
    EXPECT_EQ(p.counter().runs()[0].counts, (qemu::CallCounts{4, 1, 1, 1}));
    EXPECT_EQ(p.counter().reached().at(entry), (std::set<std::uint32_t>{0x100, 0x102, 0x104, 0x106}));
}

TEST_P(CallCounter, CalleesCountAndEqualCallsAreJoined) {
    Program p(GetParam());
    for (int i = 0; i < 3; ++i) {
        p.call();
        p.run(0x100, 0xF000F87E, 4);  // bl 0x200
        p.load(0x200);
        p.give_back(0x202);
        p.give_back(0x104);
        p.add(0x14);
    }
    p.call();
    p.give_back(0x100);
    p.add(0x14);
    ASSERT_EQ(p.counter().runs().size(), 2U);
    EXPECT_EQ(p.counter().runs()[0].calls, 3U);
    EXPECT_EQ(p.counter().runs()[0].counts, (qemu::CallCounts{4, 1, 0, 3}));
    EXPECT_EQ(p.counter().runs()[1].counts, (qemu::CallCounts{1, 0, 0, 1}));
}

TEST_P(CallCounter, CodeThatIsMetInAnotherOrderIsStillKnown) {
    qemu::CallCounter counter{{entry}};
    const qemu::Instruction call{0x10, 0xF000F876, 4, 1};  // numbered last, executed first
    const qemu::Instruction back{0x100, 0x4770, 2, 0};
    const qemu::Instruction after{0x14, 0x3001, 2, 2};
    for (const auto& instruction : {call, back, after}) {
        if (GetParam() == no_blocks) {
            counter.executes(instruction);
        } else {
            counter.executes_block({{instruction}, instruction.index});
        }
    }
    ASSERT_EQ(counter.runs().size(), 1U);
    EXPECT_EQ(counter.runs()[0].counts, (qemu::CallCounts{1, 0, 0, 1}));
}

TEST_P(CallCounter, WritesALogThatReadsBack) {
    Program p(GetParam());
    p.call();
    p.load(0x100);
    p.give_back(0x102);
    p.add(0x14);
    std::stringstream log;
    p.counter().write(log);
    const qemu::CallLog read = qemu::read_call_log(log);
    ASSERT_EQ(read.runs.size(), 1U);
    EXPECT_EQ(read.runs[0].counts, (qemu::CallCounts{2, 1, 0, 1}));
    EXPECT_EQ(read.reached.at(entry), (std::set<std::uint32_t>{0x100, 0x102}));
}

TEST_P(CallCounter, RefusesToBeTrustedWhenItCannotKnow) {
    Program jumped(GetParam());
    jumped.run(0x10, 0xE076, 2);  // b 0x100: no return address
    jumped.add(0x100);
    EXPECT_NE(jumped.counter().fault(), "");
    std::stringstream log;
    jumped.counter().write(log);
    EXPECT_THROW(static_cast<void>(qemu::read_call_log(log)), std::runtime_error);

    Program fell_in(GetParam());
    fell_in.add(0xFE);
    fell_in.add(0x100);
    EXPECT_NE(fell_in.counter().fault(), "");

    Program stuck(GetParam());
    stuck.call();
    stuck.add(0x100);
    std::stringstream cut;
    stuck.counter().write(cut);
    EXPECT_THROW(static_cast<void>(qemu::read_call_log(cut)), std::runtime_error);

    std::stringstream empty;
    EXPECT_THROW(static_cast<void>(qemu::read_call_log(empty)), std::runtime_error);
    for (const char* text : {"calls 1 2 x\nend\n", "calls 256 1 10 2 1\nend\n", "calls 256 0 10 2 1 1\nend\n",
                             "calls -1 1 10 2 1 1\nend\n", "calls 256 1 10 2 1 1 9\nend\n", "reached 256 25x\nend\n",
                             "reached\nend\n", "calls 256 1 10 2 1 1\nend of it\n"}) {
        std::stringstream damaged(text);
        EXPECT_THROW(static_cast<void>(qemu::read_call_log(damaged)), std::runtime_error) << text;
    }
}

// A log is as long as a program's may be, and what is refused is shown as far as a line is wide.
TEST(CallCounterLog, LinesHaveALimitAndMessagesToo) {
    const auto refused = [](const std::string& text) -> std::string {
        std::istringstream in(text);
        try {
            (void)qemu::read_call_log(in);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    const std::string longest = "reached 256 258" + std::string((16U << 20) - 15, ' ');
    EXPECT_EQ(refused(longest + "\nend\n"), "");
    EXPECT_EQ(refused(longest + " \nend\n").substr(0, 50), "call log: larger than any program's: reached 256 2");
    EXPECT_EQ(refused(std::string(300, 'x') + "\n"), "call log: " + std::string(200, 'x'));
    EXPECT_EQ(refused("calls 256\n"), "call log: damaged line: calls 256");
    EXPECT_EQ(refused("reached 1x\n"), "call log: damaged line: reached 1x");
    EXPECT_EQ(refused("calls 256 1 1 1 1 1\n"), "call log: cut short: the emulator ended before it was written");
    EXPECT_EQ(refused("end\n"), "");
}

}  // namespace
