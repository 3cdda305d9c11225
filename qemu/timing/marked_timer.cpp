#include "qemu/timing/marked_timer.hpp"

#include <ostream>
#include <utility>

namespace qemu {

MarkedTimer::Part::Part(const MarkedTimer& whole)
    : writer(whole.log_),
      timer(
          whole.entries_, whole.cores_, [this](const timing::TimedCall& call) { writer.add(call); },
          whole.double_routines_) {}

MarkedTimer::MarkedTimer(std::set<std::uint32_t> entries, std::vector<timing::CoreFile> cores,
                         std::optional<Marks> marks, std::ostream& log,
                         std::vector<timing::AddressRange> double_routines)
    : entries_(std::move(entries)),
      cores_(std::move(cores)),
      marks_(marks),
      log_(log),
      double_routines_(std::move(double_routines)),
      on_(!marks) {
    if (on_) {
        begin_part();
    }
}

bool MarkedTimer::is_mark(std::uint32_t address) const {
    return marks_ && (address == marks_->row || address == marks_->on || address == marks_->off);
}

void MarkedTimer::meets_mark(std::uint32_t address) {
    if (address == marks_->row) {
        finish();
        begin_part();
    } else if (address == marks_->on) {
        on_ = part_ != nullptr;
    } else if (on_) {
        // What has been executed is known, what comes next is not: the model shall not take a jump for a branch.
        part_->timer.finish();
        on_ = false;
    }
}

void MarkedTimer::executes(const Instruction& instruction) { part_->timer.executes(instruction); }

void MarkedTimer::finish() {
    if (part_) {
        part_->timer.finish();
        part_->writer.finish(part_->timer);
        part_.reset();
    }
    on_ = false;
}

void MarkedTimer::begin_part() { part_ = std::make_unique<Part>(*this); }

}  // namespace qemu
