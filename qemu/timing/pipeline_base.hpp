// What the pipelines of all cores share: where they stand, what they have lost, and the one way in which time passes.
#pragma once

#include <cstdint>

#include "qemu/timing/core_file.hpp"
#include "qemu/timing/effects.hpp"

namespace timing {

/// \tparam StateOfCore  all that the core remembers of the instructions before; its `position` is the half cycle of the
///                      last one's issue
template <class StateOfCore>
class PipelineBase {
public:
    using State = StateOfCore;
    PipelineBase(const PipelineBase&) = delete;
    PipelineBase& operator=(const PipelineBase&) = delete;

    State state;
    Losses losses{};

protected:
    PipelineBase(const Figures& figures, Effects off) : figures_(figures), off_(off) {}
    ~PipelineBase() = default;

    /// The only place where time passes for nothing, and where an effect that is off passes none.
    /// \param until  position
    void hold(Effect effect, std::int32_t until) {
        if (until > state.position && !is_off(effect)) {
            losses[index(effect)] += until - state.position;
            state.position = until;
        }
    }
    void hold_cycle(Effect effect, std::int64_t cycle) { hold(effect, static_cast<std::int32_t>(2 * cycle)); }
    [[nodiscard]] bool is_off(Effect effect) const { return off_[index(effect)]; }
    /// The cycle of the last instruction's issue.
    [[nodiscard]] std::int32_t now() const { return state.position / 2; }

    Figures figures_;

private:
    Effects off_;
};

}  // namespace timing
