#include "qemu/timing/replay.hpp"

#include <algorithm>

namespace timing {
namespace {

// Past these all is forgotten and begun anew: a program that never comes to the same state would fill the memory.
constexpr std::size_t most_states = 8192;
constexpr std::size_t most_steps = std::size_t{1} << 18;

}  // namespace

Replay::Replay(const CoreFile& core) : pipelines_(pipelines_of(core)) {
    positions_.fill(-1);
    forget();
}

std::uint64_t Replay::hash(const Key& key) { return mix(mix(mix(0, key.state_and_site), key.event), key.fetch_delays); }

void Replay::execute(std::uint32_t site, const Prepared& instruction, const Event& event) {
    if (!packs(event)) {
        take(compute(instruction, event));
        last_step_ = 0;
        return;
    }
    const PackedEvent short_event = packed(event);
    const Key key{std::uint64_t{state_} << 32 | site, short_event.event, short_event.fetch_delays};
    const std::uint32_t expected = steps_[last_step_].followed_by;
    if (expected != 0 && steps_[expected].key == key) {
        last_step_ = expected;
        take(steps_[expected]);
        return;
    }
    std::size_t place = hash(key) & (places_.size() - 1);
    while (places_[place] != 0 && !(steps_[places_[place]].key == key)) {
        place = (place + 1) & (places_.size() - 1);
    }
    std::uint32_t found = places_[place];
    if (found == 0) {
        if (pipelines_->states() >= most_states || steps_.size() >= most_steps) {
            forget();
            return execute(site, instruction, event);
        }
        Step step = compute(instruction, event);
        step.key = key;
        found = static_cast<std::uint32_t>(steps_.size());
        steps_.push_back(step);
        places_[place] = found;
        if (2 * steps_.size() > places_.size()) {
            grow();
        }
    }
    steps_[last_step_].followed_by = last_step_ != 0 ? found : 0;
    last_step_ = found;
    take(steps_[found]);
}

void Replay::take(const Step& step) {
    for (std::size_t s = 0; s < positions_.size(); ++s) {
        positions_[s] += step.moved[s];
    }
    for (std::size_t i = 0; i < step.loss_count; ++i) {
        losses_[step.effects[i]] += step.lost[i];
    }
    state_ = step.next_state;
}

void Replay::jump(std::uint32_t state, const std::array<std::int32_t, CoreFile::most_sets>& moved,
                  std::span<const Loss> lost) {
    for (std::size_t s = 0; s < positions_.size(); ++s) {
        positions_[s] += moved[s];
    }
    for (const Loss& loss : lost) {
        losses_[loss.effect] += loss.half_cycles;
    }
    state_ = state;
    last_step_ = 0;
}

Replay::Step Replay::compute(const Prepared& instruction, const Event& event) {
    ++computed_;
    const Pipelines::Step computed = pipelines_->execute(state_, instruction, event);
    Step step;
    step.moved = computed.moved;
    step.next_state = computed.next_state;
    for (std::size_t e = 0; e < effect_count; ++e) {
        if (computed.losses[e] != 0) {
            step.effects[step.loss_count] = static_cast<std::uint8_t>(e);
            step.lost[step.loss_count++] = static_cast<std::int32_t>(computed.losses[e]);
        }
    }
    return step;
}

// All but where the core is now.
void Replay::forget() {
    pipelines_->keep_only(state_);
    steps_.assign(1, {});
    places_.assign(1024, 0);
    last_step_ = 0;
    ++epoch_;
    state_ = 0;
}

void Replay::grow() {
    places_.assign(2 * places_.size(), 0);
    for (std::uint32_t number = 1; number < steps_.size(); ++number) {
        std::size_t place = hash(steps_[number].key) & (places_.size() - 1);
        while (places_[place] != 0) {
            place = (place + 1) & (places_.size() - 1);
        }
        places_[place] = number;
    }
}

}  // namespace timing
