#include "qemu/timing/surroundings.hpp"

#include <algorithm>
#include <bit>

namespace timing {
namespace {

void without_accesses(Event& event) {
    static_cast<AccessEvent&>(event) = AccessEvent();
    if (event.store_delayed) {
        event.store_delays.fill(0);
        event.store_delayed = false;
    }
}

bool is_aligned(const qemu::Access& access) { return access.address % std::min<unsigned>(access.bytes, 4) == 0; }
std::uint16_t narrowed(std::int64_t cycles) {
    return static_cast<std::uint16_t>(std::min<std::int64_t>(cycles, 0xFFFF));
}

}  // namespace

Surroundings::Surroundings(const Figures& figures, const Placement& placement, Core core)
    : figures_(figures),
      predicts_(core == Core::cortex_m7),
      fetch_shift_(static_cast<unsigned>(std::countr_zero(static_cast<std::uint32_t>(figures.fetch_bytes)))),
      memory_(figures_, placement),
      predictor_(figures.branch_target_entries, figures.branch_return_entries, figures.mechanisms.history_predictor) {}

const Event& Surroundings::meet(const Decoded& d, std::uint32_t address, std::span<const qemu::Access> accesses,
                                std::uint32_t next) {
    without_accesses(event_);
    fetch(d, address, event_);
    if (!accesses.empty()) {
        access(accesses, event_);
    }
    follow(d, address, next, event_);
    return event_;
}

void Surroundings::meet(std::span<const CodeBlock::Instruction> lines, std::span<const qemu::Access> accesses,
                        std::uint32_t next, BlockEvents& met) {
    met.events.resize(lines.size());
    for (const std::uint32_t nth : met.touched) {
        without_accesses(met.events[nth]);
    }
    met.touched.clear();
    std::size_t a = 0;
    const auto access_of = [&](std::uint32_t nth) {
        const std::size_t first = a;
        while (a < accesses.size() && accesses[a].by == nth) {
            ++a;
        }
        access(accesses.subspan(first, a - first), met.events[nth]);
        met.touched.push_back(nth);
    };
    // Where fetching takes nothing, all but the first instruction take up the words that they took up before.
    const CodeBlock::Instruction& last = lines.back();
    const std::uint32_t last_byte = last.address + last.instruction->decoded.bytes - 1;
    met.fetched_freely = met.known && memory_.fetches_freely(lines.front().address, last_byte);
    if (met.fetched_freely) {
        fetch(lines.front().instruction->decoded, lines.front().address, met.events.front());
        fetched_ = lines.size() > 1 ? met.last_word : fetched_;
        while (a < accesses.size()) {
            access_of(accesses[a].by);
        }
    } else {
        met.known = true;
        for (std::uint32_t nth = 0; nth < lines.size(); ++nth) {
            const Decoded& d = lines[nth].instruction->decoded;
            fetch(d, lines[nth].address, met.events[nth]);
            if (a < accesses.size() && accesses[a].by == nth) {
                access_of(nth);
            }
            if (nth + 1 < lines.size()) {
                follow(d, lines[nth].address, lines[nth + 1].address, met.events[nth]);
            }
            met.known =
                met.known && !met.events[nth].fetch_delayed() && (d.branch == Branch::none || nth + 1 == lines.size());
        }
        met.last_word = fetched_;
    }
    follow(last.instruction->decoded, last.address, next, met.events.back());
    met.make_key();
}

void Surroundings::access(std::span<const qemu::Access> accesses, Event& event) {
    const std::uint32_t first = accesses.front().address;
    AccessEvent found;
    found.accesses = static_cast<std::uint8_t>(std::min<std::size_t>(accesses.size(), 32)) & 63U;
    found.access_bytes = accesses.front().bytes & 15U;
    found.odd_word = first >> 2 & 1U;
    found.off_eight = first % 8 != 0 ? 1U : 0U;
    found.has_banks = memory_.has_banks(first) ? 1U : 0U;
    found.in_dtcm = memory_.in_dtcm(first) ? 1U : 0U;
    found.unaligned = is_aligned(accesses.front()) ? 0U : 1U;
    if (accesses.front().store) {
        store(accesses, event);
    } else {
        load(accesses, found, event.load_effect);
    }
    static_cast<AccessEvent&>(event) = found;
}

void Surroundings::follow(const Decoded& d, std::uint32_t address, std::uint32_t next, Event& event) {
    event.taken = d.branch != Branch::none && next != address + d.bytes;
    if (d.branch != Branch::none) {
        if (event.taken) {
            fetched_ = 0xFFFFFFFFU;
        }
        if (predicts_) {
            event.prediction = predictor_.meet(d, address, next);
        }
    }
}

void Surroundings::fetch(const Decoded& d, std::uint32_t address, Event& event) {
    std::uint8_t words = 0;
    event.fetch_delays.fill(0);
    const std::uint32_t last = (address + d.bytes - 1) >> fetch_shift_;
    for (std::uint32_t word = address >> fetch_shift_; word <= last; ++word) {
        if (word == fetched_) {
            continue;
        }
        fetched_ = word;
        const Delay delay = memory_.fetch(word << fetch_shift_);
        if (delay.cycles > 0) {
            event.fetch_effect = delay.effect;
        }
        event.fetch_delays[words++ % event.fetch_delays.size()] = narrowed(delay.cycles);
    }
    event.words = words & 7U;
    event.second_half = (address & 2U) != 0;
}

void Surroundings::load(std::span<const qemu::Access> accesses, AccessEvent& event, Effect& effect) {
    event.meets = stored_words_.met_by(accesses.front().address) & 0xFFU;
    std::int64_t cycles = 0;
    for (const qemu::Access& access : accesses) {
        const Delay delay = memory_.load(access.address);
        if (delay.cycles > 0) {
            cycles += delay.cycles;
            effect = delay.effect;
        }
    }
    event.load_delay = narrowed(cycles);
}

void Surroundings::store(std::span<const qemu::Access> accesses, Event& event) {
    std::size_t nth = 0;
    for (const qemu::Access& access : accesses) {
        const Delay delay = memory_.store(access.address);
        if (delay.cycles > 0) {
            event.store_delayed = true;
            event.store_effect = delay.effect;
            event.store_delays[nth % event.store_delays.size()] = narrowed(delay.cycles);
        }
        stored_words_.add(access.address);
        ++nth;
    }
}

}  // namespace timing
