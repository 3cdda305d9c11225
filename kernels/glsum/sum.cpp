// The bodies of all kernels, once, in the library: size, stack and cycles are those of the object code that ships.
#include "glsum/sum.hpp"

#include <limits>

#include "glsum/registry.hpp"

namespace glsum {

Status Null::prepare(State&, const Design& design, std::span<float>, std::span<float>) {
    return design.taps == 0 ? Status::no_taps : order_in_range(design.order) ? Status::ok : Status::order_out_of_range;
}
void Null::reset(State&) {}
float Null::step(State&, float newest) { return newest; }

template <class History, class Technique, class Format>
Status Sum<History, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design.taps)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design.taps)) {
        return Status::past_too_small;
    }
    typename Format::Scale scale;
    if (const Status status = Technique::template choose_scale<Format>(design, scale); status != Status::ok) {
        return status;
    }
    const std::size_t past_samples = design.taps - 1;
    Technique::template fill<Format>(table.data(), past_samples, design.order, scale);
    state = {table.data(), past.data(), static_cast<std::uint32_t>(past_samples), 0, scale};
    reset(state);
    return Status::ok;
}

template <class History, class Technique, class Format>
void Sum<History, Technique, Format>::reset(State& state) {
    const std::size_t count = past_count(state.past_samples + std::size_t{1});
    for (std::size_t i = 0; i < count; ++i) {
        state.past[i] = 0;
    }
    state.head = 0;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

template <class History, class Technique, class Format>
auto Sum<History, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (requires { &Technique::template sum_and_push<Format>; }) {
        static_assert(History::contiguous && History::word == "shift");
        return Format::finish(
            Technique::template sum_and_push<Format>(state.table, state.past, state.past_samples, newest, state.scale),
            state.scale);
    } else {
        const auto window = History::template window<Sample>(state.past, state.past_samples, state.head);
        const auto sum = Technique::template sum<Format>(state.table, window, newest, state.scale);
        History::template push<Sample>(state.past, state.past_samples, state.head, newest);
        return Format::finish(sum, state.scale);
    }
}

#define GLSUM_KERNEL(history, technique, format) template struct Sum<history, technique, format>;
#if defined(GLSUM_SIMD)
#define GLSUM_HOST_KERNEL(history, technique, format) template struct Sum<history, technique, format>;
#else
#define GLSUM_HOST_KERNEL(history, technique, format)
#endif
#include "glsum/registry.def"

}  // namespace glsum
