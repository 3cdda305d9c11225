#include "bench/generate/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "base/failure.hpp"
#include "bench/choose/counted_order.hpp"
#include "bench/generate/header_texts.hpp"
#include "bench/generate/kernel_data.hpp"
#include "bench/generate/literals.hpp"
#include "bench/generate/opening.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"
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

// The constants that follow from format and step.
std::string constants(const Spec& spec, const KernelData& data) {
    std::string text;
    if (data.fixed) {
        text = fmt::format("#define @NAME@_OUTPUT_EXPONENT {}     /* S_k = output * 2^(OUTPUT_EXPONENT - 31) */\n",
                           data.scale.output_exponent);
    }
    const char* const factor_name = spec.fitted ? "w_0 h^-v" : "h^-v";
    const double factor = spec.fitted   ? spec.fitted->factor
                          : spec.step_s ? glsum::step_factor(spec.order, *spec.step_s)
                                        : 0.0;
    if (spec.step_s && data.fixed) {
        const glsum::Gain gain = glsum::make_gain(factor);
        text += fmt::format(
            "/* {} = GAIN_MANTISSA * 2^(GAIN_EXPONENT - 30): times S_k it is the derivative. */\n"
            "#define @NAME@_GAIN_MANTISSA {}\n#define @NAME@_GAIN_EXPONENT ({})\n",
            factor_name, gain.mantissa, gain.exponent);
    } else if (spec.step_s) {
        text += fmt::format("#define @NAME@_STEP_FACTOR {} /* {}: times S_k it is the derivative */\n",
                            real_literal(data.inputs.type, factor), factor_name);
    }
    if (data.guesses) {
        text += fmt::format(
            "#define @NAME@_IN_WINDOW ({}) /* a_0 + ... + a_(L-1) */\n#define @NAME@_MINUS_ORDER ({}) /* -v */\n",
            real_literal(data.inputs.type, data.in_window), real_literal(data.inputs.type, data.minus_order));
    }
    if (data.integrator_weight) {
        text += fmt::format("#define @NAME@_INTEGRATOR_WEIGHT {} /* of the integrator */\n",
                            real_literal(data.inputs.type, *data.integrator_weight));
    }
    if (data.decaying > 0) {
        text += fmt::format("#define @NAME@_MODES {}U              /* decaying averages of what lies behind these */\n",
                            data.decaying);
    }
    if (data.groups) {
        text += fmt::format("#define @NAME@_GROUPS {}U             /* of four samples */\n", *data.groups);
    }
    if (data.blocks.count > 0) {
        text += fmt::format(
            "#define @NAME@_BLOCKS {}U             /* of samples that lie behind these */\n"
            "#define @NAME@_PER_LEVEL {}U          /* of each width: 2, 4, 8, ... */\n",
            data.blocks.count, data.blocks.per_level);
    }
    if (data.pairs) {
        const std::size_t all = data.table.integers.size() / 2;
        text += fmt::format(
            "#define @NAME@_ALIGNED {}U            /* words of the table for windows that begin a word */\n"
            "#define @NAME@_SHIFTED {}U            /* and for those that begin in the middle of one */\n",
            data.aligned_words, all - data.aligned_words);
    }
    return text;
}

// The statements of `step`. A length of 1 has no past to read or keep.
std::string step_body(const KernelData& data, std::size_t past) {
    const HistoryText& history = data.history_text;
    if (past == 0 && data.guesses) {
        return shared("plain") + history.behind + "    return @name@_finish(S, sum);\n";
    }
    if (past == 0) {
        return history.before + "    return @name@_finish(S, " +
               (data.horner_form ? "newest" : "@name@_start(newest)") + ");\n";
    }
    const TechniqueText& technique = data.technique_text;
    const std::string push = technique.pushes ? "" : history.push;
    // In software nothing runs meanwhile; but a Horner form that ends in products would end apart where the head is 0.
    const bool waits = (data.accumulator != "double" || data.horner_form) && history.behind.empty();
    const std::string body = history.before + technique.sum +
                             (waits ? push + technique.closing : technique.closing + history.behind + push) +
                             "    return @name@_finish(S, sum);\n";
    const bool has_head = history.fields.find(" head;") != std::string::npos;
    // The kernels' loops bring an index of their own.
    std::size_t indices = 0;
    for (std::size_t at = 0; (at = body.find("(i = ", at)) != std::string::npos; ++at) {
        ++indices;
    }
    const bool has_index = indices > 0 || body.find("    i = ") != std::string::npos;
    return std::string(has_head ? "    uint32_t head = S->head;\n" : "") + (has_index ? "    size_t i;\n" : "") + body;
}

// The Cortex-M7's own loop of this name, where the body takes one.
std::string m7_loop_of(const std::string& name) {
    const auto loop =
        std::find_if(std::begin(m7_loops), std::end(m7_loops), [&](const M7Loop& one) { return one.name == name; });
    if (loop == std::end(m7_loops)) {
        return "";
    }
    std::string text(loop->text);
    constexpr std::string_view ours = "GLSUM_";
    for (std::size_t at = 0; (at = text.find(ours, at)) != std::string::npos;) {
        if (text.compare(at, 15, "GLSUM_CORTEX_M4") == 0) {  // said to all headers at once
            at += ours.size();
        } else {
            text.replace(at, ours.size(), "@NAME@_");
        }
    }
    return fmt::format(
        "\n#if defined(__ARM_ARCH_7EM__) && defined(__GNUC__) && !defined(__PIC__)\n#define "
        "@NAME@_M7\n{}@NAME@_STEP_ATTRIBUTES\n"
        "@NAME@_{}(@name@_{}{})\n#endif\n",
        text, loop->macro, loop->name, loop->arguments);
}

// The helpers that the body calls, and those that they call, in the order of their definition.
std::string helpers_of(const KernelData& data, const std::string& body) {
    std::string used = body;
    std::string text;
    auto all = data.format_text.helpers;
    all.insert(all.end(), data.technique_text.helpers.begin(), data.technique_text.helpers.end());
    all.emplace_back(
        "next_head",
        shared("next_head", {{"[[nodiscard]] constexpr", "@NAME@_HELPER"}, {"next_head", "@name@_next_head"}}, 0));
    for (auto helper = all.rbegin(); helper != all.rend(); ++helper) {
        if (used.find("@name@_" + helper->first + "(") != std::string::npos) {
            text = "\n" + helper->second + text;
            used += helper->second;
        }
    }
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
    return fill(texts::guard_floating, {{"name", name}, {"NAME", upper(name)}, {"fp_bit", "4"}, {"fp_register", "t"}});
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
    const KernelData data = describe(spec.kernel, spec.order, spec.taps, spec.horizon,
                                     spec.fitted ? &*spec.fitted : nullptr, check_signal(), steps);
    const std::string name = spec.prefix + "_" + data.format;
    const bool wide_sum = data.accumulator == "double";
    const bool wide_bits = data.output == "double";
    const bool smlad = bench::facts_of(spec.kernel).technique == glsum::Smlad::word;
    Places places{{"prefix", spec.prefix},
                  {"name", name},
                  {"NAME", upper(name)},
                  {"f", data.format},
                  {"taps", std::to_string(spec.taps)},
                  {"past", std::to_string(data.past)},
                  {"reads", data.increments || data.guesses ? "what is kept of those"
                            : data.blocks.count > 0         ? fmt::format("the {} samples", held)
                            : data.modes == 0               ? fmt::format("the {} samples", past)
                                                            : "all samples"},
                  {"samples", std::to_string(std::max<std::size_t>(1, data.samples_held))},
                  {"sample", data.inputs.type},
                  {"coefficient", data.pairs ? "uint32_t" : data.table.type},
                  {"accumulator", data.accumulator},
                  {"output", data.output},
                  {"includes", data.technique_text.fused ? "#include <math.h>\n" : ""},
                  {"fp_bit", wide_sum ? "8" : "4"},
                  {"fp_register", wide_sum ? "w" : "t"},
                  {"rolled", wide_sum ? fill(texts::not_unrolled, {{"NAME", upper(name)}}) : ""},
                  {"turns", wide_sum ? "1" : "16"},  // in software a call from each turn costs more than the loop
                  {"word", smlad ? "smlad" : "smlald"},
                  {"two_products", shared("two products")},
                  {"wide", smlad ? "int32_t" : "int64_t"},
                  {"bits", wide_bits ? "uint64_t" : "uint32_t"},
                  {"steps", std::to_string(steps)},
                  {"check", std::to_string(check_samples)},
                  {"from", std::to_string(steps - check_samples)},
                  {"hash", bits_literal(data.hash, true)}};
    const bool fixed = data.fixed;
    const std::string body = step_body(data, past);
    places["constants"] = fill(constants(spec, data), places);
    places["fields"] = fill(
        (fixed ? "    uint32_t saturations; /* outputs that saturated since init */\n" : "") + data.history_text.fields,
        places);
    places["reset"] = fill((fixed ? "    S->saturations = 0U;\n" : "") + data.history_text.reset, places);
    places["body"] = fill(body, places);
    const std::span<const std::uint64_t> outputs(data.outputs);
    places["inputs"] = array(data.inputs.type, name + "_check_input", literals(data.inputs));
    places["first"] = array(places["bits"], name + "_check_first", literals(outputs.first(check_samples), wide_bits));
    places["last"] = array(places["bits"], name + "_check_last", literals(outputs.last(check_samples), wide_bits));

    std::string text = fill(fixed ? texts::guard_fixed : texts::guard_floating, places);
    const bool uses = past > 0;
    text += uses && wide_sum ? fill(texts::soft_double, places) : "";
    text += uses && body.find("_KEEP_WORD(") != std::string::npos ? fill(texts::keep_word, places) : "";
    if (uses && !(data.table.reals.empty() && data.table.integers.empty())) {
        text += fill("\n/* The coefficients. */\n@NAME@_TABLE_ATTRIBUTES\n", places) +
                array(places["coefficient"], name + "_table",
                      data.pairs ? words_of_pairs(data.table.integers) : literals(data.table));
    }
    text += fill(texts::instance, places);
    const std::string helpers = helpers_of(data, body);
    text += (helpers + body).find("_UNROLLED") != std::string::npos ? fill(texts::written_out, places) : "";
    text += uses && data.pairs ? fill(texts::dsp, places) : "";
    text += uses ? fill(m7_loop_of(data.technique_text.m7), places) : "";
    text += fill(helpers, places);
    text += fill(texts::step, places) + fill(texts::self_check, places);
    places["design"] = fmt::format(
        "{}, {}, v = {}{}", spec.kernel, length_of(spec).text(), spec.order,
        (spec.step_s ? fmt::format(", h = {} s", *spec.step_s) : "") + (spec.past_of_model ? ", the past of a model"
                                                                        : spec.fitted ? ", fitted to the derivative"
                                                                                      : ""));
    places["fingerprint"] = fingerprint(places["constants"] + text);
    return opening_comment(spec, data, places) + include_guard(name, places["design"], places["fingerprint"]) +
           fill(texts::head, places) + text;
}

}  // namespace generate
