#include "qemu/call_counter.hpp"

#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "qemu/thumb.hpp"

namespace qemu {
namespace {
constexpr std::uint32_t no_entry = 0xFFFFFFFFU;  // odd: no instruction's address
}

CallCounter::CallCounter(std::set<std::uint32_t> entries, StreamConsumer* model)
    : entries_(std::move(entries)), model_(model) {}

const CallCounter::Traits& CallCounter::traits(const Instruction& instruction) {
    while (traits_.size() <= instruction.index) {
        traits_.push_back({false, false, false, no_entry});
    }
    return traits_[instruction.index] = {is_branch(instruction), is_call(instruction),
                                         entries_.contains(instruction.address), no_entry};
}

void CallCounter::executes(const Instruction& instruction) {
    const bool seen = instruction.index < traits_.size();
    const Traits known = seen ? traits_[instruction.index] : traits(instruction);
    if (inside_ && instruction.address == return_address_) {
        finish();
    }
    if (!inside_ && known.entry) {
        begin(instruction);
    }
    if (inside_) {
        ++counts_.instructions;
        counts_.branches += known.branch ? 1U : 0U;
        if (known.reached_from != entry_) {
            traits_[instruction.index].reached_from = entry_;
            reached_now_->insert(instruction.address);
        }
        if (model_ != nullptr) {
            model_->executes(instruction);
        }
    }
    previous_is_call_ = known.call;
    next_address_ = instruction.address + instruction.bytes;
}

void CallCounter::accesses(const Access& access) {
    if (!inside_) {
        return;
    }
    ++(access.store ? counts_.stores : counts_.loads);
    if (model_ != nullptr) {
        model_->accesses(access);
    }
}

void CallCounter::begin(const Instruction& instruction) {
    if (!previous_is_call_) {
        fault_ = "a watched function was entered other than by a call instruction";
        return;
    }
    inside_ = true;
    entry_ = instruction.address;
    return_address_ = next_address_;
    counts_ = {};
    reached_now_ = &reached_[entry_];
}

void CallCounter::finish() {
    inside_ = false;
    if (runs_.empty() || runs_.back().entry != entry_ || runs_.back().counts != counts_) {
        runs_.push_back({entry_, 0, counts_});
    }
    ++runs_.back().calls;
}

void CallCounter::write(std::ostream& out) const {
    for (const CallRun& run : runs_) {
        out << "calls " << run.entry << ' ' << run.calls << ' ' << run.counts.instructions << ' ' << run.counts.loads
            << ' ' << run.counts.stores << ' ' << run.counts.branches << '\n';
    }
    for (const auto& [entry, addresses] : reached_) {
        out << "reached " << entry;
        for (const std::uint32_t address : addresses) {
            out << ' ' << address;
        }
        out << '\n';
    }
    if (!fault_.empty()) {
        out << "fault " << fault_ << '\n';
    } else if (inside_) {
        out << "fault a watched function did not return\n";
    } else {
        out << "end\n";
    }
}

CallLog read_call_log(std::istream& in) {
    CallLog log;
    std::string line;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "calls") {
            CallRun run;
            words >> run.entry >> run.calls >> run.counts.instructions >> run.counts.loads >> run.counts.stores >>
                run.counts.branches;
            if (!words) {
                throw std::runtime_error("call log: damaged line: " + line);
            }
            log.runs.push_back(run);
        } else if (kind == "reached") {
            std::uint32_t entry = 0;
            words >> entry;
            for (std::uint32_t address = 0; words >> address;) {
                log.reached[entry].insert(address);
            }
        } else if (kind == "end") {
            return log;
        } else {
            throw std::runtime_error("call log: " + line);
        }
    }
    throw std::runtime_error("call log: cut short: the emulator ended before it was written");
}

}  // namespace qemu
