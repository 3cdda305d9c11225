#include "qemu/timing/surroundings.hpp"

#include <algorithm>
#include <bit>

namespace timing {
namespace {

bool is_aligned(const qemu::Access& access) { return access.address % std::min<unsigned>(access.bytes, 4) == 0; }
std::uint16_t narrowed(std::int64_t cycles) {
    return static_cast<std::uint16_t>(std::min<std::int64_t>(cycles, 0xFFFF));
}

}  // namespace

Surroundings::Surroundings(const Figures& figures, Placement placement)
    : figures_(figures),
      fetch_shift_(static_cast<unsigned>(std::countr_zero(static_cast<std::uint32_t>(figures.fetch_bytes)))),
      memory_(figures_, placement),
      predictor_(figures.branch_target_entries) {
    stored_words_.fill(0xFFFFFFFFU);
}

const Event& Surroundings::meet(const Decoded& d, std::uint32_t address, std::span<const qemu::Access> accesses,
                                std::uint32_t next) {
    if (event_.store_delayed) {
        event_.store_delays.fill(0);
    }
    event_.store_delayed = false;
    event_.words = 0;
    event_.load_delay = 0;
    event_.accesses = 0;
    event_.access_bytes = 0;
    event_.odd_word = event_.off_eight = event_.unaligned = event_.has_banks = event_.in_dtcm = false;
    event_.meets = 0;
    event_.prediction = Prediction::right;
    fetch(d, address);
    if (!accesses.empty()) {
        const std::uint32_t first = accesses.front().address;
        event_.accesses = static_cast<std::uint8_t>(std::min<std::size_t>(accesses.size(), 32));
        event_.access_bytes = accesses.front().bytes;
        event_.odd_word = (first >> 2 & 1U) != 0;
        event_.off_eight = first % 8 != 0;
        event_.has_banks = memory_.has_banks(first);
        event_.in_dtcm = memory_.in_dtcm(first);
        event_.unaligned = !is_aligned(accesses.front());
        d.is_store() ? store(accesses) : load(accesses);
    }
    event_.taken = d.branch != Branch::none && next != address + d.bytes;
    if (d.branch != Branch::none) {
        if (event_.taken) {
            fetched_ = 0xFFFFFFFFU;
        }
        event_.prediction = predictor_.meet(d, address, next);
    }
    return event_;
}

void Surroundings::fetch(const Decoded& d, std::uint32_t address) {
    const std::uint32_t last = (address + d.bytes - 1) >> fetch_shift_;
    for (std::uint32_t word = address >> fetch_shift_; word <= last; ++word) {
        if (word == fetched_) {
            continue;
        }
        fetched_ = word;
        const Delay delay = memory_.fetch(word << fetch_shift_);
        if (delay.cycles > 0) {
            event_.fetch_effect = delay.effect;
        }
        event_.fetch_delays[event_.words++ % event_.fetch_delays.size()] = narrowed(delay.cycles);
    }
}

void Surroundings::load(std::span<const qemu::Access> accesses) {
    for (std::size_t n = 0; n < stored_words_.size(); ++n) {
        event_.meets |= static_cast<std::uint8_t>(stored_words_[n] == accesses.front().address >> 2 ? 1U << n : 0U);
    }
    for (const qemu::Access& access : accesses) {
        const Delay delay = memory_.load(access.address);
        if (delay.cycles > 0) {
            event_.load_delay += narrowed(delay.cycles);
            event_.load_effect = delay.effect;
        }
    }
}

void Surroundings::store(std::span<const qemu::Access> accesses) {
    std::size_t nth = 0;
    for (const qemu::Access& access : accesses) {
        const Delay delay = memory_.store(access.address);
        if (delay.cycles > 0) {
            event_.store_delayed = true;
            event_.store_effect = delay.effect;
            event_.store_delays[nth % event_.store_delays.size()] = narrowed(delay.cycles);
        }
        for (std::size_t n = stored_words_.size() - 1; n > 0; --n) {
            stored_words_[n] = stored_words_[n - 1];
        }
        stored_words_[0] = access.address >> 2;
        ++nth;
    }
}

}  // namespace timing
