// Counts each call of watched functions in a stream: instructions, loads, stores and branches, from the first
// instruction at the entry to the last before control is back behind the call. Callees count, to any depth.
//
// It is told of a program either instruction by instruction and access by access, as a timing model is, or, in a
// fraction of the time, block by block with accesses that the producer counts itself. Both give the same counts.
#pragma once

#include <compare>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "qemu/stream/stream.hpp"

namespace qemu {

struct CallCounts {
    std::uint64_t instructions = 0;
    std::uint64_t loads = 0;     ///< read accesses
    std::uint64_t stores = 0;    ///< write accesses
    std::uint64_t branches = 0;  ///< branch instructions executed, taken or not
    auto operator<=>(const CallCounts&) const = default;
};

/// Accesses of a whole run, up to now.
struct AccessTotals {
    std::uint64_t loads = 0;
    std::uint64_t stores = 0;
};

/// Consecutive calls of one function with equal counts.
struct CallRun {
    std::uint32_t entry = 0;
    std::uint64_t calls = 0;
    CallCounts counts;
};

class CallCounter : public StreamConsumer {
public:
    /// \param entries  addresses of the watched functions' first instructions (no Thumb bit)
    /// \param model    receives the stream of each watched call too; may be null. Blocks are not told to it.
    explicit CallCounter(std::set<std::uint32_t> entries, StreamConsumer* model = nullptr);

    void executes(const Instruction& instruction) override;
    void accesses(const Access& access) override;

    /// In place of `executes` and `accesses`: called before each block. The producer adds each access to `totals`.
    void executes_block(const TranslationBlock& block);
    [[nodiscard]] AccessTotals& totals() { return totals_; }

    [[nodiscard]] const std::vector<CallRun>& runs() const { return runs_; }
    /// For each function that was called, the addresses of all instructions that its calls executed.
    [[nodiscard]] const std::map<std::uint32_t, std::set<std::uint32_t>>& reached() const { return reached_; }
    /// Empty, or why the counts may not be trusted.
    [[nodiscard]] const std::string& fault() const { return fault_; }

    /// Writes runs and reached addresses as text, `end` or `fault` last; `read_call_log` reads it.
    void write(std::ostream& out) const;

private:
    // What is executed at once, an instruction or a block, decoded once.
    struct Piece {
        std::uint32_t address;
        std::uint32_t behind;
        std::uint32_t reached_from;      // entry of the last watched call that executed it
        std::uint32_t instructions = 0;  // none: not decoded yet
        std::uint32_t branches;
        bool call;  // the last is one
        bool entry;
        bool entry_inside;
    };
    [[nodiscard]] Piece decode(std::span<const Instruction> instructions) const;
    void executes(std::vector<Piece>& pieces, std::uint32_t index, std::span<const Instruction> instructions);
    void begin(const Piece& piece);
    void finish();

    std::set<std::uint32_t> entries_;
    StreamConsumer* model_;
    std::vector<Piece> instructions_;
    std::vector<Piece> blocks_;
    AccessTotals totals_;
    bool previous_is_call_ = false;
    std::uint32_t next_address_ = 0;  // behind the previous piece
    bool inside_ = false;
    std::uint32_t entry_ = 0;
    std::uint32_t return_address_ = 0;
    CallCounts counts_;
    AccessTotals totals_before_;
    std::set<std::uint32_t>* reached_now_ = nullptr;
    std::vector<CallRun> runs_;
    std::map<std::uint32_t, std::set<std::uint32_t>> reached_;
    std::string fault_;
};

struct CallLog {
    std::vector<CallRun> runs;
    std::map<std::uint32_t, std::set<std::uint32_t>> reached;
};
/// \throws std::runtime_error when the log is cut short or holds a fault.
[[nodiscard]] CallLog read_call_log(std::istream& in);

}  // namespace qemu
