// What the M7's model remembers: how it begins, and the number by which `replay` tells one state from another.
#include "qemu/timing/model.hpp"

namespace timing {

std::uint64_t hash_of(const State& state) {
    std::uint64_t hash = mix(0, static_cast<std::uint64_t>(state.position));
    hash = mix(hash, state.next_hold_count);
    for (const State::Value& value : state.values) {
        if (value.producer != Producer::nothing) {
            hash = mix(hash, static_cast<std::uint64_t>(&value - state.values.data()) << 40 ^
                                 static_cast<std::uint64_t>(value.producer) << 32 ^
                                 static_cast<std::uint32_t>(value.cycle));
        }
    }
    for (const std::int32_t cycle :
         {state.last_mac, state.last_fp_load, state.last_fp_store, state.fetch_ready, state.fetch_used[0],
          state.fetch_used[1], state.stored[0], state.store_buffer.done[0], state.store_buffer.done[3]}) {
        hash = mix(hash, static_cast<std::uint64_t>(cycle));
    }
    return hash;
}

State::State() {
    stored.fill(never);
    multiplicand_of_mac.fill(never);
}

}  // namespace timing
