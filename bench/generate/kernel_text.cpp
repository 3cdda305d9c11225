#include "bench/generate/kernel_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <type_traits>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "base/rounded_up.hpp"
#include "bench/generate/literals.hpp"
#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/gain.hpp"
#include "glsum/registry.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// The texts of a history: its own, those of what it wraps, and what every history has.
template <class History>
void add_history(HeaderText& text) {
    std::vector<std::string>& chain = text.chains["history"];
    if constexpr (requires { typename History::kept; }) {
        chain.emplace_back(History::text);
        add_history<typename History::kept>(text);
    } else {
        const std::string word(History::word);
        text.places["history"] = word;
        chain.push_back(word);
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
    add_history<typename K::HistoryPart>(text);
    text.places["technique"] = kernel.unfused;
    const std::string own(kernel.unfused);
    text.facts["oldest_first"] = place_of(own + " older") < place_of(own + " newer");
    const auto has = [&](const std::string& chain, std::string_view section) {
        const auto& names = text.chains[chain];
        return std::any_of(names.begin(), names.end(), [&](const auto& name) { return has_section(name, section); });
    };
    std::vector<std::string>& sum = text.chains["sum"];
    sum = {own};
    if constexpr (requires { Technique::text; }) {
        sum = {std::string(Technique::text)};
    } else if constexpr (requires { Technique::summary; }) {
        text.places["technique summary"] = Technique::summary;
        sum.emplace_back("technique");
    }
    sum.emplace_back("history");
    if (has("history", "sum")) {
        text.facts["sums_itself"] = 1;
        sum = text.chains["history"];
    }
    text.chains["format"] = {K::FormatPart::fixed_point ? "fixed" : "floating"};
    text.chains["header"] = {"header", "guards"};
    return has("history", "fields") && has("sum", "sum");
}

// What a kernel's names and types say, and those of `spec`.
template <class K>
HeaderText text_of(const Spec& spec) {
    using Format = typename K::FormatPart;
    using Accumulator = typename Format::Accumulator;
    const glsum::CatalogueEntry& kernel = *glsum::find_kernel(K::name());
    constexpr bool in_software = std::is_same_v<Accumulator, double>;
    const std::string prefix = spec.prefix + spec.part;
    const std::string name = fmt::format("{}_{}", prefix, kernel.format);
    const std::string call = name + (kernel.fused ? "_fused_" : "_");
    HeaderText text;
    text.places = {{"prefix", prefix},
                   {"name", name},
                   {"NAME", upper(name)},
                   {"f", std::string(kernel.format)},
                   {"sample", c_type<typename K::Sample>()},
                   {"accumulator", c_type<Accumulator>()},
                   {"output", c_type<typename K::Output>()},
                   {"call", call},
                   {"rounded_once", kernel.fused ? ", product and addition rounded once" : ""}};
    for (const std::string_view word : {kernel.history, kernel.unfused, kernel.format}) {
        text.facts[std::string(word)] = 1;
    }
    text.facts["fused"] = kernel.fused;
    text.facts["fixed"] = Format::fixed_point;
    text.facts["in_software"] = in_software;
    text.facts["two_pieces"] = !K::HistoryPart::contiguous;
    text.facts["alone"] = spec.taps == 1;
    return text;
}

// Where a kernel says numbers of its own: reals as literals of its samples' type.
template <class Sample>
struct Says {
    HeaderText& text;
    void operator()(const std::string& name, double number) const {
        using Real = std::conditional_t<std::is_same_v<Sample, float>, float, double>;
        text.places[name] = literal(static_cast<Real>(number));
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

// The numbers that a history, and what it wraps, says of itself.
template <class History, class State, class Sample>
void add_constants(const glsum::Design& design, const State& state, const Says<Sample>& says) {
    if constexpr (requires { typename History::kept; }) {
        add_constants<typename History::kept>(design, state, says);
    }
    if constexpr (requires { History::constants(design, state, says); }) {
        History::constants(design, state, says);
    }
}

// What makes a derivative of the sum, where the step is known.
template <class Sample>
void add_factor(HeaderText& text, const Spec& spec) {
    const double factor = spec.fitted   ? spec.fitted->factor
                          : spec.step_s ? glsum::step_factor(spec.order, *spec.step_s)
                                        : 0.0;
    const glsum::Gain gain = glsum::make_gain(factor);
    text.facts["step"] = spec.step_s.has_value();
    text.places["factor_name"] = spec.fitted ? "w_0 h^-v" : "h^-v";
    text.places["gain_mantissa"] = std::to_string(gain.mantissa);
    text.places["gain_exponent"] = std::to_string(gain.exponent);
    Says<Sample>{text}("step_factor", factor);
}

template <class K>
void add_scale(HeaderText& text, const typename K::State& state) {
    using Format = typename K::FormatPart;
    // 1 where a kernel holds samples at half of their scale.
    const int halved = std::ilogb(K::to_real(state, 1) / Format::to_real(1, state.scale));
    const int output_exponent = state.scale.output_exponent + halved;
    Places& places = text.places;
    places["sample_bits"] = std::to_string(Format::sample_bits - halved);
    places["sample_width"] = std::to_string(Format::sample_bits + 1);
    places["coefficient_bits"] = std::to_string(Format::coefficient_bits);
    places["coefficient_width"] = std::to_string(Format::coefficient_bits + 1);
    places["table_exponent"] = std::to_string(state.scale.table_exponent);
    places["start_shift"] = std::to_string(Format::coefficient_bits - state.scale.table_exponent);
    places["output_exponent"] = std::to_string(output_exponent);
    places["output_shift"] = std::to_string(state.scale.output_shift);
    places["plural"] = output_exponent == 1 ? "" : "s";
    places["input_range"] = fmt::format("-{0} <= x < {0}", 1 << halved);
}

// The table, and of two coefficients a word those of the first in its lower half.
template <class Coefficient>
void add_table(HeaderText& text, std::span<const Coefficient> table) {
    std::string type = c_type<Coefficient>();
    std::vector<std::string> texts;
    if constexpr (sizeof(Coefficient) == 2) {
        if (text.facts.contains("aligned")) {
            type = c_type<std::uint32_t>();
            for (std::size_t i = 0; i < table.size(); i += 2) {
                texts.push_back(literal(static_cast<std::uint32_t>(static_cast<std::uint16_t>(table[i])) |
                                        static_cast<std::uint32_t>(static_cast<std::uint16_t>(table[i + 1])) << 16));
            }
        }
    }
    if constexpr (std::is_floating_point_v<Coefficient>) {
        text.facts["normal_table"] = std::all_of(table.begin(), table.end(), [](auto a) { return std::isnormal(a); });
    }
    texts = texts.empty() ? literals(table) : texts;
    text.facts["tabled"] = !texts.empty();
    text.places["coefficient"] = type;
    text.places["table"] = array(type, text.places["name"] + "_table", texts);
}

// Inputs of the self-check, repeated past twice the window, so that every history wraps, and two turns more; the first
// and the last outputs, and the hash of all.
template <class K>
void add_check(HeaderText& text, bench::HostLine<K>& line) {
    using Output = typename K::Output;
    using Bits = std::conditional_t<sizeof(Output) == 8, std::uint64_t, std::uint32_t>;
    std::vector<typename K::Sample> inputs;
    for (const double real : check_signal()) {
        inputs.push_back(K::from_real(real));
    }
    const std::size_t check = inputs.size();
    const auto held = static_cast<std::size_t>(text.facts.at("held"));
    const std::size_t steps = ((2 * held + 3 + check - 1) / check + 2) * check;
    firmware::OutputHash hash;
    std::vector<Bits> outputs;
    for (std::size_t k = 0; k < steps; ++k) {
        const Output output = line.step(inputs[k % check]);
        hash.add(output);
        outputs.push_back(std::bit_cast<Bits>(output));
    }
    const auto add = [&](const char* place, const std::string& type, const auto& values) {
        text.places[place] = array(type, text.places["name"] + "_check_" + place, literals(std::span(values)));
    };
    const std::span<const Bits> all(outputs);
    add("input", c_type<typename K::Sample>(), std::span<const typename K::Sample>(inputs));
    add("first", c_type<Bits>(), all.first(check));
    add("last", c_type<Bits>(), all.last(check));
    text.places["output_bits"] = c_type<Bits>();
    text.places["hash"] = literal(hash.value());
    text.facts["check"] = static_cast<long>(check);
    text.facts["steps"] = static_cast<long>(steps);
    text.facts["from"] = static_cast<long>(steps - check);
}

template <class K>
HeaderText text_for(const Spec& spec) {
    using Technique = typename K::TechniquePart;
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
    HeaderText text = text_of<K>(spec);
    const Says<Sample> says{text};
    says("taps", spec.taps);
    says("past", past);
    says("held", past);
    says("horizon", spec.horizon);
    says("samples", std::max<std::size_t>(1, glsum::past_needed<K>(design)));
    add_constants<typename K::HistoryPart>(design, state, says);
    if constexpr (requires { Technique::constants(state.table, past, says); }) {
        Technique::constants(state.table, past, says);
    }
    if (text.facts.contains("coefficients")) {
        table = table.first(static_cast<std::size_t>(text.facts["coefficients"]));
    }
    if constexpr (K::FormatPart::fixed_point) {
        add_scale<K>(text, state);
    }
    add_chains<K>(text, *glsum::find_kernel(kernel));
    if (const auto fields = text.places.find("own fields"); fields != text.places.end()) {
        fields->second = text.filled(fields->second);
    }
    add_factor<Sample>(text, spec);
    add_table(text, table);
    add_check(text, line);
    text.places["error_bound"] = base::rounded_up(glsum::error_bound<K>(design, state, 1.0, spec.horizon));
    text.places["design_error"] =
        base::rounded_up(spec.fitted ? 0.0 : bench::design_error(kernel, spec.order, design, spec.horizon));
    return text;
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

HeaderText kernel_text(const Spec& spec) {
    HeaderText text;
    std::string why = "no kernel is called " + spec.kernel + "; the nearest is " +
                      base::nearest_name(spec.kernel, glsum::catalogue, &glsum::CatalogueEntry::name);
    glsum::Registry::with(spec.kernel, [&]<class K>() {
        why = spec.kernel + " cannot be generated: " +
              (K::host_only ? "it needs the host's vector unit" : "its words have no text in kernels/glsum");
        if constexpr (requires { typename K::HistoryPart; } && !K::host_only) {
            if (can_generate<K>()) {
                text = text_for<K>(spec);
                why.clear();
            }
        }
    });
    if (!why.empty()) {
        throw Failure(Exit::bad_input, why);
    }
    return text;
}

}  // namespace generate
