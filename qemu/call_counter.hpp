// Counts each call of watched functions in a stream: instructions, loads, stores and branches, from the first
// instruction at the entry to the last before control is back behind the call. Callees count, to any depth.
#pragma once

#include <compare>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "qemu/stream.hpp"

namespace qemu {

struct CallCounts {
    std::uint64_t instructions = 0;
    std::uint64_t loads = 0;     ///< read accesses
    std::uint64_t stores = 0;    ///< write accesses
    std::uint64_t branches = 0;  ///< branch instructions executed, taken or not
    auto operator<=>(const CallCounts&) const = default;
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
    /// \param model    receives the stream of each watched call too; may be null
    explicit CallCounter(std::set<std::uint32_t> entries, StreamConsumer* model = nullptr);

    void executes(const Instruction& instruction) override;
    void accesses(const Access& access) override;

    [[nodiscard]] const std::vector<CallRun>& runs() const { return runs_; }
    /// For each function that was called, the addresses of all instructions that its calls executed.
    [[nodiscard]] const std::map<std::uint32_t, std::set<std::uint32_t>>& reached() const { return reached_; }
    /// Empty, or why the counts may not be trusted.
    [[nodiscard]] const std::string& fault() const { return fault_; }

    /// Writes runs and reached addresses as text, `end` or `fault` last; `read_call_log` reads it.
    void write(std::ostream& out) const;

private:
    // What is looked up at every execution, decoded once.
    struct Traits {
        bool branch;
        bool call;
        bool entry;
        std::uint32_t reached_from;  // entry of the last watched call that executed it
    };
    const Traits& traits(const Instruction& instruction);
    void begin(const Instruction& instruction);
    void finish();

    std::set<std::uint32_t> entries_;
    StreamConsumer* model_;
    std::vector<Traits> traits_;
    bool previous_is_call_ = false;
    std::uint32_t next_address_ = 0;  // behind the previous instruction
    bool inside_ = false;
    std::uint32_t entry_ = 0;
    std::uint32_t return_address_ = 0;
    CallCounts counts_;
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
