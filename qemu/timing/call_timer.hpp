// Times each call of watched functions in a stream, on several cores and under each of their rule sets at once.
//
// A call lasts from the issue of the function's first instruction to the issue of the first one behind its return.
// Callees count; so does a function that it ends in by a jump (a tail call), up to where control returns to the caller.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "qemu/stream/stream.hpp"
#include "qemu/stream/stretch_marks.hpp"
#include "qemu/timing/block_replay.hpp"
#include "qemu/timing/call_stack.hpp"
#include "qemu/timing/decode.hpp"
#include "qemu/timing/stack_depth.hpp"
#include "qemu/timing/surroundings.hpp"

namespace timing {

/// What one core takes for one call.
struct CoreTime {
    std::vector<std::int64_t> half_cycles;  ///< nominal, and the low and high edge of its band
    Losses losses{};                        ///< half cycles, of the nominal set
    std::int64_t double_in_software = 0;    ///< half cycles within the double routines, of the nominal set: no losses
    std::vector<std::int64_t> sets = {};    ///< half cycles under each rule set, the nominal one first
    bool operator==(const CoreTime&) const = default;
};

struct TimedCall {
    std::uint32_t entry = 0;
    std::uint64_t instructions = 0;
    std::vector<CoreTime> cores;    ///< as the timer was given them
    std::uint32_t stack_bytes = 0;  ///< below its caller's frame
};

/// What an instruction took in all calls, in half cycles, and what it lost most of that to.
struct HotSpot {
    std::int64_t half_cycles = 0;
    Effect reason{};
    std::int64_t lost = 0;  ///< to the reason; 0: nothing held it
    bool operator==(const HotSpot&) const = default;
};

class CallTimer final : public qemu::StreamConsumer {
public:
    /// \param entries          addresses of the watched functions' first instructions (no Thumb bit)
    /// \param done             called at the end of each call
    /// \param double_routines  what computes in double precision where the core has no unit: told apart
    CallTimer(std::set<std::uint32_t> entries, const std::vector<CoreFile>& cores,
              std::function<void(const TimedCall&)> done, std::vector<AddressRange> double_routines = {});

    /// In place of functions: the stretches whose begin mark stands there, each as if it were a call.
    void watch_stretch(std::uint32_t begin) { stretch_ = begin; }
    /// \param handlers  entry addresses of the program's exception handlers, whose calls end by another return
    void watch_exceptions(std::set<std::uint32_t> handlers) { call_stack_.watch_exceptions(std::move(handlers)); }
    void watch_unwinding(Unwinding unwinding) { call_stack_.watch_unwinding(std::move(unwinding)); }
    /// \param handlers  of those its fault handlers
    void watch_faults(std::set<std::uint32_t> handlers) { fault_handlers_ = std::move(handlers); }

    void executes(const qemu::Instruction& instruction) override;
    void accesses(const qemu::Access& access) override { accesses_.push_back(access); }
    /// In place of `executes` and `accesses`, several times as fast: called before a block, and after that for each of
    /// its accesses. A watched function begins with a block.
    /// \param done  how many instructions of the block before were executed: fewer than it has if one of them faulted
    void executes_block(const qemu::TranslationBlock& block, std::size_t done);
    /// The stream has ended. \param done  as above
    void finish(std::size_t done);
    void finish();

    /// Half cycles before each instruction's issue within calls, by address: one table a core, of its nominal set.
    [[nodiscard]] std::vector<std::map<std::uint32_t, HotSpot>> hot() const;
    /// Addresses of encodings that the decoder does not know, and how often each was executed.
    [[nodiscard]] const std::map<std::uint32_t, std::uint64_t>& unknown() const { return unknown_; }
    /// A watched function was entered anew before it had returned.
    [[nodiscard]] bool recursive() const { return recursive_; }
    /// Address of the last instruction that was executed.
    [[nodiscard]] std::optional<std::uint32_t> last_address() const { return last_address_; }
    /// Address of the instruction that first led to a fault handler.
    [[nodiscard]] std::optional<std::uint32_t> fault() const { return fault_; }
    /// A watched call has not returned.
    [[nodiscard]] bool inside() const { return inside_; }
    /// Of a watched stretch: the marks that were met, of whatever stretch.
    [[nodiscard]] const qemu::StretchMarks& stretch_marks() const { return stretch_marks_; }

private:
    // A block, decoded once.
    struct Piece {
        CodeBlock code;
        bool entry = false;
        std::optional<qemu::Instruction> mark;  // where stretches are watched: a block by itself
        bool in_double_routine = false;
        ItBlock it_block_behind;
        std::vector<std::uint32_t> unknown;                            // addresses
        std::vector<std::pair<std::uint16_t, StackMove>> stack_moves;  // by number of the instruction
        std::vector<BlockEvents> met;                                  // by core
    };
    struct Core {
        CoreFile file;
        Surroundings surroundings;
        BlockReplay replay;
        using Positions = std::array<std::int64_t, CoreFile::most_sets>;
        // Where the core stands, and what it has lost: at the call's beginning, before a block, within double routines.
        Positions begun{};
        Positions before{};
        Positions in_double{};
        Losses lost_before{};
        Losses lost_in_double{};
        explicit Core(const CoreFile& core);
    };
    const Prepared* prepared(const qemu::Instruction& instruction);
    Piece& piece_of(std::vector<std::unique_ptr<Piece>>& pieces, std::uint32_t index,
                    std::span<const qemu::Instruction> instructions);
    void flush(std::size_t done, std::uint32_t next);
    [[nodiscard]] static bool ends_stretch(const Piece& piece) {
        return piece.mark && piece.mark->encoding == qemu::stretch_ends;
    }
    void time_by_steps(const Piece& piece, std::size_t done, bool ends, bool begins);
    void follow_stack(const Piece& piece, std::size_t from, std::size_t done);
    void enter_double_routine();
    void leave_double_routine();
    void end_call();
    void begin_call(std::uint32_t entry);

    std::set<std::uint32_t> entries_;
    CallStack call_stack_;
    std::optional<std::uint32_t> stretch_;
    qemu::StretchMarks stretch_marks_;
    bool stretch_begins_ = false;  // with the next instruction
    std::vector<AddressRange> double_routines_;
    std::vector<std::unique_ptr<Core>> cores_;
    std::function<void(const TimedCall&)> done_;
    std::vector<std::unique_ptr<Prepared>> prepared_;  // by index of the instruction
    std::vector<std::unique_ptr<Piece>> blocks_;
    std::vector<std::unique_ptr<Piece>> singles_;  // of one instruction each
    std::vector<std::uint32_t> addresses_;         // by site
    ItBlock it_block_;

    Piece* pending_ = nullptr;
    std::vector<qemu::Access> accesses_;

    std::uint32_t last_site_ = 0;

    StackDepth stack_;

    std::set<std::uint32_t> fault_handlers_;
    std::optional<std::uint32_t> last_address_;
    std::optional<std::uint32_t> fault_;

    bool inside_ = false;
    std::size_t depth_ = 0;  // of call_stack_ at the entry
    TimedCall call_;
    std::map<std::uint32_t, std::uint64_t> unknown_;
    bool recursive_ = false;
};

}  // namespace timing
