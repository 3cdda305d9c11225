// Blocks are told as a whole before they run: one that a fault leaves early is timed as far as it came.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "probe.hpp"
#include "qemu/timing/call_timer.hpp"

namespace {

using timing::TimedCall;

// A watched function of these additions, then its return to the caller. Each needs what the one before gives.
constexpr std::uint32_t entry = 0x100;
constexpr std::uint32_t add_to_r0 = 0x3001;
constexpr std::uint32_t back = 0x4770;
constexpr std::uint32_t unknown = 0xDEFE;

struct CutTold {
    std::vector<TimedCall> calls;
    std::map<std::uint32_t, std::uint64_t> unknown;
};

class CutFunction {
public:
    explicit CutFunction(std::vector<std::uint32_t> encodings) {
        caller_.push_back({0x10, 0xF000F876, 4, 0});  // BL entry
        for (const std::uint32_t encoding : encodings) {
            body_.push_back(half_word(entry, body_.size(), encoding));
        }
        ret_.push_back({0x180, back, 2, next_++});
        behind_.push_back({0x14, add_to_r0, 2, next_++});
    }

    // Of the body's block so many instructions were executed before it went elsewhere.
    [[nodiscard]] CutTold in_blocks(std::size_t done) const {
        return tell([&](timing::CallTimer& timer) {
            timer.executes_block({caller_, 0}, 1);
            timer.executes_block({body_, 1}, 1);
            timer.executes_block({ret_, 2}, done);
            timer.executes_block({behind_, 3}, 1);
            timer.finish();
        });
    }
    [[nodiscard]] CutTold one_by_one(std::size_t done) const {
        return tell([&](timing::CallTimer& timer) {
            timer.executes(caller_.front());
            for (std::size_t i = 0; i < done; ++i) {
                timer.executes(body_[i]);
            }
            timer.executes(ret_.front());
            timer.executes(behind_.front());
            timer.finish();
        });
    }

private:
    qemu::Instruction half_word(std::uint32_t first, std::size_t nth, std::uint32_t encoding) {
        return {static_cast<std::uint32_t>(first + 2 * nth), encoding, 2, next_++};
    }
    template <class Run>
    [[nodiscard]] CutTold tell(const Run& run) const {
        CutTold told;
        timing::CallTimer timer({entry}, {timing::read_core(TEST_CORES, "stm32f746-itcm")},
                                [&](const TimedCall& call) { told.calls.push_back(call); });
        run(timer);
        told.unknown = timer.unknown();
        return told;
    }

    std::uint32_t next_ = 1;
    std::vector<qemu::Instruction> caller_, body_, ret_, behind_;
};

void expect_the_same(const CutFunction& program, std::size_t told, std::size_t done) {
    const CutTold cut = program.in_blocks(told);
    const CutTold single = program.one_by_one(done);
    ASSERT_EQ(cut.calls.size(), 1U);
    ASSERT_EQ(single.calls.size(), 1U);
    EXPECT_EQ(cut.calls[0].instructions, done + 1) << told;
    EXPECT_EQ(cut.calls[0].instructions, single.calls[0].instructions) << told;
    EXPECT_EQ(cut.calls[0].cores, single.calls[0].cores) << told;
    EXPECT_EQ(cut.unknown, single.unknown) << told;
}

TEST(CutBlock, IsTimedAsFarAsItCame) {
    const CutFunction program({add_to_r0, unknown, add_to_r0, unknown, add_to_r0});
    for (const std::size_t done : {1U, 2U, 3U, 4U, 5U}) {
        expect_the_same(program, done, done);
    }
    // What faulted in its first instruction came that far; nothing is behind its last.
    expect_the_same(program, 0, 1);
    expect_the_same(program, 9, 5);
    expect_the_same(CutFunction({add_to_r0}), 1, 1);
}

}  // namespace
