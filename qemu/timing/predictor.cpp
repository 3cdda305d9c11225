#include "qemu/timing/predictor.hpp"

#include <algorithm>
#include <bit>

namespace timing {

namespace {

constexpr std::uint32_t history_counters = 4096;
constexpr std::uint32_t remembered = 0xFF;

}  // namespace

Predictor::Predictor(std::int64_t targets, std::int64_t returns, bool history)
    : entries_(std::bit_floor(
                   static_cast<std::size_t>(std::max<std::int64_t>(1, targets / static_cast<std::int64_t>(ways)))) *
               ways),
      last_set_(entries_.size() / ways - 1),
      returns_(static_cast<std::size_t>(std::clamp<std::int64_t>(returns, 0, 1024))),
      counters_(history ? history_counters : 0, 2) {}

int& Predictor::counter_of(std::uint32_t address, Entry& entry) {
    return counters_.empty() ? entry.confidence : counters_[(address >> 1 ^ past_ << 4) % history_counters];
}

Prediction Predictor::meet(const Decoded& branch, std::uint32_t address, std::uint32_t next) {
    const bool taken = next != address + branch.bytes;
    if (taken && branch.branch == Branch::back && !branch.in_it_block && held_ > 0) {
        const bool right = returns_[newest_] == next;
        newest_ = (newest_ + returns_.size() - 1) % returns_.size();
        --held_;
        return right ? Prediction::right : Prediction::wrong;
    }
    if (branch.is_call() && taken && !returns_.empty()) {
        newest_ = (newest_ + 1) % returns_.size();
        returns_[newest_] = address + branch.bytes;
        held_ = std::min(held_ + 1, returns_.size());
    }
    return meet_in_table(branch, address, next);
}

Prediction Predictor::meet_in_table(const Decoded& branch, std::uint32_t address, std::uint32_t next) {
    const bool taken = next != address + branch.bytes;
    Entry* const first = &entries_[(address >> 1 & last_set_) * ways];
    Entry* const found = std::find_if(first, first + ways, [&](const Entry& one) { return one.address == address; });
    const bool known = found != first + ways;
    if (found != first && (known || taken)) {
        std::rotate(first, known ? found : first + ways - 1, (known ? found : first + ways - 1) + 1);
    }
    Entry& entry = *first;
    const bool conditional = branch.branch == Branch::conditional || branch.in_it_block;
    const bool indirect = branch.branch == Branch::indirect || branch.branch == Branch::back;

    Prediction prediction = Prediction::right;
    if (known) {
        const bool says_taken = !conditional || counter_of(address, entry) >= 2;
        if (says_taken != taken || (taken && entry.target != next)) {
            prediction = Prediction::wrong;
        }
    } else if (indirect && taken) {
        prediction = Prediction::wrong;
    } else if (taken) {
        // The static rule: backward branches are taken, forward ones are not.
        prediction = !conditional || branch.backward ? Prediction::right_without_entry : Prediction::wrong;
    } else if (branch.backward) {
        prediction = Prediction::wrong;
    }

    if (known) {
        int& counter = counter_of(address, entry);
        counter = std::clamp(counter + (taken ? 1 : -1), 0, 3);
        if (taken) {
            entry.target = next;
        }
    } else if (taken) {
        entry = {address, next, 2};
    }
    if (conditional) {
        past_ = (past_ << 1 | (taken ? 1U : 0U)) & remembered;
    }
    return prediction;
}

}  // namespace timing
