#include "qemu/stream/call_counter.hpp"

#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/words.hpp"
#include "qemu/stream/thumb.hpp"

namespace qemu {
namespace {
constexpr std::uint32_t no_entry = 0xFFFFFFFFU;  // odd: no instruction's address
}

CallCounter::CallCounter(std::set<std::uint32_t> entries, StreamConsumer* model)
    : entries_(std::move(entries)), model_(model) {}

CallCounter::Piece CallCounter::decode(std::span<const Instruction> instructions) const {
    const Instruction& first = instructions.front();
    const Instruction& last = instructions.back();
    Piece piece{.address = first.address,
                .behind = last.address + last.bytes,
                .reached_from = no_entry,
                .instructions = static_cast<std::uint32_t>(instructions.size()),
                .branches = 0,
                .call = is_call(last),
                .entry = entries_.contains(first.address),
                .entry_inside = false};
    for (const Instruction& instruction : instructions) {
        piece.branches += is_branch(instruction) ? 1U : 0U;
        piece.entry_inside |= &instruction != &first && entries_.contains(instruction.address);
    }
    return piece;
}

void CallCounter::executes(std::vector<Piece>& pieces, std::uint32_t index, std::span<const Instruction> instructions) {
    if (index >= pieces.size()) {
        pieces.resize(index + 1);
    }
    Piece& piece = pieces[index];
    if (piece.instructions == 0) {
        piece = decode(instructions);
    }
    if (inside_ && piece.address == return_address_) {
        finish();
    }
    if (!inside_ && (piece.entry || piece.entry_inside)) {
        begin(piece);
    }
    if (inside_) {
        counts_.instructions += piece.instructions;
        counts_.branches += piece.branches;
        if (piece.reached_from != entry_) {
            piece.reached_from = entry_;
            for (const Instruction& instruction : instructions) {
                reached_now_->insert(instruction.address);
            }
        }
    }
    previous_is_call_ = piece.call;
    next_address_ = piece.behind;
}

void CallCounter::executes(const Instruction& instruction) {
    executes(instructions_, instruction.index, {&instruction, 1});
    if (inside_ && model_ != nullptr) {
        model_->executes(instruction);
    }
}

void CallCounter::executes_block(const TranslationBlock& block) { executes(blocks_, block.index, block.instructions); }

void CallCounter::accesses(const Access& access) {
    ++(access.store ? totals_.stores : totals_.loads);
    if (inside_ && model_ != nullptr) {
        model_->accesses(access);
    }
}

void CallCounter::begin(const Piece& piece) {
    if (!piece.entry || !previous_is_call_) {
        fault_ = "a watched function was entered other than by a call instruction";
        return;
    }
    inside_ = true;
    entry_ = piece.address;
    return_address_ = next_address_;
    counts_ = {};
    totals_before_ = totals_;
    reached_now_ = &reached_[entry_];
}

void CallCounter::finish() {
    inside_ = false;
    counts_.loads = totals_.loads - totals_before_.loads;
    counts_.stores = totals_.stores - totals_before_.stores;
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
    constexpr std::size_t longest_line = 16U << 20;  // a function's addresses, each of at most 11 characters
    constexpr std::size_t most_runs = 50'000'000;
    const auto refuse = [](const std::string& what) { return std::runtime_error("call log: " + what.substr(0, 200)); };
    CallLog log;
    std::string line;
    while (std::getline(in, line)) {
        if (line.size() > longest_line || log.runs.size() > most_runs) {
            throw refuse("larger than any program's: " + line);
        }
        base::Words words(line);
        const std::string_view kind = words.next();
        if (kind == "calls") {
            const auto entry = words.number<std::uint32_t>();
            std::optional<std::uint64_t> numbers[5];
            bool whole = entry.has_value();
            for (auto& number : numbers) {
                number = words.number<std::uint64_t>();
                whole = whole && number;
            }
            if (!whole || *numbers[0] == 0 || !words.done()) {
                throw refuse("damaged line: " + line);
            }
            log.runs.push_back({*entry, *numbers[0], {*numbers[1], *numbers[2], *numbers[3], *numbers[4]}});
        } else if (kind == "reached") {
            const auto entry = words.number<std::uint32_t>();
            bool whole = entry.has_value();
            while (whole && !words.done()) {
                const auto address = words.number<std::uint32_t>();
                whole = address.has_value();
                log.reached[*entry].insert(address.value_or(0));
            }
            if (!whole) {
                throw refuse("damaged line: " + line);
            }
        } else if (kind == "end" && words.done()) {
            return log;
        } else {
            throw refuse(line);
        }
    }
    throw refuse("cut short: the emulator ended before it was written");
}

}  // namespace qemu
