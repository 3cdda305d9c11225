#include "qemu/timing/replay.hpp"

#include <algorithm>

namespace timing {
namespace {

// Past these all is forgotten and begun anew: a program that never comes to the same state would fill the memory.
constexpr std::size_t most_states = 8192;
constexpr std::size_t most_steps = std::size_t{1} << 18;

constexpr std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 29;
}

}  // namespace

Replay::Replay(const CoreFile& core) {
    // All sets are given the delays of the nominal one's memory.
    const std::int64_t longest_fetch = Memory(core.sets[0].figures, core.placement).longest_fetch();
    for (const RuleSet& set : core.sets) {
        pipelines_.push_back(std::make_unique<Pipeline>(set.figures, longest_fetch, core.off));
    }
    positions_.fill(-1);
    forget();
}

std::uint64_t Replay::hash(const Key& key) { return mix(mix(mix(0, key.state_and_site), key.event), key.fetch_delays); }

// Of what differs between states; equality compares all of them.
std::uint64_t Replay::hash(const Joint& joint) {
    std::uint64_t hash = 0;
    for (const State& state : joint) {
        hash = mix(hash, static_cast<std::uint64_t>(state.position));
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
    }
    return hash;
}

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
        if (states_.size() >= most_states || steps_.size() >= most_steps) {
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
    Step step;
    Joint joint;
    for (std::size_t s = 0; s < pipelines_.size(); ++s) {
        Pipeline& pipeline = *pipelines_[s];
        if (loaded_ != state_) {
            pipeline.state = states_[state_][s];
        }
        pipeline.losses.fill(0);
        const std::int32_t before = pipeline.state.position;
        pipeline.execute(instruction, event);
        step.moved[s] = pipeline.state.position - before;
        pipeline.settle();
        joint.push_back(pipeline.state);
    }
    for (std::size_t e = 0; e < effect_count; ++e) {
        if (pipelines_[0]->losses[e] != 0) {
            step.effects[step.loss_count] = static_cast<std::uint8_t>(e);
            step.lost[step.loss_count++] = static_cast<std::int32_t>(pipelines_[0]->losses[e]);
        }
    }
    step.next_state = number_of(std::move(joint));
    loaded_ = step.next_state;
    return step;
}

std::uint32_t Replay::number_of(Joint joint) {
    const std::uint64_t hashed = hash(joint);
    const auto [first, last] = numbers_.equal_range(hashed);
    const auto found = std::find_if(first, last, [&](const auto& one) { return states_[one.second] == joint; });
    if (found != last) {
        return found->second;
    }
    const auto number = static_cast<std::uint32_t>(states_.size());
    states_.push_back(std::move(joint));
    numbers_.emplace(hashed, number);
    return number;
}

// All but where the core is now.
void Replay::forget() {
    Joint now;
    for (std::size_t s = 0; s < pipelines_.size(); ++s) {
        now.push_back(states_.empty() ? pipelines_[s]->state : states_[state_][s]);
        pipelines_[s]->state = now.back();
    }
    states_.clear();
    numbers_.clear();
    steps_.assign(1, {});
    places_.assign(1024, 0);
    last_step_ = 0;
    ++epoch_;
    state_ = loaded_ = number_of(std::move(now));
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
