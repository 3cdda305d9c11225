#include "bench/generate/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "base/failure.hpp"
#include "bench/choose/counted_order.hpp"
#include "bench/generate/kernel_data.hpp"
#include "bench/generate/literals.hpp"
#include "bench/generate/opening.hpp"
#include "bench/generate/template.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/gain.hpp"
#include "glsum/logmemory/nested.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// A prime number of inputs, repeated: no length of the past is a multiple of it by design.
constexpr std::size_t check_samples = 37;

// What makes a derivative of the sum, where the step is known.
void add_factor(HeaderText& text, const Spec& spec) {
    if (!spec.step_s) {
        return;
    }
    const double factor = spec.fitted ? spec.fitted->factor : glsum::step_factor(spec.order, *spec.step_s);
    const glsum::Gain gain = glsum::make_gain(factor);
    text.facts["step"] = 1;
    text.places["factor_name"] = spec.fitted ? "w_0 h^-v" : "h^-v";
    text.places["step_factor"] = real_literal(text.places["sample"], factor);
    text.places["gain_mantissa"] = std::to_string(gain.mantissa);
    text.places["gain_exponent"] = std::to_string(gain.exponent);
}

// Of any number as a line of its own: the last line's end is the place's.
std::string table_text(const std::string& type, const std::string& name, const std::vector<std::string>& literals) {
    std::string text = array(type, name, literals);
    text.pop_back();
    return text;
}

// Samples that a kernel with blocks holds; of another, or none, 0.
std::size_t past_held(const Spec& spec) {
    const std::vector<std::string> known = generatable();
    if (std::find(known.begin(), known.end(), spec.kernel) == known.end() || !bench::has_blocks(spec.kernel)) {
        return 0;
    }
    const bench::Length length = bench::length_of(spec.kernel, spec.order, spec.taps, spec.horizon);
    return glsum::reach_of(bench::design_of(spec.kernel, spec.order, length, spec.horizon)) - 1;
}

bool is_identifier(const std::string& text) {
    return !text.empty() && text.size() <= 60 && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
}

}  // namespace

bench::Length length_of(const Spec& spec) {
    return choose::CountedOrder(spec.order, spec.fitted.has_value()).length(spec.kernel, spec.taps, spec.horizon);
}

std::vector<double> check_signal() { return bench::make_signal("noise", check_samples, 20200601); }

std::string prefix_of_file(const std::filesystem::path& file) {
    std::string prefix = file.stem().string();
    for (char& letter : prefix) {
        letter = is_identifier(std::string("_") + letter) ? letter : '_';
    }
    return is_identifier(prefix) ? prefix : ("glsum_" + prefix).substr(0, 60);
}

std::string floating_guard(const std::string& name) {
    HeaderText text{
        {}, {{"name", name}, {"NAME", upper(name)}, {"fp_bit", "4"}, {"fp_register", "t"}}, {{"header", {"header"}}}};
    return text.section("header", "guard floating");
}

std::string include_guard(const std::string& name, const std::string& design, const std::string& identity) {
    HeaderText text{{},
                    {{"name", name}, {"NAME", upper(name)}, {"design", design}, {"identity", identity}},
                    {{"header", {"header"}}}};
    return text.section("header", "include guard");
}

std::string format_word(const std::string& kernel) { return std::string(bench::facts_of(kernel).format); }

std::string make_header(const Spec& spec) {
    if (!is_identifier(spec.prefix)) {
        throw Failure(Exit::bad_input,
                      fmt::format("--prefix: expected letters, digits and underscores, found {}", spec.prefix));
    }
    const std::size_t past = spec.taps - 1;
    // Past twice the window, so that every history wraps, and two turns of the inputs more.
    const std::size_t held = std::max(past, past_held(spec));
    const std::size_t steps = ((2 * held + 3 + check_samples - 1) / check_samples + 2) * check_samples;
    KernelData data = describe(spec, check_signal(), steps);
    HeaderText& text = data.text;
    Facts& facts = text.facts;
    Places& places = text.places;
    const bool pairs = facts.contains("aligned");
    const bool wide_bits = places["output"] == "double";
    const std::string name = places["name"];
    const bool in_software = facts["in_software"] != 0;
    places["coefficient"] = pairs ? "uint32_t" : data.table.type;
    places["taps"] = std::to_string(spec.taps);
    places["reads"] = facts["increments"] != 0 || facts["held"] != 0 || facts["line"] != 0 ? "what is kept of those"
                      : facts["blocks"] != 0 ? fmt::format("the {} samples", held)
                      : facts["modes"] == 0  ? fmt::format("the {} samples", past)
                                             : "all samples";
    places["fp_bit"] = in_software ? "8" : "4";
    places["fp_register"] = in_software ? "w" : "t";
    places["turns"] = in_software ? "1" : "16";
    places["output_bits"] = wide_bits ? "uint64_t" : "uint32_t";
    places["steps"] = std::to_string(steps);
    places["check"] = std::to_string(check_samples);
    places["from"] = std::to_string(steps - check_samples);
    places["hash"] = bits_literal(data.hash, true);
    add_factor(text, spec);
    places["rolled"] = text.section("header", "rolled");
    places["constants"] = text.section("header", "constants");
    const std::vector<std::string> coefficients = pairs ? words_of_pairs(data.table.integers) : literals(data.table);
    facts["tabled"] = !coefficients.empty();
    places["table"] = table_text(places["coefficient"], name + "_table", coefficients);
    const std::span<const std::uint64_t> outputs(data.outputs);
    places["inputs"] = table_text(data.inputs.type, name + "_check_input", literals(data.inputs));
    places["first"] =
        table_text(places["output_bits"], name + "_check_first", literals(outputs.first(check_samples), wide_bits));
    places["last"] = table_text(places["output_bits"], name + "_check_last", literals(outputs.last(check_samples), wide_bits));
    facts["head"] = text.section("history", "fields").find(" head;") != std::string::npos;
    facts["behind"] = !text.section("history", "behind").empty();
    std::string body = text.section("header", "body");
    // The kernels' loops bring an index of their own.
    const auto says = [&](const std::string& what) { return body.find(what) != std::string::npos; };
    facts["indexed"] = facts["alone"] == 0 && (says("(i = ") || says("    i = "));
    facts["keeps_words"] = says("_KEEP_WORD(");
    const std::string helpers = text.helpers({"format", "sum", "history", "header"}, body);
    const bool unrolls = says("_UNROLLED") || helpers.find("_UNROLLED") != std::string::npos;
    body.pop_back();
    places["body"] = body;
    const std::string code = text.section("header", facts["fixed"] != 0 ? "guard fixed" : "guard floating") +
                             text.section("header", "coefficients") + text.section("header", "instance") +
                             (unrolls ? text.section("header", "unrolled") : "") +
                             (past > 0 ? text.section("sum", "declared") : "") + helpers +
                             text.section("header", "step") + text.section("header", "self check");
    const std::string design = fmt::format(
        "{}, {}, v = {}{}", spec.kernel, length_of(spec).text(), spec.order,
        (spec.step_s ? fmt::format(", h = {} s", *spec.step_s) : "") + (spec.past_of_model ? ", the past of a model"
                                                                        : spec.fitted ? ", fitted to the derivative"
                                                                                      : ""));
    return opening_comment(spec, data) + include_guard(name, design, fingerprint(places["constants"] + code)) +
           text.section("header", "head") + code;
}

}  // namespace generate
