#include "bench/generate/kernel_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <type_traits>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/registry.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

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

// The name of a word's text.
template <class Word>
constexpr std::string_view text_of() {
    if constexpr (requires { Word::text; }) {
        return Word::text;
    } else {
        return Word::word;
    }
}

// The texts of a history: its own, those of what it wraps, and what every history has. `word` is that of the innermost.
template <class History>
void add_history(HeaderText& text, std::string& word) {
    std::vector<std::string>& chain = text.chains["history"];
    chain.emplace_back(text_of<History>());
    if constexpr (requires { typename History::kept; }) {
        add_history<typename History::kept>(text, word);
    } else {
        word = History::word;
        if constexpr (requires { History::fields; }) {
            text.places["own summary"] = History::summary;
            text.places["own fields"] = History::fields.substr(0, History::fields.size() - 1);
            chain.emplace_back(place_of(word + " window") != std::string_view::npos ? "window" : "stated");
        }
        chain.emplace_back("history");
    }
}

// The chains of a kernel's words; a history that states a sum itself gives the technique's, too. False where a text
// lacks.
template <class K>
bool add_chains(HeaderText& text, const glsum::CatalogueEntry& kernel) {
    using Technique = typename K::TechniquePart;
    std::string word;
    add_history<typename K::HistoryPart>(text, word);
    text.places["history"] = word;
    text.places["technique"] = kernel.unfused;
    const std::string own(kernel.unfused);
    text.facts["oldest_first"] = place_of(own + " older") < place_of(own + " newer");
    const auto has = [&](const std::string& chain, std::string_view section) {
        const auto& names = text.chains[chain];
        return std::any_of(names.begin(), names.end(), [&](const auto& name) { return has_section(name, section); });
    };
    std::string_view technique = kernel.unfused;
    if constexpr (requires { Technique::text; }) {
        technique = Technique::text;
    }
    if constexpr (requires { Technique::summary; }) {
        text.places["technique summary"] = Technique::summary;
        text.chains["sum"] = {std::string(technique), "technique", "history"};
    } else {
        text.chains["sum"] = {std::string(technique), "history"};
    }
    if (has("history", "sum")) {
        text.facts["sums_itself"] = 1;
        text.chains["sum"] = text.chains["history"];
    }
    text.chains["format"] = {K::FormatPart::fixed_point ? "fixed" : "floating"};
    text.chains["header"] = {"header"};
    return has("history", "fields") && has("sum", "sum");
}

// What a kernel's names and types say, and those of `spec`.
template <class K>
HeaderText text_of(const Spec& spec) {
    using Format = typename K::FormatPart;
    using Accumulator = typename Format::Accumulator;
    const glsum::CatalogueEntry& kernel = *glsum::find_kernel(K::name());
    constexpr bool in_software = std::is_same_v<Accumulator, double>;
    const std::string name = fmt::format("{}_{}", spec.prefix, kernel.format);
    const std::string call = name + (kernel.fused ? "_fused_" : "_");
    HeaderText text;
    text.places = {{"prefix", spec.prefix},
                   {"name", name},
                   {"NAME", upper(name)},
                   {"f", std::string(kernel.format)},
                   {"sample", c_type<typename K::Sample>()},
                   {"coefficient", c_type<typename K::Coefficient>()},
                   {"accumulator", c_type<Accumulator>()},
                   {"output", c_type<typename K::Output>()},
                   {"accumulate", call + "multiply_add"},
                   {"horner_step", call + "horner_step"},
                   {"rounded_once", kernel.fused ? ", product and addition rounded once" : ""}};
    for (const std::string_view word : {kernel.history, kernel.unfused, kernel.format}) {
        text.facts[std::string(word)] = 1;
    }
    text.facts["fused"] = kernel.fused;
    text.facts["fixed"] = Format::fixed_point;
    text.facts["in_software"] = in_software;
    text.facts["two_pieces"] = !K::HistoryPart::contiguous;
    text.facts["increments"] = kernel.forgotten == glsum::Forgotten::increments;
    text.facts["held"] = kernel.forgotten == glsum::Forgotten::held;
    text.facts["line"] = kernel.forgotten == glsum::Forgotten::line;
    text.facts["alone"] = spec.taps == 1;
    return text;
}

// Where a kernel says numbers of its own: reals as literals of its samples' type.
template <class Sample>
struct Says {
    HeaderText& text;
    void operator()(const std::string& name, double number) const {
        text.places[name] = real_literal(c_type<Sample>(), number);
    }
    template <std::integral Number>
    void operator()(const std::string& name, Number number) const {
        text.facts[name] = static_cast<long>(number);
    }
    template <std::integral Number>
    void operator()(const std::string& list, std::size_t index, const std::string& name, Number number) const {
        text.facts[list] = static_cast<long>(index) + 1;
        text.facts[fmt::format("{}.{}.{}", list, index, name)] = static_cast<long>(number);
    }
};

template <class K>
void add_scale(HeaderText& text, const typename K::State& state) {
    using Format = typename K::FormatPart;
    const int increments = text.facts["increments"] != 0 ? 1 : 0;  // of half the scale
    const int output_exponent = state.scale.output_exponent + increments;
    Places& places = text.places;
    places["sample_bits"] = std::to_string(Format::sample_bits - increments);
    places["sample_width"] = std::to_string(Format::sample_bits + 1);
    places["coefficient_bits"] = std::to_string(Format::coefficient_bits);
    places["coefficient_width"] = std::to_string(Format::coefficient_bits + 1);
    places["table_exponent"] = std::to_string(state.scale.table_exponent);
    places["start_shift"] = std::to_string(Format::coefficient_bits - state.scale.table_exponent);
    places["output_exponent"] = std::to_string(output_exponent);
    places["output_shift"] = std::to_string(state.scale.output_shift);
    places["plural"] = output_exponent == 1 ? "" : "s";
    places["input_range"] = increments != 0 ? "-2 <= x < 2" : "-1 <= x < 1";
}

template <class K>
KernelData describe(const Spec& spec, const std::vector<double>& reals, std::size_t calls) {
    using Technique = typename K::TechniquePart;
    using History = typename K::HistoryPart;
    using Format = typename K::FormatPart;
    using Sample = typename K::Sample;
    const std::string kernel(K::name());
    const bench::Length length = length_of(spec);
    glsum::Design design{spec.order, spec.taps};
    if (spec.fitted) {
        design.modes = spec.fitted->modes;
        design.weights = spec.fitted->weights;
    } else {
        design = bench::design_of(kernel, spec.order, length, spec.horizon);
    }
    bench::HostLine<K> line(design);
    if (line.status() != glsum::Status::ok) {
        throw Failure(Exit::bad_input, fmt::format("{} with {} taps at order {}: {}", kernel, length.text(), spec.order,
                                                   bench::to_text(line.status())));
    }
    const auto& state = line.state();
    const std::size_t past = spec.taps - 1;
    std::span<const typename K::Coefficient> table(state.table, glsum::table_needed<K>(design));
    KernelData data{};
    HeaderText& text = data.text = text_of<K>(spec);
    text.facts["past"] = static_cast<long>(past - 2 * design.modes.size() - design.blocks.count);
    text.facts["modes"] = static_cast<long>(design.modes.size());
    text.facts["decaying"] = std::count_if(design.modes.begin(), design.modes.end(),
                                           [](const glsum::Mode& mode) { return mode.decay != 0.0; });
    text.facts["blocks"] = static_cast<long>(design.blocks.count);
    text.facts["per_level"] = static_cast<long>(design.blocks.per_level);
    text.facts["samples"] = static_cast<long>(std::max<std::size_t>(1, glsum::past_needed<K>(design)));
    if constexpr (requires { History::constants(state, Says<Sample>{text}); }) {
        History::constants(state, Says<Sample>{text});
    }
    if constexpr (requires { Technique::constants(state.table, past, Says<Sample>{text}); }) {
        Technique::constants(state.table, past, Says<Sample>{text});
    }
    if (text.facts.contains("coefficients")) {
        table = table.first(static_cast<std::size_t>(text.facts["coefficients"]));
    }
    if constexpr (Format::fixed_point) {
        add_scale<K>(text, state);
    } else {
        text.facts["normal_table"] = std::all_of(table.begin(), table.end(), [](auto a) { return std::isnormal(a); });
    }
    add_chains<K>(text, *glsum::find_kernel(kernel));
    if (const auto fields = text.places.find("own fields"); fields != text.places.end()) {
        fields->second = text.filled(fields->second);
    }
    data.design_error = spec.fitted ? 0.0 : bench::design_error(kernel, spec.order, design, spec.horizon);
    data.error_bound = glsum::error_bound<K>(design, state, 1.0, spec.horizon);
    data.table = numbers(table);
    std::vector<Sample> inputs;
    for (const double real : reals) {
        inputs.push_back(K::from_real(real));
    }
    data.inputs = numbers(std::span<const Sample>(inputs));
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < calls; ++k) {
        const auto output = line.step(inputs[k % inputs.size()]);
        hash.add(output);
        data.outputs.push_back(bits_of(output));
    }
    data.hash = hash.value();
    return data;
}

template <class K>
bool can_generate() {
    if constexpr (requires { typename K::HistoryPart; }) {
        HeaderText text;
        return !K::host_only && add_chains<K>(text, *glsum::find_kernel(K::name()));
    }
    return false;
}

}  // namespace

std::vector<std::string> generatable() {
    std::vector<std::string> kernels;
    glsum::Registry::for_each([&]<class K>() {
        if (can_generate<K>()) {
            kernels.emplace_back(K::name());
        }
    });
    return kernels;
}

KernelData describe(const Spec& spec, const std::vector<double>& inputs, std::size_t calls) {
    KernelData data{};
    std::string why = "no kernel is called " + spec.kernel + "; the nearest is " +
                      base::nearest_name(spec.kernel, glsum::catalogue, &glsum::CatalogueEntry::name);
    glsum::Registry::with(spec.kernel, [&]<class K>() {
        why = spec.kernel + " cannot be generated: " +
              (K::host_only ? "it needs the host's vector unit" : "its words have no text in kernels/glsum");
        if constexpr (requires { typename K::HistoryPart; } && !K::host_only) {
            if (can_generate<K>()) {
                data = describe<K>(spec, inputs, calls);
                why.clear();
            }
        }
    });
    if (!why.empty()) {
        throw Failure(Exit::bad_input, why);
    }
    return data;
}

}  // namespace generate
