// The calls under way in a stream: their return addresses, and the exceptions that came between.
//
// A stream tells no exception: the next instruction is a handler's first. Where one returns to, no address says: its
// own return jumps to a value that only the core knows (EXC_RETURN). So a return, while no call is under way within the
// handler, ends the handler. [ARMv7-M B1.5.6, B1.5.8]
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "qemu/timing/decoded.hpp"

namespace timing {

struct AddressRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;  ///< behind its last byte
};

/// What leaves calls without returning from them, and where it may go on.
struct Unwinding {
    std::vector<AddressRange> restorers;  ///< what sets all registers, the program counter last
    /// Where each function's code begins, with a number that all its parts share; behind the last one, too.
    std::map<std::uint32_t, std::uint32_t> functions;
};

class CallStack {
public:
    /// \param entries  first instructions of functions that may be a handler's, as nothing but a call or a jump leads
    /// there
    explicit CallStack(std::set<std::uint32_t> entries) : entries_(std::move(entries)) {}
    /// \param handlers  first instructions of what the program's vector table names
    void watch_exceptions(std::set<std::uint32_t> handlers) { handlers_ = std::move(handlers); }
    void watch_unwinding(Unwinding unwinding) { unwinding_ = std::move(unwinding); }

    /// An instruction is executed next. \return how many calls and exceptions are left of those before it: one that
    ///                                          begins with it is not among them
    std::size_t arrive(std::uint32_t address);
    /// An instruction was executed. \param next  address of the one behind it in time
    void leave(const Decoded& last, std::uint32_t address, std::uint32_t next);

    /// How many calls and exceptions are under way.
    [[nodiscard]] std::size_t depth() const { return frames_.size(); }
    /// Whether the last instruction called.
    [[nodiscard]] bool called() const { return called_; }

private:
    struct Frame {
        std::uint32_t address;  // where the call returns to; of an exception, its handler
        bool exception;
    };
    [[nodiscard]] bool is_exception(std::uint32_t address) const;
    [[nodiscard]] std::optional<std::uint32_t> function_of(std::uint32_t address) const;
    void land(std::uint32_t address);

    std::set<std::uint32_t> entries_;
    std::set<std::uint32_t> handlers_;
    Unwinding unwinding_;
    std::vector<Frame> frames_;
    std::uint32_t sequential_ = 0;  // behind the last instruction
    bool called_ = false;
    bool unwound_ = false;
};

}  // namespace timing
