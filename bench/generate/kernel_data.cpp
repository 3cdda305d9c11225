#include "bench/generate/kernel_data.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <span>
#include <type_traits>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "bench/choose/counted_order.hpp"
#include "bench/generate/header.hpp"
#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

template <class T, class... Ts>
constexpr bool one_of = (std::is_same_v<T, Ts> || ...);

template <class Technique>
constexpr bool is_paired = one_of<Technique, glsum::Smlald, glsum::Smlad, glsum::SmlaldShaped>;

// Whether its texts are found by its word.
template <class Technique>
constexpr bool is_worded = requires {
    Technique::summary;
};

// Whether a history says what an instance of it holds; then it gives a window, or states its sum itself under its word.
template <class History>
constexpr bool says_its_fields = requires {
    History::summary;
    History::fields;
};
template <class History>
constexpr bool states_its_sum = says_its_fields<History> && !requires {
    &History::template window<float>;
};

template <class K>
constexpr bool can_generate = false;
template <class H, class T, class F>
constexpr bool can_generate<glsum::Sum<H, T, F>> =
    (says_its_fields<H> ||
     one_of<H, glsum::Modes, glsum::Integrator, glsum::Nested, glsum::Block, glsum::MirrorDelta, glsum::ModesDelta,
            glsum::MirrorHold,
            glsum::MirrorLinear>)&&(is_worded<T> || is_paired<T> ||
                                    one_of<T, glsum::Multi, glsum::MultiFma, glsum::Horner, glsum::HornerFma,
                                           glsum::HornerSplit, glsum::HornerSplitFma, glsum::Fir, glsum::FirFma,
                                           glsum::Scaled>)&&one_of<F, glsum::F64, glsum::F32, glsum::F32A64, glsum::Q31,
                                                                   glsum::Q15, glsum::Q15C31>;

template <class Technique, class Format>
TechniqueText text_of(const glsum::CatalogueEntry& kernel, const HistoryText& history, std::size_t past,
                      const std::vector<int>& shifts) {
    using namespace glsum;
    constexpr bool f32 = std::is_same_v<Format, F32>;
    constexpr bool in_software = std::is_same_v<typename Format::Accumulator, double>;
    if constexpr (is_worded<Technique>) {
        return worded_text(kernel.unfused, Technique::summary, history, kernel.fused, std::is_same_v<Format, Q15C31>);
    } else if constexpr (one_of<Technique, Multi, MultiFma>) {
        return multi_text(history, past, kernel.fused, in_software,
                          std::is_same_v<Format, Q31> ? "dot_smlal"
                          : f32 && !kernel.fused      ? "dot_floats"
                                                      : "");
    } else if constexpr (one_of<Technique, Horner, HornerFma>) {
        return horner_text(history, kernel.fused, in_software);
    } else if constexpr (one_of<Technique, HornerSplit, HornerSplitFma>) {
        return horner_split_text(history, past, kernel.fused);
    } else if constexpr (one_of<Technique, Fir, FirFma>) {
        return fir_text(kernel.fused, !f32);
    } else if constexpr (std::is_same_v<Technique, Scaled>) {
        return scaled_text(past, shifts);
    } else {
        return paired_text(!std::is_same_v<Technique, Smlad>);
    }
}

template <class History>
HistoryText text_of_history(History history, std::size_t, bool) {
    if constexpr (states_its_sum<History>) {
        return stated_history_text(History::summary, History::fields);
    } else if constexpr (says_its_fields<History>) {
        return window_text(History::word, History::summary, History::fields, History::contiguous);
    } else {
        return history_text(history);
    }
}
HistoryText text_of_history(glsum::Integrator, std::size_t, bool) { return history_text(glsum::Modes{}); }
template <class Kept>
HistoryText text_of_history(glsum::Delta<Kept>, std::size_t, bool fixed) {
    return increments_text(text_of_history(Kept{}, 0, fixed), fixed);
}
template <bool to_first>
HistoryText text_of_history(glsum::Guess<to_first>, std::size_t past, bool) {
    return guess_text(text_of_history(glsum::Mirror{}, past, false), past, to_first);
}

template <class T>
const char* c_type() {
    return std::is_same_v<T, double>         ? "double"
           : std::is_same_v<T, float>        ? "float"
           : std::is_same_v<T, std::int64_t> ? "int64_t"
           : std::is_same_v<T, std::int32_t> ? "int32_t"
                                             : "int16_t";
}

template <class T>
Numbers numbers(std::span<const T> values) {
    Numbers numbers{c_type<T>(), {}, {}};
    for (const T value : values) {
        if constexpr (std::is_floating_point_v<T>) {
            numbers.reals.push_back(static_cast<double>(value));
        } else {
            numbers.integers.push_back(value);
        }
    }
    return numbers;
}

template <class Output>
std::uint64_t bits_of(Output output) {
    if constexpr (sizeof(Output) == 4) {
        return std::bit_cast<std::uint32_t>(output);
    } else {
        return std::bit_cast<std::uint64_t>(output);
    }
}

template <class K>
KernelData describe(double order, std::size_t taps, std::size_t horizon, const glsum::design::FittedFilter* fitted,
                    const std::vector<double>& reals, std::size_t calls) {
    using Technique = typename K::TechniquePart;
    using Format = typename K::FormatPart;
    using Sample = typename K::Sample;
    using Output = typename K::Output;
    const glsum::CatalogueEntry& kernel = *glsum::find_kernel(K::name());
    constexpr bool has_modes = glsum::keeps_modes<typename K::HistoryPart>;
    constexpr bool increments = glsum::keeps_increments<typename K::HistoryPart>;
    const bench::Length length =
        choose::CountedOrder(order, fitted != nullptr).length(std::string(K::name()), taps, horizon);
    glsum::Design design{order, taps};
    if (fitted != nullptr) {
        design.modes = fitted->modes;
        design.weights = fitted->weights;
    } else {
        design = bench::design_of(std::string(K::name()), order, length, horizon);
    }
    bench::HostLine<K> line(design);
    if (line.status() != glsum::Status::ok) {
        throw Failure(Exit::bad_input, fmt::format("{} with {} taps at order {}: {}", K::name(), length.text(), order,
                                                   bench::to_text(line.status())));
    }
    const auto& state = line.state();
    const std::size_t past = taps - 1;
    std::span<const typename K::Coefficient> table(state.table, glsum::table_needed<K>(design));
    std::vector<int> shifts;
    if constexpr (std::is_same_v<Technique, glsum::Scaled>) {
        shifts.assign(table.begin() + static_cast<std::ptrdiff_t>(past), table.end());
        table = table.first(past);
    }
    KernelData data;
    data.fixed = Format::fixed_point;
    data.pairs = is_paired<Technique>;
    data.horner_form = one_of<Technique, glsum::Horner, glsum::HornerFma>;
    data.format = Format::word;
    data.accumulator = c_type<typename Format::Accumulator>();
    data.output = c_type<Output>();
    data.past = past - 2 * design.modes.size() - design.blocks.count;
    data.modes = design.modes.size();
    data.decaying = data.modes;
    data.blocks = design.blocks;
    data.samples_held = glsum::past_needed<K>(design);
    data.table = numbers(table);
    data.aligned_words = (past + 1) / 2;
    data.history_text = text_of_history(typename K::HistoryPart{}, past, Format::fixed_point);
    data.increments = increments;
    if constexpr (glsum::guesses_tail<typename K::HistoryPart>) {
        data.guesses = true;
        data.in_window = static_cast<double>(state.in_window);
        data.minus_order = static_cast<double>(state.minus_order);
    }
    if constexpr (std::is_same_v<typename K::HistoryPart, glsum::Ring> &&
                  std::is_same_v<typename K::FormatPart, glsum::Q15>) {
        // GCC would keep the 64-bit sum of SMLALBB in memory: two more instructions a tap.
        data.history_text.behind_start = "#if defined(__arm__)\n    @NAME@_KEEP_WORD(sum);\n#endif\n";
    }
    if constexpr (has_modes) {
        if (glsum::has_integrator<typename K::HistoryPart> && data.modes > 0) {
            --data.decaying;
        }
        data.technique_text = modes_text(data.past, data.decaying, std::is_same_v<Technique, glsum::Compensated>,
                                         Format::fixed_point, std::is_same_v<Format, glsum::F64>);
        const double largest = increments ? 2.0 : 1.0;  // of what is kept
        data.design_error = data.modes == 0 || fitted != nullptr
                                ? 0.0
                                : largest * glsum::design::error_of(
                                                glsum::design::weights_to(increments ? order - 1.0 : order, horizon),
                                                data.past + 1, {design.modes.begin(), design.modes.end()}, INFINITY);
        if constexpr (glsum::has_integrator<typename K::HistoryPart>) {
            if (data.modes > 0) {
                data.integrator_weight = static_cast<double>(state.weight);
                data.history_text = integrator_text(data.history_text, data.past);
                data.technique_text.closing = integrator_closing();
            }
        }
    } else if constexpr (std::is_same_v<typename K::HistoryPart, glsum::Block>) {
        data.groups = glsum::Block::groups(past);
        data.technique_text = block_text(kernel.fused, Format::fixed_point);
    } else if constexpr (glsum::keeps_blocks<typename K::HistoryPart>) {
        data.has_blocks = true;
        data.technique_text =
            nested_text(data.past, data.blocks, Format::fixed_point, std::is_same_v<Format, glsum::F64>);
        data.design_error = glsum::design::design_blocks({order, horizon}, taps).error;
    } else if constexpr (states_its_sum<typename K::HistoryPart>) {
        data.technique_text = stated_sum_text(K::HistoryPart::word, Technique::summary, kernel.fused);
    } else {
        data.technique_text = text_of<Technique, Format>(kernel, data.history_text, past, shifts);
    }
    if constexpr (Format::fixed_point) {
        data.scale = {Format::sample_bits, Format::coefficient_bits, state.scale.table_exponent,
                      state.scale.output_exponent, state.scale.output_shift};
        if (increments) {
            --data.scale.sample_bits;
            ++data.scale.output_exponent;
            data.scale.half_scale = true;
        }
        data.format_text = fixed_text(data.scale);
    } else {
        data.format_text =
            floating_text(std::is_same_v<Sample, double>, std::is_same_v<typename Format::Accumulator, double>,
                          std::all_of(table.begin(), table.end(), [](auto a) { return std::isnormal(a); }));
    }
    data.error_bound = glsum::error_bound<K>(design, state, 1.0, horizon);
    data.bound_grows = data.guesses || glsum::has_integrator<typename K::HistoryPart>;
    std::vector<Sample> inputs;
    for (const double real : reals) {
        inputs.push_back(K::from_real(real));
    }
    data.inputs = numbers(std::span<const Sample>(inputs));
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < calls; ++k) {
        const Output output = line.step(inputs[k % inputs.size()]);
        hash.add(output);
        data.outputs.push_back(bits_of(output));
    }
    data.hash = hash.value();
    return data;
}

}  // namespace

std::vector<std::string> generatable() {
    std::vector<std::string> kernels;
    glsum::Registry::for_each([&]<class K>() {
        if (can_generate<K>) {
            kernels.emplace_back(K::name());
        }
    });
    return kernels;
}

KernelData describe(const std::string& kernel, double order, std::size_t taps, std::size_t horizon,
                    const glsum::design::FittedFilter* fitted, const std::vector<double>& inputs, std::size_t calls) {
    KernelData data;
    std::string why = "no kernel is called " + kernel + "; the nearest is " +
                      base::nearest_name(kernel, glsum::catalogue, &glsum::CatalogueEntry::name);
    glsum::Registry::with(kernel, [&]<class K>() {
        if constexpr (can_generate<K>) {
            data = describe<K>(order, taps, horizon, fitted, inputs, calls);
            why.clear();
        } else {
            why = kernel + " cannot be generated: " +
                  (K::host_only ? "it needs the host's vector unit" : "its words have no text in bench/generate");
        }
    });
    if (!why.empty()) {
        throw Failure(Exit::bad_input, why);
    }
    return data;
}

}  // namespace generate
