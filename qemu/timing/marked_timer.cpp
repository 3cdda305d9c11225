#include "qemu/timing/marked_timer.hpp"

#include <ostream>
#include <utility>

namespace qemu {

MarkedTimer::Part::Part(const MarkedTimer& whole, const std::set<std::uint32_t>& entries)
    : writer(log),
      timer(
          entries, whole.cores_, [this](const timing::TimedCall& call) { writer.add(call); }, whole.double_routines_) {
    timer.watch_exceptions(whole.handlers_);
    timer.watch_unwinding(whole.unwinding_);
    timer.watch_faults(whole.fault_handlers_);
}

MarkedTimer::MarkedTimer(std::set<std::uint32_t> entries, std::vector<timing::CoreFile> cores,
                         std::optional<Marks> marks, std::ostream& log,
                         std::vector<timing::AddressRange> double_routines, std::set<std::uint32_t> handlers,
                         std::set<std::uint32_t> fault_handlers, std::set<std::uint32_t> stretches,
                         timing::Unwinding unwinding)
    : entries_(std::move(entries)),
      cores_(std::move(cores)),
      marks_(marks),
      log_(log),
      double_routines_(std::move(double_routines)),
      handlers_(std::move(handlers)),
      fault_handlers_(std::move(fault_handlers)),
      stretches_(std::move(stretches)),
      unwinding_(std::move(unwinding)),
      on_(!marks) {
    for (const std::uint32_t entry : marks_ ? std::set<std::uint32_t>() : entries_) {
        begin_part({entry});
    }
    for (const std::uint32_t begin : stretches_) {
        begin_part({});
        parts_.back()->timer.watch_stretch(begin);
    }
}

bool MarkedTimer::is_mark(std::uint32_t address) const {
    return marks_ && (address == marks_->row || address == marks_->on || address == marks_->off);
}

void MarkedTimer::meets_mark(std::uint32_t address) {
    if (address == marks_->row) {
        finish();
        begin_part(entries_);
    } else if (address == marks_->on) {
        on_ = !parts_.empty();
    } else if (on_) {
        // What has been executed is known, what comes next is not: the model shall not take a jump for a branch.
        for (const auto& part : parts_) {
            part->timer.finish();
        }
        on_ = false;
    }
}

void MarkedTimer::executes(const Instruction& instruction) {
    for (const auto& part : parts_) {
        part->timer.executes(instruction);
    }
}

void MarkedTimer::executes_block(const TranslationBlock& block, std::size_t done) {
    for (const auto& part : parts_) {
        part->timer.executes_block(block, done);
    }
}

void MarkedTimer::accesses(const Access& access) {
    for (const auto& part : parts_) {
        part->timer.accesses(access);
    }
}

void MarkedTimer::finish() {
    for (const auto& part : parts_) {
        part->timer.finish();
        part->writer.finish(part->timer);
        log_ << part->log.str();
    }
    parts_.clear();
    on_ = false;
}

void MarkedTimer::begin_part(const std::set<std::uint32_t>& entries) {
    parts_.push_back(std::make_unique<Part>(*this, entries));
}

}  // namespace qemu
