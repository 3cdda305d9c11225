#include "glsum/model/controller.hpp"

namespace glsum {

template <class K>
Status Controller<K>::prepare(State& state, const ControllerDesign& design, std::span<Coefficient> table,
                              std::span<Sample> past) {
    if (const Status status = K::prepare(state.sum, design.design(), table, past); status != Status::ok) {
        return status;
    }
    state.first = static_cast<Sample>(design.first);
    state.low = static_cast<Sample>(design.low);
    state.high = static_cast<Sample>(design.high);
    state.output = 0;
    state.lost = 0;
    return Status::ok;
}

template <class K>
auto Controller<K>::step(State& state, Sample error) -> Sample {
    const Sample added = state.first * K::step(state.sum, error) + state.lost;
    const Sample before = state.output;
    const Sample after = before + added;
    if (after > state.high || after < state.low) {
        state.output = after > state.high ? state.high : state.low;
        state.lost = 0;
    } else {
        state.output = after;
        state.lost = added - (after - before);
    }
    return state.output;
}

template class Controller<Sum<Ring, Oldest, F64>>;
template class Controller<Sum<Mirror, Multi, F32>>;
template class Controller<Sum<Modes, Plain, F32>>;
template class Controller<Sum<Modes, Compensated, F32>>;

}  // namespace glsum
