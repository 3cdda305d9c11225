// The timing model on a program that says itself what is to be timed: it calls three empty functions.
//
//   row   a new part begins: whatever was learnt of caches and branches is forgotten, so that its cycles do not depend
//   on
//         what ran before
//   on    the model sees all that follows, calls of watched functions and what lies between them
//   off   it sees nothing
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "qemu/stream/stream.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// Addresses of the three functions.
struct Marks {
    std::uint32_t row;
    std::uint32_t on;
    std::uint32_t off;
};

class MarkedTimer final : public StreamConsumer {
public:
    /// \param entries  addresses of the functions to time
    /// \param marks    without: the whole program is timed from the start, in one part for each function in the order
    /// of
    ///                 their addresses, so that one that another calls has calls of its own
    /// \param double_routines  see timing::CallTimer
    /// \param handlers, fault_handlers, unwinding  likewise
    /// \param stretches  addresses of the begin marks of stretches that are to be timed, each in a part of its own
    /// behind
    ///                   those of the functions; without \p marks
    /// \param log      receives one timing log a part, each with its end
    MarkedTimer(std::set<std::uint32_t> entries, std::vector<timing::CoreFile> cores, std::optional<Marks> marks,
                std::ostream& log, std::vector<timing::AddressRange> double_routines = {},
                std::set<std::uint32_t> handlers = {}, std::set<std::uint32_t> fault_handlers = {},
                std::set<std::uint32_t> stretches = {}, timing::Unwinding unwinding = {});

    /// Whether the instruction is a mark's first: `meets_mark` is then to be called in place of `executes`.
    [[nodiscard]] bool is_mark(std::uint32_t address) const;
    void meets_mark(std::uint32_t address);
    /// Whether the instruction is to be a block by itself.
    [[nodiscard]] bool stands_alone(const Instruction& instruction) const {
        return !stretches_.empty() && is_stretch_mark(instruction);
    }
    /// Address of the instruction that first led to a fault handler.
    [[nodiscard]] std::optional<std::uint32_t> fault() const {
        return parts_.empty() ? std::nullopt : parts_.front()->timer.fault();
    }
    /// Whether the model is to see what is executed.
    [[nodiscard]] bool on() const { return on_; }
    void executes(const Instruction& instruction) override;
    void accesses(const Access& access) override;
    /// In place of `executes`, see `timing::CallTimer`.
    void executes_block(const TranslationBlock& block, std::size_t done);
    /// The program has ended.
    void finish();

private:
    struct Part {
        std::ostringstream log;
        timing::TimingLogWriter writer;
        timing::CallTimer timer;
        Part(const MarkedTimer& whole, const std::set<std::uint32_t>& entries);
    };
    void begin_part(const std::set<std::uint32_t>& entries);

    std::set<std::uint32_t> entries_;
    std::vector<timing::CoreFile> cores_;
    std::optional<Marks> marks_;
    std::ostream& log_;
    std::vector<timing::AddressRange> double_routines_;
    std::set<std::uint32_t> handlers_;
    std::set<std::uint32_t> fault_handlers_;
    std::set<std::uint32_t> stretches_;
    timing::Unwinding unwinding_;
    std::vector<std::unique_ptr<Part>> parts_;  // that see the same
    bool on_;
};

}  // namespace qemu
