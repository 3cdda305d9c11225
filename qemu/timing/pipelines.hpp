// The pipelines of all rule sets of one core, side by side, and the states that they have been in, by number. Which
// model of a core they are, none of their users knows.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "qemu/timing/block_events.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/effects.hpp"
#include "qemu/timing/prepared.hpp"

namespace timing {

/// For hashes of states and keys, which are compared whole.
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 29;
}

class Pipelines {
public:
    Pipelines() = default;
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;
    virtual ~Pipelines() = default;

    struct Step {
        std::array<std::int32_t, CoreFile::most_sets> moved{};  ///< half cycles, of each set
        Losses losses{};                                        ///< of the nominal set
        std::uint32_t next_state = 0;
    };
    /// One executed instruction, in the state of that number.
    [[nodiscard]] virtual Step execute(std::uint32_t state, const Prepared& instruction, const Event& event) = 0;
    /// States numbered so far, from 0 on.
    [[nodiscard]] virtual std::size_t states() const = 0;
    /// Forgets all states but one, which becomes number 0.
    virtual void keep_only(std::uint32_t state) = 0;
};

/// \tparam Pipeline  has a `State` that can be compared, with a `position` and a function `hash_of`, the member
/// `state`,
///                   `losses`, `execute` and `settle`, as pipelines do (model.hpp)
template <class Pipeline>
class PipelinesOf final : public Pipelines {
public:
    /// \param longest_fetch  see `Pipeline`
    PipelinesOf(const CoreFile& core, std::int64_t longest_fetch) {
        Joint first;
        for (const RuleSet& set : core.sets) {
            pipelines_.push_back(std::make_unique<Pipeline>(set.figures, longest_fetch, core.off));
            first.push_back(pipelines_.back()->state);
        }
        (void)number_of(std::move(first));
    }

    Step execute(std::uint32_t state, const Prepared& instruction, const Event& event) override {
        Step step;
        Joint joint;
        for (std::size_t s = 0; s < pipelines_.size(); ++s) {
            Pipeline& pipeline = *pipelines_[s];
            if (loaded_ != state) {
                pipeline.state = states_[state][s];
            }
            pipeline.losses.fill(0);
            const std::int32_t before = pipeline.state.position;
            pipeline.execute(instruction, event);
            step.moved[s] = pipeline.state.position - before;
            pipeline.settle();
            joint.push_back(pipeline.state);
        }
        step.losses = pipelines_[0]->losses;
        step.next_state = loaded_ = number_of(std::move(joint));
        return step;
    }

    std::size_t states() const override { return states_.size(); }

    void keep_only(std::uint32_t state) override {
        Joint kept = std::move(states_[state]);
        for (std::size_t s = 0; s < pipelines_.size(); ++s) {
            pipelines_[s]->state = kept[s];
        }
        states_.clear();
        numbers_.clear();
        loaded_ = number_of(std::move(kept));
    }

private:
    using Joint = std::vector<typename Pipeline::State>;  // of all sets

    std::uint32_t number_of(Joint joint) {
        std::uint64_t hashed = 0;
        for (const auto& state : joint) {
            hashed = mix(hashed, hash_of(state));
        }
        const auto [first, last] = numbers_.equal_range(hashed);
        for (auto found = first; found != last; ++found) {
            if (states_[found->second] == joint) {
                return found->second;
            }
        }
        const auto number = static_cast<std::uint32_t>(states_.size());
        states_.push_back(std::move(joint));
        numbers_.emplace(hashed, number);
        return number;
    }

    std::vector<std::unique_ptr<Pipeline>> pipelines_;
    std::vector<Joint> states_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> numbers_;  // of states, by hash
    std::uint32_t loaded_ = 0;                                       // the state that the pipelines hold
};

/// The model that the core file names.
[[nodiscard]] std::unique_ptr<Pipelines> pipelines_of(const CoreFile& core);

}  // namespace timing
