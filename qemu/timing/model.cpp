#include "qemu/timing/model.hpp"

#include <algorithm>

#include "qemu/timing/pairing.hpp"

namespace timing {
namespace {

bool is_aligned(const qemu::Access& access) { return access.address % std::min<unsigned>(access.bytes, 4) == 0; }
unsigned bank_of(std::uint32_t address) { return address >> 2 & 1U; }

}  // namespace

Prepared::Prepared(const Decoded& d) : decoded(d) {
    for (std::size_t i = 0; i < d.read_count; ++i) {
        consumers[i] = consumer_of(d, d.reads[i].role);
    }
}

Model::Model(const Figures& figures, Placement placement, Effects off)
    : figures_(figures),
      off_(off),
      latencies_(figures_),
      memory_(figures_, placement),
      predictor_(figures_.branch_target_entries),
      store_buffer_(figures_) {
    multiplicand_of_mac_.fill(-1000);
}

// The only place where time passes for nothing, and where an effect that is off passes none.
void Model::hold(Effect effect, std::int64_t until) {
    if (until > position_ && !off_[index(effect)]) {
        losses_[index(effect)] += until - position_;
        position_ = until;
    }
}

void Model::hold_next(Effect effect, std::int64_t until) {
    if (next_hold_count_ < next_holds_.size()) {
        next_holds_[next_hold_count_++] = {until, effect};
    }
}

// The order of attribution: what the instruction before left behind (a wrong guess, a miss, an instruction that issues
// for several cycles), then the bytes of this one, its operands, the FPU, the store buffer, last the slot.
std::int64_t Model::execute(const Prepared& instruction, std::uint32_t address, std::span<const qemu::Access> accesses,
                            std::uint32_t next) {
    const Decoded& d = instruction.decoded;
    ++position_;
    for (std::size_t i = 0; i < next_hold_count_; ++i) {
        hold(next_holds_[i].effect, next_holds_[i].until);
    }
    next_hold_count_ = 0;
    wait_for_bytes(d, address);
    wait_for_operands(instruction);
    wait_for_fpu(d);
    wait_for_stores(d, accesses);
    wait_for_a_slot(d, accesses);
    wait_for_division();

    result_delay_ = 0;
    access_memory(d, accesses);
    write_results(instruction);
    occupy(d, accesses);
    note_fpu(d);
    if (d.branch != Branch::none) {
        follow_branch(d, address, next);
    }
    older_ = position_ % 2 == 0 ? &d : nullptr;
    older_taken_ = d.branch != Branch::none && next != address + d.bytes;
    older_has_access_ = !accesses.empty();
    if (older_has_access_) {
        older_access_ = accesses.front();
    }
    return position_;
}

// One word of `fetch.bytes` arrives a cycle, at most `fetch.queue` of them ahead of their use. A branch to any place
// takes up a new word, at once if it was foreseen.
void Model::wait_for_bytes(const Decoded& d, std::uint32_t address) {
    const auto bytes = static_cast<std::uint32_t>(figures_.fetch_bytes);
    for (std::uint32_t word = address / bytes; word <= (address + d.bytes - 1) / bytes; ++word) {
        if (word == fetched_) {
            continue;
        }
        const auto depth = static_cast<std::size_t>(std::min<std::int64_t>(figures_.fetch_queue, 8));
        const std::int64_t room = fetch_count_ >= depth ? fetch_used_[(fetch_count_ - depth) % 8] : 0;
        const Delay delay = memory_.fetch(word * bytes);
        const std::int64_t on_time = std::max(fetch_ready_ + 1, room);
        fetched_ = word;
        hold_cycle(Effect::fetch_alignment, on_time);
        fetch_ready_ = on_time;
        if (delay.cycles > 0) {
            fetch_ready_ = on_time + delay.cycles;
            hold_cycle(delay.effect, fetch_ready_);
        }
        fetch_used_[fetch_count_ % 8] = position_ / 2;
        ++fetch_count_;
    }
}

void Model::wait_for_operands(const Prepared& instruction) {
    const Decoded& d = instruction.decoded;
    if (d.branch != Branch::none && d.registers == 0) {
        return;  // foreseen; a wrong guess is paid afterwards
    }
    for (std::size_t i = 0; i < d.read_count; ++i) {
        const Value& value = values_[d.reads[i].reg];
        if (value.producer != Producer::nothing) {
            hold_cycle(effect_of(value.producer),
                       value.cycle + latencies_.between(value.producer, instruction.consumers[i]));
        }
    }
}

// VDIV and VSQRT let one more instruction issue, with them.
void Model::wait_for_division() {
    if (position_ / 2 > fp_blocks_from_) {
        hold_cycle(Effect::fpu_latency, fp_blocks_until_);
    }
}

void Model::wait_for_fpu(const Decoded& d) {
    if (!d.is_fp) {
        return;
    }
    const auto after = [&](std::int64_t event, std::int64_t barred) {
        hold_cycle(Effect::fpu_latency, event + barred + 1);
    };
    const bool loads = d.is_load();
    const bool multiple = d.kind == Kind::load_multiple || d.kind == Kind::store_multiple;
    if (d.kind == Kind::fp_add || d.kind == Kind::fp_move_immediate || multiple) {
        after(last_mac_, figures_.fp_bar_after_mac);
    }
    if (loads) {
        after(last_mac_, figures_.fp_load_bar_after_mac);
        for (std::size_t i = 0; i < d.write_count; ++i) {
            const unsigned reg = d.writes[i].reg;
            if (figures_.fp_overwrite_bar_after_mac > 0 && reg >= registers::s0 && reg < registers::flags) {
                hold_cycle(Effect::fpu_latency,
                           multiplicand_of_mac_[reg - registers::s0] + figures_.fp_overwrite_bar_after_mac);
            }
        }
    }
    if (d.kind == Kind::fp_mac) {
        after(last_fp_load_, figures_.fp_mac_bar_after_load);
        if (d.fused) {
            after(last_mla_, figures_.fp_fma_bar_after_mla);
        }
    }
    if (d.kind == Kind::fp_move) {
        hold_cycle(Effect::fpu_latency, last_move_ + figures_.fp_move_spacing);
    }
    if (d.is_fp_arithmetic()) {
        hold_cycle(Effect::fpu_latency, fp_busy_until_);
    }
    // The younger slot is closed behind MACs, and the older one of a MAC's own cycle is not this one's.
    const bool transfers = d.kind == Kind::load || d.kind == Kind::store || d.kind == Kind::fp_move ||
                           d.kind == Kind::fp_from_core || d.kind == Kind::fp_to_core;
    if (transfers && position_ % 2 == 1 && position_ / 2 > last_mac_ &&
        position_ / 2 <= last_mac_ + figures_.fp_younger_bar_after_mac) {
        hold(Effect::fpu_latency, position_ + 1);
    }
}

void Model::wait_for_stores(const Decoded& d, std::span<const qemu::Access> accesses) {
    if (accesses.empty()) {
        return;
    }
    if (d.is_store()) {
        hold_cycle(Effect::store_buffer, store_buffer_.free_from());
        return;
    }
    for (const Stored& stored : stored_) {
        if (stored.word == accesses.front().address >> 2) {
            hold_cycle(Effect::store_buffer, stored.cycle + figures_.store_to_load);
        }
    }
    if (memory_.in_dtcm(accesses.front().address)) {
        std::int64_t& late = late_fp_store_[bank_of(accesses.front().address)];
        const std::int64_t since = position_ / 2 - late;
        if (since > 0 && since <= figures_.store_late_fp_window) {
            late = -1000;
            hold_cycle(Effect::load_bank_conflict, position_ / 2 + figures_.store_late_fp_cost);
        }
    }
}

bool Model::banks_conflict(std::span<const qemu::Access> accesses) const {
    if (accesses.empty() || !older_has_access_) {
        return false;  // one of them was not carried out
    }
    const std::uint32_t address = accesses.front().address;
    return !memory_.has_banks(address) || !memory_.has_banks(older_access_.address) ||
           bank_of(address) == bank_of(older_access_.address);
}

void Model::wait_for_a_slot(const Decoded& d, std::span<const qemu::Access> accesses) {
    if (position_ % 2 == 0) {
        return;
    }
    if (older_ == nullptr || !may_pair(*older_, d, older_taken_, figures_)) {
        hold(Effect::single_issue, position_ + 1);
        return;
    }
    const bool mac_and_transfer = (older_->kind == Kind::fp_mac && d.is_fp && !d.is_fp_arithmetic()) ||
                                  (d.kind == Kind::fp_mac && older_->is_fp && !older_->is_fp_arithmetic());
    if (mac_and_transfer && figures_.fp_mac_pairs_with_fp_transfer == 0) {
        const std::int64_t before = older_->kind == Kind::fp_mac ? mac_before_ : last_mac_;
        const bool first = before + figures_.fp_bar_after_mac < position_ / 2;
        if (!first || figures_.fp_first_mac_pairs_with_fp_transfer == 0) {
            hold(Effect::single_issue, position_ + 1);
            return;
        }
    }
    if (d.kind == Kind::load && older_->kind == Kind::load && banks_conflict(accesses)) {
        hold(Effect::load_bank_conflict, position_ + 1);
    }
}

Producer Model::producer_of(const Prepared& instruction) const {
    const Decoded& d = instruction.decoded;
    switch (d.kind) {
        case Kind::add:
        case Kind::shift: {
            for (std::size_t i = 0; i < d.read_count; ++i) {
                const Value& value = values_[d.reads[i].reg];
                if (d.reads[i].role == Role::condition ||
                    (value.producer != Producer::nothing &&
                     position_ / 2 < value.cycle + latencies_.between(value.producer, Consumer::shifted))) {
                    return Producer::late;
                }
            }
            const bool younger_addition = d.kind == Kind::add && position_ % 2 == 1;
            return younger_addition && figures_.result_add_in_younger_slot_early == 0 ? Producer::younger_add
                                                                                      : Producer::early;
        }
        case Kind::bitfield:
            return d.early_result ? Producer::reversed : d.saturates ? Producer::saturated : Producer::bitfield;
        case Kind::multiply: return Producer::multiply;
        case Kind::divide: return Producer::divide;
        case Kind::fp_add: return d.is_double ? Producer::add64 : Producer::fp_add;
        case Kind::fp_mul: return d.is_double ? Producer::mul64 : Producer::fp_mul;
        case Kind::fp_mac: return d.is_double ? Producer::mac64 : d.fused ? Producer::fma : Producer::mla;
        case Kind::fp_divide:
        case Kind::fp_sqrt:
        case Kind::fp_convert: return Producer::fp_convert;
        case Kind::fp_move: return Producer::fp_move;
        case Kind::fp_from_core: return Producer::core_to_fp;
        case Kind::fp_to_core: return Producer::to_core;
        case Kind::fp_move_immediate: return Producer::fp_immediate;
        default: return Producer::late;
    }
}

void Model::write_results(const Prepared& instruction) {
    const Decoded& d = instruction.decoded;
    const std::int64_t cycle = position_ / 2;
    const Producer result = producer_of(instruction);
    const Producer loaded = d.is_fp                  ? Producer::fp_load
                            : d.access_bytes == 4 ? Producer::load_word
                                                  : Producer::load_narrow;
    std::int64_t nth = 0;
    for (std::size_t i = 0; i < d.write_count; ++i) {
        Value& value = values_[d.writes[i].reg];
        switch (d.writes[i].source) {
            case Source::result:
                value = {cycle, result};
                if (d.kind == Kind::divide) {
                    value.cycle += figures_.result_divide - 1;
                } else if (d.kind == Kind::fp_divide || d.kind == Kind::fp_sqrt) {
                    value = {};  // everything waits for its end
                }
                break;
            case Source::loaded:
                value = {cycle + nth / std::max<std::int64_t>(1, figures_.issue_registers_per_cycle) + result_delay_,
                         loaded};
                ++nth;
                break;
            case Source::base: value = {cycle, Producer::base}; break;
            case Source::flags:
                value = {cycle, d.kind == Kind::fp_add ? Producer::compare : Producer::flags};
                break;
        }
    }
}

// Cycles that an instruction issues for.
void Model::occupy(const Decoded& d, std::span<const qemu::Access> accesses) {
    const std::int64_t cycle = position_ / 2;
    if ((d.kind == Kind::load_multiple || d.kind == Kind::store_multiple) && figures_.issue_registers_per_cycle > 0) {
        std::int64_t cycles = (d.registers + figures_.issue_registers_per_cycle - 1) / figures_.issue_registers_per_cycle;
        if (d.kind == Kind::store_multiple && d.registers % 2 == 0 && !accesses.empty() &&
            accesses.front().address % 8 != 0) {
            cycles += figures_.issue_unaligned_multiple_extra;
        }
        hold_next(Effect::single_issue, 2 * (cycle + std::max<std::int64_t>(1, cycles)));
    }
    if (d.kind == Kind::divide) {
        hold_next(Effect::result_latency, 2 * (cycle + figures_.result_divide));
    }
}

void Model::access_memory(const Decoded& d, std::span<const qemu::Access> accesses) {
    const std::int64_t cycle = position_ / 2;
    const bool stores = d.is_store();
    std::int64_t nth = 0;
    std::int64_t delayed = 0;
    bool unaligned = false;
    for (const qemu::Access& access : accesses) {
        if (stores) {
            const std::int64_t at = cycle + nth / std::max<std::int64_t>(1, figures_.issue_registers_per_cycle);
            // What is lost here shows as a full store buffer.
            const Delay delay = memory_.store(access.address);
            store_buffer_.add(at, access.address, access.bytes, off_[index(delay.effect)] ? 0 : delay.cycles);
            stored_[stored_count_++ % stored_.size()] = {access.address >> 2, at};
            if (d.is_fp && memory_.in_dtcm(access.address)) {
                late_fp_store_[bank_of(access.address)] = at;
            }
        } else {
            const Delay delay = memory_.load(access.address);
            if (delay.cycles > 0 && !off_[index(delay.effect)]) {
                delayed += delay.cycles;
                hold_next(delay.effect, 2 * (cycle + 1 + delayed));
            }
            unaligned = unaligned || !is_aligned(access);
        }
        ++nth;
    }
    if (unaligned) {
        const std::int64_t whole = position_ % 2 == 0 ? figures_.unaligned_load_in_older_slot
                                                      : figures_.unaligned_load_in_younger_slot;
        if (!off_[index(Effect::unaligned_access)]) {
            delayed += whole;
            hold_next(Effect::unaligned_access, 2 * (cycle + 1 + delayed));
        }
    }
    result_delay_ = delayed;
}

void Model::follow_branch(const Decoded& d, std::uint32_t address, std::uint32_t next) {
    const std::int64_t cycle = position_ / 2;
    if (next != address + d.bytes) {
        fetched_ = 0xFFFFFFFFU;
    }
    switch (predictor_.meet(d, address, next)) {
        case Prediction::right: break;
        case Prediction::right_without_entry:
            hold_next(Effect::branch_mispredict, 2 * (cycle + 1 + figures_.branch_taken_without_entry));
            break;
        case Prediction::wrong: {
            const Value& flags = values_[registers::flags];
            const bool conditional = d.branch == Branch::conditional;
            const bool known = conditional && d.condition != 0xE &&
                               cycle - flags.cycle >= figures_.branch_flags_known_after;
            const std::int64_t cycles = known ? figures_.branch_mispredict_flags_known : figures_.branch_mispredict;
            hold_next(Effect::branch_mispredict, 2 * (cycle + 1 + cycles));
            if (!off_[index(Effect::branch_mispredict)]) {
                fetch_ready_ = std::max(fetch_ready_, cycle + cycles);
            }
            break;
        }
    }
}

void Model::note_fpu(const Decoded& d) {
    if (!d.is_fp) {
        return;
    }
    const std::int64_t cycle = position_ / 2;
    if (d.kind == Kind::fp_mac && !d.is_double) {
        mac_before_ = last_mac_;
        last_mac_ = cycle;
        if (!d.fused) {
            last_mla_ = cycle;
        }
        for (std::size_t i = 0; i < d.read_count; ++i) {
            if (d.reads[i].role == Role::multiplicand) {
                multiplicand_of_mac_[d.reads[i].reg - registers::s0] = cycle;
            }
        }
    }
    if (d.is_load()) {
        last_fp_load_ = cycle + std::max(0, (d.registers - 1) / 2);
    }
    if (d.kind == Kind::fp_move) {
        last_move_ = cycle;
    }
    const bool divides = d.kind == Kind::fp_divide || d.kind == Kind::fp_sqrt;
    if (divides) {
        const std::int64_t cycles = d.kind == Kind::fp_divide ? (d.is_double ? figures_.fp64_divide : figures_.fp_divide)
                                                              : (d.is_double ? figures_.fp64_sqrt : figures_.fp_sqrt);
        fp_blocks_from_ = cycle;
        fp_blocks_until_ = cycle + cycles;
    }
    if (d.is_double && d.is_fp_arithmetic() && !divides) {
        std::int64_t cycles = figures_.fp64_add;
        if (d.kind == Kind::fp_mul) {
            cycles = figures_.fp64_mul;
        } else if (d.kind == Kind::fp_mac) {
            cycles = mac64_before_ ? (d.fused ? figures_.fp64_fma_chained : figures_.fp64_mla_chained)
                                   : (d.fused ? figures_.fp64_fma : figures_.fp64_mla);
        }
        fp_busy_until_ = cycle + cycles;
    }
    if (d.is_fp_arithmetic()) {
        mac64_before_ = d.is_double && d.kind == Kind::fp_mac;
    }
}

}  // namespace timing
