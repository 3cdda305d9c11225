#include "qemu/timing/model.hpp"

#include <algorithm>

#include "qemu/timing/pairing.hpp"
#include "qemu/timing/pipelines.hpp"

namespace timing {
namespace {

constexpr std::int32_t never = State::never;

}  // namespace

Prepared::Prepared(const Decoded& d) : decoded(d) {
    for (std::size_t i = 0; i < d.read_count; ++i) {
        consumers[i] = consumer_of(d, d.reads[i].role);
    }
}

Pipeline::Pipeline(const Figures& figures, std::int64_t longest_fetch, Effects off)
    : PipelineBase(figures, off), latencies_(figures_) {
    const auto& f = figures_;
    fetch_queue_ = static_cast<std::size_t>(std::clamp<std::int64_t>(f.fetch_queue, 1, 8));
    // The next words come a cycle and at most the longest delay apart, as long as none of them is used in cycle 0 or
    // later.
    fetch_memory_ = static_cast<std::int32_t>(static_cast<std::int64_t>(fetch_queue_ + 1) * (1 + longest_fetch));
    fp_memory_ = static_cast<std::int32_t>(
        std::max({f.fp_bar_after_mac, f.fp_younger_bar_after_mac, f.fp_fma_bar_after_mla, f.fp_load_bar_after_mac,
                  f.fp_overwrite_bar_after_mac, f.fp_mac_bar_after_load, f.fp_mac_bar_after_store,
                  f.fp_chain_across_transfer, f.fp_move_spacing, f.branch_flags_known_after}));
}

void Pipeline::hold_next(Effect effect, std::int32_t until) {
    state.next_holds.at(state.next_hold_count++) = {until, effect};
}

// The order of attribution: what the instruction before left behind (a wrong guess, a miss, an instruction that issues
// for several cycles), then the bytes of this one, its operands, the FPU, the store buffer, last the slot.
void Pipeline::execute(const Prepared& instruction, const Event& event) {
    const Decoded& d = instruction.decoded;
    ++state.position;
    for (std::size_t i = 0; i < state.next_hold_count; ++i) {
        hold(state.next_holds[i].effect, state.next_holds[i].until);
    }
    state.next_hold_count = 0;
    wait_for_bytes(event);
    wait_for_operands(instruction);
    wait_for_fpu(d);
    wait_for_stores(d, event);
    wait_for_a_slot(d, event);
    wait_for_division();

    result_delay_ = 0;
    access_memory(d, event);
    write_results(instruction);
    occupy(d, event);
    note_fpu(d);
    if (d.branch != Branch::none) {
        follow_branch(d, event);
    }
    state.older = state.position % 2 == 0 ? &d : nullptr;
    state.older_taken = event.taken;
    state.older_accesses = event.accesses > 0;
    state.older_odd_word = event.odd_word;
    state.older_has_banks = event.has_banks;
}

// One word of `fetch.bytes` arrives a cycle, at most `fetch.queue` of them ahead of their use. A branch to any place
// takes up a new word, at once if it was foreseen.
void Pipeline::wait_for_bytes(const Event& event) {
    for (std::size_t n = 0; n < std::min<std::size_t>(event.words, event.fetch_delays.size()); ++n) {
        const std::int32_t on_time = std::max(state.fetch_ready + 1, state.fetch_used[fetch_queue_ - 1]);
        hold_cycle(Effect::fetch_alignment, on_time);
        state.fetch_ready = on_time;
        if (event.fetch_delays[n] > 0) {
            state.fetch_ready = on_time + event.fetch_delays[n];
            hold_cycle(event.fetch_effect, state.fetch_ready);
        }
        std::copy_backward(state.fetch_used.begin(), state.fetch_used.end() - 1, state.fetch_used.end());
        state.fetch_used[0] = state.position / 2;
    }
}

void Pipeline::wait_for_operands(const Prepared& instruction) {
    const Decoded& d = instruction.decoded;
    if (d.branch != Branch::none && d.registers == 0) {
        return;  // foreseen; a wrong guess is paid afterwards
    }
    for (std::size_t i = 0; i < d.read_count; ++i) {
        const State::Value& value = state.values[d.reads[i].reg];
        if (value.producer == Producer::nothing) {
            continue;
        }
        const Effect effect = effect_of(value.producer);
        hold_cycle(effect, value.cycle + latencies_.between(value.producer, instruction.consumers[i]));
        const bool chains = d.kind == Kind::fp_mac && d.reads[i].role == Role::accumulator &&
                            (value.producer == Producer::fma || value.producer == Producer::mla);
        if (chains && std::max(state.last_fp_load, state.last_fp_store) >= value.cycle) {
            hold_cycle(effect, value.cycle + figures_.fp_chain_across_transfer);
        }
    }
}

// VDIV and VSQRT let one more instruction issue, with them.
void Pipeline::wait_for_division() {
    if (state.position / 2 > state.fp_blocks_from) {
        hold_cycle(Effect::fpu_latency, state.fp_blocks_until);
    }
}

void Pipeline::wait_for_fpu(const Decoded& d) {
    if (!d.is_fp) {
        return;
    }
    const auto after = [&](std::int64_t event, std::int64_t barred) {
        if (barred > 0) {
            hold_cycle(Effect::fpu_latency, event + barred + 1);
        }
    };
    const bool loads = d.is_load();
    const bool multiple = d.kind == Kind::load_multiple || d.kind == Kind::store_multiple;
    if (d.kind == Kind::fp_add || d.kind == Kind::fp_move_immediate || multiple) {
        after(state.last_mac, figures_.fp_bar_after_mac);
    }
    if (loads) {
        after(state.last_mac, figures_.fp_load_bar_after_mac);
        for (std::size_t i = 0; i < d.write_count; ++i) {
            const unsigned reg = d.writes[i].reg;
            if (figures_.fp_overwrite_bar_after_mac > 0 && reg >= registers::s0 && reg < registers::flags) {
                hold_cycle(Effect::fpu_latency,
                           state.multiplicand_of_mac[reg - registers::s0] + figures_.fp_overwrite_bar_after_mac);
            }
        }
    }
    if (d.kind == Kind::fp_mac) {
        after(state.last_fp_load, figures_.fp_mac_bar_after_load);
        after(state.last_fp_store, figures_.fp_mac_bar_after_store);
        if (d.fused) {
            after(state.last_mla, figures_.fp_fma_bar_after_mla);
        }
    }
    if (d.kind == Kind::fp_move) {
        hold_cycle(Effect::fpu_latency, state.last_move + figures_.fp_move_spacing);
    }
    if (d.is_fp_arithmetic()) {
        hold_cycle(Effect::fpu_latency, state.fp_busy_until);
    }
    // The younger slot is closed behind MACs, and the older one of a MAC's own cycle is not this one's.
    const bool transfers = d.kind == Kind::load || d.kind == Kind::store || d.kind == Kind::fp_move ||
                           d.kind == Kind::fp_from_core || d.kind == Kind::fp_to_core;
    if (transfers && state.position % 2 == 1 && state.position / 2 > state.last_mac &&
        state.position / 2 <= state.last_mac + figures_.fp_younger_bar_after_mac) {
        hold(Effect::fpu_latency, state.position + 1);
    }
}

void Pipeline::wait_for_stores(const Decoded& d, const Event& event) {
    if (event.accesses == 0) {
        return;
    }
    if (d.is_store()) {
        hold_cycle(Effect::store_buffer, state.store_buffer.free_from(figures_));
        return;
    }
    for (std::size_t n = 0; n < stores_watched; ++n) {
        if ((event.meets >> n & 1U) != 0) {
            hold_cycle(Effect::store_buffer, state.stored[n] + figures_.store_to_load);
        }
    }
    if (event.in_dtcm) {
        std::int32_t& late = state.late_fp_store[event.odd_word ? 1 : 0];
        const std::int32_t since = state.position / 2 - late;
        if (since > 0 && since <= figures_.store_late_fp_window) {
            late = never;
            hold_cycle(Effect::load_bank_conflict, state.position / 2 + figures_.store_late_fp_cost);
        }
    }
}

bool Pipeline::banks_conflict(const Event& event) const {
    if (event.accesses == 0 || !state.older_accesses) {
        return false;  // one of them was not carried out
    }
    return !event.has_banks || !state.older_has_banks || event.odd_word == state.older_odd_word;
}

void Pipeline::wait_for_a_slot(const Decoded& d, const Event& event) {
    if (state.position % 2 == 0) {
        return;
    }
    if (state.older == nullptr || !may_pair(*state.older, d, state.older_taken, figures_)) {
        hold(Effect::single_issue, state.position + 1);
        return;
    }
    const bool mac_and_transfer = (state.older->kind == Kind::fp_mac && d.is_fp && !d.is_fp_arithmetic()) ||
                                  (d.kind == Kind::fp_mac && state.older->is_fp && !state.older->is_fp_arithmetic());
    if (mac_and_transfer && figures_.fp_mac_pairs_with_fp_transfer == 0) {
        const std::int64_t before = state.older->kind == Kind::fp_mac ? state.mac_before : state.last_mac;
        const bool first = before + figures_.fp_bar_after_mac < state.position / 2;
        if (!first || figures_.fp_first_mac_pairs_with_fp_transfer == 0) {
            hold(Effect::single_issue, state.position + 1);
            return;
        }
    }
    if (d.kind == Kind::load && state.older->kind == Kind::load && banks_conflict(event)) {
        hold(Effect::load_bank_conflict, state.position + 1);
    }
}

Producer Pipeline::producer_of(const Prepared& instruction) const {
    const Decoded& d = instruction.decoded;
    switch (d.kind) {
        case Kind::add:
        case Kind::shift: {
            for (const auto& [reg, role] : d.all_reads()) {
                const State::Value& value = state.values[reg];
                if (role == Role::condition ||
                    (value.producer != Producer::nothing &&
                     state.position / 2 < value.cycle + latencies_.between(value.producer, Consumer::shifted))) {
                    return Producer::late;
                }
            }
            const bool younger_addition = d.kind == Kind::add && state.position % 2 == 1;
            return younger_addition && figures_.result_add_in_younger_slot_early == 0 ? Producer::younger_add
                                                                                      : Producer::early;
        }
        case Kind::bitfield:
            return d.early_result ? Producer::reversed : d.saturates ? Producer::saturated : Producer::bitfield;
        case Kind::multiply:
            return Producer::multiply;
        case Kind::divide:
            return Producer::divide;
        case Kind::fp_add:
            return d.is_double ? Producer::add64 : Producer::fp_add;
        case Kind::fp_mul:
            return d.is_double ? Producer::mul64 : Producer::fp_mul;
        case Kind::fp_mac:
            return d.is_double ? Producer::mac64 : d.fused ? Producer::fma : Producer::mla;
        case Kind::fp_divide:
        case Kind::fp_sqrt:
        case Kind::fp_convert:
            return Producer::fp_convert;
        case Kind::fp_move:
            return Producer::fp_move;
        case Kind::fp_from_core:
            return Producer::core_to_fp;
        case Kind::fp_to_core:
            return Producer::to_core;
        case Kind::fp_move_immediate:
            return Producer::fp_immediate;
        default:
            return Producer::late;
    }
}

void Pipeline::write_results(const Prepared& instruction) {
    const Decoded& d = instruction.decoded;
    const std::int32_t cycle = now();
    const Producer result = producer_of(instruction);
    const Producer loaded = d.is_fp               ? Producer::fp_load
                            : d.access_bytes == 4 ? Producer::load_word
                                                  : Producer::load_narrow;
    std::int64_t nth = 0;
    for (std::size_t i = 0; i < d.write_count; ++i) {
        State::Value& value = state.values[d.writes[i].reg];
        switch (d.writes[i].source) {
            case Source::result:
                value = {cycle, result};
                if (d.kind == Kind::divide) {
                    value.cycle += static_cast<std::int32_t>(figures_.result_divide - 1);
                } else if (d.kind == Kind::fp_divide || d.kind == Kind::fp_sqrt) {
                    value = {};  // everything waits for its end
                }
                break;
            case Source::loaded:
                value = {
                    cycle + static_cast<std::int32_t>(
                                nth / std::max<std::int64_t>(1, figures_.issue_registers_per_cycle) + result_delay_),
                    loaded};
                ++nth;
                break;
            case Source::base:
                value = {cycle, Producer::base};
                break;
            case Source::flags:
                value = {cycle, d.kind == Kind::fp_add ? Producer::compare : Producer::flags};
                break;
        }
    }
}

// Cycles that an instruction issues for.
void Pipeline::occupy(const Decoded& d, const Event& event) {
    const std::int32_t cycle = now();
    if ((d.kind == Kind::load_multiple || d.kind == Kind::store_multiple) && figures_.issue_registers_per_cycle > 0) {
        std::int64_t cycles =
            (d.registers + figures_.issue_registers_per_cycle - 1) / figures_.issue_registers_per_cycle;
        if (d.kind == Kind::store_multiple && d.registers % 2 == 0 && event.accesses > 0 && event.off_eight) {
            cycles += figures_.issue_unaligned_multiple_extra;
        }
        hold_next(Effect::single_issue, 2 * (cycle + static_cast<std::int32_t>(std::max<std::int64_t>(1, cycles))));
    }
    if (d.kind == Kind::divide) {
        hold_next(Effect::result_latency, 2 * (cycle + static_cast<std::int32_t>(figures_.result_divide)));
    }
}

void Pipeline::access_memory(const Decoded& d, const Event& event) {
    if (event.accesses == 0) {
        return;
    }
    const std::int32_t cycle = now();
    if (d.is_store()) {
        const std::int64_t a_cycle = std::max<std::int64_t>(1, figures_.issue_registers_per_cycle);
        for (unsigned n = 0; n < event.accesses; ++n) {
            const std::int32_t at = cycle + static_cast<std::int32_t>(n / a_cycle);
            const unsigned bank = (event.odd_word ? 1U : 0U) ^ (n & 1U);
            // What is lost here shows as a full store buffer.
            const std::int32_t extra = is_off(event.store_effect) ? 0 : event.store_delays[n];
            state.store_buffer.add(figures_, at, bank, event.unaligned, event.access_bytes, extra);
            std::copy_backward(state.stored.begin(), state.stored.end() - 1, state.stored.end());
            state.stored[0] = at;
            if (d.is_fp && event.in_dtcm) {
                state.late_fp_store[bank] = at;
            }
        }
        return;
    }
    std::int32_t delayed = 0;
    if (event.load_delay > 0 && !is_off(event.load_effect)) {
        delayed += static_cast<std::int32_t>(event.load_delay);
        hold_next(event.load_effect, 2 * (cycle + 1 + delayed));
    }
    if (event.unaligned && !is_off(Effect::unaligned_access)) {
        delayed += static_cast<std::int32_t>(state.position % 2 == 0 ? figures_.unaligned_load_in_older_slot
                                                                     : figures_.unaligned_load_in_younger_slot);
        hold_next(Effect::unaligned_access, 2 * (cycle + 1 + delayed));
    }
    result_delay_ = delayed;
}

void Pipeline::follow_branch(const Decoded& d, const Event& event) {
    const std::int32_t cycle = now();
    switch (event.prediction) {
        case Prediction::right:
            break;
        case Prediction::right_without_entry:
            hold_next(Effect::branch_mispredict,
                      2 * (cycle + 1 + static_cast<std::int32_t>(figures_.branch_taken_without_entry)));
            break;
        case Prediction::wrong: {
            const State::Value& flags = state.values[registers::flags];
            const bool conditional = d.branch == Branch::conditional && d.condition != 0xE;
            const bool known = conditional && cycle - flags.cycle >= figures_.branch_flags_known_after;
            // What a right guess would have let issue in the branch's own cycle issues so much later.
            const auto cycles =
                static_cast<std::int32_t>(known ? figures_.branch_mispredict_flags_known : figures_.branch_mispredict);
            hold_next(Effect::branch_mispredict, 2 * (cycle + cycles));
            if (!is_off(Effect::branch_mispredict)) {
                state.fetch_ready = std::max(state.fetch_ready, cycle + cycles - 1);
            }
            break;
        }
    }
}

void Pipeline::note_fpu(const Decoded& d) {
    if (!d.is_fp) {
        return;
    }
    const std::int32_t cycle = now();
    if (d.kind == Kind::fp_mac && !d.is_double) {
        state.mac_before = state.last_mac;
        state.last_mac = cycle;
        if (!d.fused) {
            state.last_mla = cycle;
        }
        for (const auto& [reg, role] : d.all_reads()) {
            if (role == Role::multiplicand) {
                state.multiplicand_of_mac[reg - registers::s0] = cycle;
            }
        }
    }
    const std::int32_t last_of_them = cycle + std::max(0, (d.registers - 1) / 2);
    if (d.is_load()) {
        state.last_fp_load = last_of_them;
    }
    if (d.is_store()) {
        state.last_fp_store = last_of_them;
    }
    if (d.kind == Kind::fp_move) {
        state.last_move = cycle;
    }
    const bool divides = d.kind == Kind::fp_divide || d.kind == Kind::fp_sqrt;
    if (divides) {
        const std::int64_t cycles = d.kind == Kind::fp_divide
                                        ? (d.is_double ? figures_.fp64_divide : figures_.fp_divide)
                                        : (d.is_double ? figures_.fp64_sqrt : figures_.fp_sqrt);
        state.fp_blocks_from = cycle;
        state.fp_blocks_until = cycle + static_cast<std::int32_t>(cycles);
    }
    if (d.is_double && d.is_fp_arithmetic() && !divides) {
        std::int64_t cycles = figures_.fp64_add;
        if (d.kind == Kind::fp_mul) {
            cycles = figures_.fp64_mul;
        } else if (d.kind == Kind::fp_mac) {
            cycles = state.mac64_before ? (d.fused ? figures_.fp64_fma_chained : figures_.fp64_mla_chained)
                                        : (d.fused ? figures_.fp64_fma : figures_.fp64_mla);
        }
        state.fp_busy_until = cycle + static_cast<std::int32_t>(cycles);
    }
    if (d.is_fp_arithmetic()) {
        state.mac64_before = d.is_double && d.kind == Kind::fp_mac;
        if (figures_.mechanisms.serial_fpu && d.write_count > 0) {
            const Producer result = state.values[d.writes[0].reg].producer;
            const std::int64_t ready = result == Producer::nothing ? 0 : latencies_.between(result, Consumer::operand);
            state.fp_busy_until = std::max(state.fp_busy_until, cycle + static_cast<std::int32_t>(ready));
        }
    }
}

std::int32_t Pipeline::settle() {
    const std::int32_t back = state.position / 2;
    // Of what ends: what has ended may as well never have been.
    const auto ends = [back](std::int32_t& cycle) { cycle = std::max(cycle - back, 0); };
    // Of what was: it counts for so many cycles.
    const auto fades = [back](std::int32_t& cycle, std::int64_t counts) {
        cycle = cycle - back + counts < 0 ? never : cycle - back;
    };
    state.position -= 2 * back;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < state.next_hold_count; ++i) {
        const State::Hold later{state.next_holds[i].until - 2 * back, state.next_holds[i].effect};
        if (later.until > state.position + 1) {
            state.next_holds[kept++] = later;
        }
    }
    std::fill(state.next_holds.begin() + static_cast<std::ptrdiff_t>(kept), state.next_holds.end(), State::Hold{});
    state.next_hold_count = kept;
    if (state.older == nullptr) {
        state.older_taken = state.older_accesses = state.older_odd_word = state.older_has_banks = false;
    }
    for (std::int32_t* event : {&state.last_mac, &state.mac_before, &state.last_mla, &state.last_fp_load,
                                &state.last_fp_store, &state.last_move}) {
        fades(*event, fp_memory_);
    }
    ends(state.fp_busy_until);
    ends(state.fp_blocks_until);
    state.fp_blocks_from = state.fp_blocks_until == 0 ? 0 : state.fp_blocks_from - back;

    state.fetch_ready = std::max(state.fetch_ready - back, -fetch_memory_);
    for (std::size_t n = 0; n < state.fetch_used.size(); ++n) {
        state.fetch_used[n] = n < fetch_queue_ ? std::max(state.fetch_used[n] - back, -fetch_memory_) : never;
    }

    for (std::int32_t& cycle : state.stored) {
        fades(cycle, figures_.store_to_load);
    }
    for (std::int32_t& cycle : state.late_fp_store) {
        fades(cycle, figures_.store_late_fp_window);
    }
    state.store_buffer.settle(figures_, back);

    for (std::int32_t& cycle : state.multiplicand_of_mac) {
        fades(cycle, figures_.fp_overwrite_bar_after_mac);
    }
    for (State::Value& value : state.values) {
        if (value.producer == Producer::nothing) {
            continue;
        }
        // Beside its latency a MAC's result is asked for its chain, and the flags for how long they are known.
        const bool remembered = value.producer == Producer::fma || value.producer == Producer::mla ||
                                &value == &state.values[registers::flags];
        fades(value.cycle, std::max<std::int64_t>(latencies_.longest(value.producer), remembered ? fp_memory_ : 0));
        if (value.cycle == never) {
            value.producer = Producer::nothing;
        }
    }
    return back;
}

}  // namespace timing
