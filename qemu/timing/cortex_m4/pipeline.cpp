#include "qemu/timing/cortex_m4/pipeline.hpp"

#include <algorithm>
#include <string_view>

#include "qemu/timing/pipelines.hpp"

namespace timing::cortex_m4 {
namespace {

using Access = State::Access;

bool is_no_operation(const Decoded& d) { return d.kind == Kind::hint && std::string_view(d.mnemonic) == "nop"; }
bool is_single_load(const Decoded& d) { return d.kind == Kind::load && d.branch == Branch::none; }
bool is_single_store(const Decoded& d) { return d.kind == Kind::store; }
bool adds_index(const Decoded& d) {
    return std::ranges::any_of(d.all_reads(), [](const Read& read) { return read.role == Role::index; });
}
// VABS and VNEG turn one bit over: their results are no later than a move's.
bool computes(const Decoded& d) {
    const std::string_view name = d.mnemonic;
    return d.is_fp_arithmetic() && name != "vabs" && name != "vneg";
}

}  // namespace

std::uint64_t hash_of(const State& state) {
    std::uint64_t hash = mix(0, static_cast<std::uint64_t>(state.position));
    for (const State::Hold& one : state.holds) {
        hash = mix(hash, static_cast<std::uint64_t>(one.until));
    }
    hash = mix(hash, static_cast<std::uint64_t>(state.last_access) << 32 ^ static_cast<std::uint32_t>(state.fpu_free));
    for (const State::Value& value : state.values) {
        hash = mix(hash, static_cast<std::uint64_t>(value.address_from));
    }
    for (const std::int32_t from : state.fp_from) {
        hash = mix(hash, static_cast<std::uint64_t>(from));
    }
    hash = mix(hash, static_cast<std::uint64_t>(state.fetched));
    return mix(hash, static_cast<std::uint64_t>(state.freed[0]));
}

Pipeline::Pipeline(const Figures& figures, std::int64_t longest_fetch, Effects off)
    : PipelineBase(figures, off),
      words_(static_cast<std::size_t>(std::clamp<std::int64_t>(figures.fetch_queue, 1, State::most_words))),
      fetch_memory_(
          static_cast<std::int32_t>(8 + figures.prefetch_latency + figures.prefetch_restart + longest_fetch)) {
    state.freed.fill(-fetch_memory_);
}

// The order of attribution: that an instruction has a cycle of its own, what the one before left behind, then its
// bytes, its operands, the FPU.
void Pipeline::execute(const Prepared& instruction, const Event& event) {
    const Decoded& d = instruction.decoded;
    const bool folds = d.kind == Kind::if_then && state.narrow_before && figures_.takes_if_then_folds != 0;
    ++state.position;
    if (folds) {  // in the cycle of the instruction before; what that left behind waits on
        state.narrow_before = false;
        wait_for_bytes(d, event);
        return;
    }
    hold_cycle(Effect::single_issue, (state.position + 1) / 2);
    wait_for_the_one_before(d, event);
    wait_for_bytes(d, event);
    wait_for_operands(d);
    if (d.is_fp) {
        hold_cycle(Effect::fpu_latency, state.fpu_free);
    }
    leave_behind(d, event);
}

void Pipeline::wait_for_the_one_before(const Decoded& d, const Event& event) {
    for (State::Hold& one : state.holds) {
        hold_cycle(one.effect, one.until);
        one = {};
    }
    const bool loads = d.is_load() && event.accesses > 0;
    const bool single = (is_single_load(d) || is_single_store(d)) && event.accesses > 0;
    switch (state.last_access) {
        case Access::none:
            break;
        case Access::load: {
            const bool same_block = state.last_in_data == (event.in_dtcm != 0);
            const bool pipelines = single && same_block && figures_.access_load_pipelines != 0;
            const bool hides = is_no_operation(d) && figures_.access_load_hides_nop != 0;
            if (!pipelines && !hides) {
                hold_cycle(Effect::load_use, state.access_ends);
            }
            break;
        }
        case Access::indexed_store:
            if (!is_no_operation(d)) {
                hold_cycle(Effect::store_buffer, state.access_ends);
            }
            [[fallthrough]];
        case Access::store:
            if (loads) {
                hold_cycle(Effect::store_buffer, state.access_ends + figures_.access_load_behind_store);
            }
            break;
    }
    if (event.accesses > 0) {
        hold_cycle(state.store_effect, state.store_done);
    }
}

// A word is asked for as soon as the buffer has a place for it, so that those in use and on their way fill it; where
// fetching had to stop, it starts again later.
void Pipeline::wait_for_bytes(const Decoded& d, const Event& event) {
    const std::size_t words = std::min<std::size_t>(event.words, event.fetch_delays.size());
    const bool ends_word = event.second_half || d.bytes == 4;
    // Of an instruction across two words the first is not used up before it issues.
    const bool across = event.second_half && d.bytes == 4;
    for (std::size_t n = 0; n < words; ++n) {
        const std::size_t before = words_ - 1 - (across && words_ > 1 ? 1 : 0);
        const std::int32_t place = state.freed[before];
        const bool stopped = place >= state.fetched;
        const std::int64_t asked = place + figures_.prefetch_latency + (stopped ? figures_.prefetch_restart : 0);
        const std::int64_t on_time = std::max<std::int64_t>(state.fetched + 1, asked);
        hold_cycle(Effect::fetch_alignment, on_time);
        state.fetched = static_cast<std::int32_t>(on_time);
        if (event.fetch_delays[n] > 0) {
            hold_cycle(event.fetch_effect, on_time + event.fetch_delays[n]);
            state.fetched += is_off(event.fetch_effect) ? 0 : event.fetch_delays[n];
        }
    }
    if (ends_word) {
        std::copy_backward(state.freed.begin(), state.freed.end() - 1, state.freed.end());
        state.freed[0] = now();
    }
}

void Pipeline::wait_for_operands(const Decoded& d) {
    for (const auto& [reg, role] : d.all_reads()) {
        if (reg < registers::pc && (role == Role::address || role == Role::index) && d.registers > 0) {
            const State::Value& value = state.values[reg];
            hold_cycle(value.loaded ? Effect::load_use : Effect::result_latency, value.address_from);
        } else if (reg >= registers::s0 && reg < registers::flags) {
            const std::size_t single = reg - registers::s0;
            const bool addend = role == Role::accumulator && (state.fp_computed >> single & 1U) != 0;
            hold_cycle(Effect::fpu_latency,
                       state.fp_from[single] - (addend ? figures_.use_fp_next - figures_.use_fp_next_addend : 0));
        }
    }
}

// Cycles until the next instruction may issue, whichever it is.
std::int64_t Pipeline::cycles_of(const Decoded& d, const Event& event) const {
    const auto& f = figures_;
    const std::string_view name = d.mnemonic;
    switch (d.kind) {
        case Kind::multiply:
            return name == "mla" || name == "mls" ? f.takes_multiply_accumulate : 1;
        case Kind::divide:
            return f.takes_divide;
        case Kind::system:
            return f.takes_system;
        case Kind::load_multiple:
        case Kind::store_multiple:
            return event.accesses > 0 ? f.takes_multiple_first + d.registers : 1;
        case Kind::load:
        case Kind::branch:  // TBB, and LDR into PC
            return d.branch != Branch::none && d.registers > 0 && event.accesses > 0 ? 1 + f.access_load_wait : 1;
        case Kind::store:
            return event.accesses > 0 && d.is_fp ? 1 + f.takes_fp_store_extra : 1;
        case Kind::fp_mac:
            return f.takes_fp_mac_of_core;
        case Kind::fp_from_core:
        case Kind::fp_to_core:
            return name != "vmov" ? 1 : d.both_fp_ports ? f.takes_fp_two_transfers : f.takes_fp_transfer;
        default:
            return 1;
    }
}

void Pipeline::leave_behind(const Decoded& d, const Event& event) {
    const std::int32_t at = now();
    const std::int64_t takes = std::max<std::int64_t>(1, cycles_of(d, event));
    const Effect why = d.kind == Kind::divide     ? Effect::result_latency
                       : d.is_fp_arithmetic()     ? Effect::fpu_latency
                       : is_single_store(d)       ? Effect::store_buffer
                       : d.kind == Kind::multiply ? Effect::mac_latency
                                                  : Effect::single_issue;
    state.narrow_before = d.bytes == 2;
    if (takes > 1) {
        state.holds[0] = {static_cast<std::int32_t>(at + takes), why};
    }
    access_memory(d, event);
    std::int64_t fpu_takes = takes;
    if (d.kind == Kind::fp_mac) {
        fpu_takes = figures_.takes_fp_mac;
    } else if (d.kind == Kind::fp_divide) {
        fpu_takes = figures_.takes_fp_divide;
    } else if (d.kind == Kind::fp_sqrt) {
        fpu_takes = figures_.takes_fp_sqrt;
    }
    if (d.is_fp_arithmetic()) {
        state.fpu_free = static_cast<std::int32_t>(at + fpu_takes);
    }
    write_results(d, takes, fpu_takes);
    if (event.taken) {
        refill(d, at + takes);
    }
}

void Pipeline::access_memory(const Decoded& d, const Event& event) {
    const std::int32_t at = now();
    state.last_access = Access::none;
    state.access_ends = 0;
    load_delay_ = 0;
    if (event.accesses == 0) {
        return;
    }
    if (d.is_load()) {
        if (event.load_delay > 0 && !is_off(event.load_effect)) {
            load_delay_ += event.load_delay;
            state.holds[1] = {static_cast<std::int32_t>(at + 1 + load_delay_), event.load_effect};
        }
        if (event.unaligned != 0 && !is_off(Effect::unaligned_access)) {
            load_delay_ += figures_.access_unaligned_load;
            state.holds[2] = {static_cast<std::int32_t>(at + 1 + load_delay_), Effect::unaligned_access};
        }
    } else if (event.store_delayed) {
        const std::int64_t delay = *std::max_element(event.store_delays.begin(), event.store_delays.end());
        state.store_done = static_cast<std::int32_t>(at + 1 + delay);
        state.store_effect = event.store_effect;
    }
    if (is_single_load(d)) {
        state.last_access = Access::load;
        state.access_ends = static_cast<std::int32_t>(at + 1 + figures_.access_load_wait + load_delay_);
    } else if (is_single_store(d)) {
        const bool indexed = adds_index(d);
        state.last_access = indexed ? Access::indexed_store : Access::store;
        state.access_ends = static_cast<std::int32_t>(at + 1 + (indexed ? figures_.takes_indexed_store_extra : 0));
    }
    state.last_in_data = state.last_access == Access::load && event.in_dtcm != 0;
}

void Pipeline::write_results(const Decoded& d, std::int64_t takes, std::int64_t fpu_takes) {
    const std::int32_t at = now();
    std::int64_t loaded = 0;
    for (std::size_t i = 0; i < d.write_count; ++i) {
        const auto [reg, source] = d.writes[i];
        const bool is_loaded = source == Source::loaded;
        const std::int64_t ready = is_loaded ? at + 1 + figures_.access_load_wait + load_delay_ + loaded
                                             : at + (source == Source::base ? 1 : takes);
        loaded += is_loaded ? 1 : 0;
        if (reg < registers::pc) {
            const std::int64_t ahead = is_loaded ? figures_.use_loaded_address_ahead : figures_.use_address_ahead;
            state.values[reg] = {static_cast<std::int32_t>(ready + ahead), is_loaded};
        } else if (reg >= registers::s0 && reg < registers::flags) {
            const std::size_t single = reg - registers::s0;
            const bool computed = computes(d);
            state.fp_from[single] = static_cast<std::int32_t>(
                computed ? at + fpu_takes + figures_.use_fp_next : 0);  // all else is there as the next one issues
            state.fp_computed = (state.fp_computed & ~(1U << single)) | std::uint32_t{computed} << single;
        }
    }
}

// What a taken branch costs is called as a wrong guess is: the core foresees none.
void Pipeline::refill(const Decoded& d, std::int64_t taken) {
    const bool by_loaded = d.registers > 0;
    const bool direct = d.branch == Branch::direct || d.branch == Branch::conditional || d.branch == Branch::call;
    const std::int64_t cycles = by_loaded ? figures_.refill_loaded
                                : direct  ? figures_.refill_direct
                                          : figures_.refill_by_register;
    const std::int64_t target = taken + (is_off(Effect::branch_mispredict) ? 0 : cycles);
    auto& last = state.holds[1].until == 0 ? state.holds[1] : state.holds[2];
    last = {static_cast<std::int32_t>(target), Effect::branch_mispredict};
    state.fetched = static_cast<std::int32_t>(target - 1);
    state.freed.fill(state.fetched - fetch_memory_);
}

std::int32_t Pipeline::settle() {
    const std::int32_t back = state.position / 2;
    // What has ended may as well never have been.
    const auto ends = [back](std::int32_t& cycle) { cycle = std::max(cycle - back, 0); };
    state.position -= 2 * back;
    for (State::Hold& one : state.holds) {
        ends(one.until);
        one = one.until == 0 ? State::Hold{} : one;
    }
    ends(state.access_ends);
    ends(state.store_done);
    state.store_effect = state.store_done == 0 ? Effect::store_buffer : state.store_effect;
    for (State::Value& value : state.values) {
        ends(value.address_from);
        value.loaded = value.loaded && value.address_from != 0;
    }
    for (std::size_t single = 0; single < state.fp_from.size(); ++single) {
        ends(state.fp_from[single]);
        if (state.fp_from[single] == 0) {
            state.fp_computed &= ~(1U << single);
        }
    }
    ends(state.fpu_free);
    state.fetched = std::max(state.fetched - back, -fetch_memory_);
    for (std::size_t n = 0; n < state.freed.size(); ++n) {
        state.freed[n] = n < words_ ? std::max(state.freed[n] - back, -fetch_memory_) : -fetch_memory_;
    }
    return back;
}

}  // namespace timing::cortex_m4
