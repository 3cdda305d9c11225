#include "bench/generate/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <sstream>

#include "base/failure.hpp"
#include "base/rounded_up.hpp"
#include "bench/choose/counted_order.hpp"
#include "bench/generate/kernel_data.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/gain.hpp"
#include "glsum/logmemory/nested.hpp"
#include "glsum/weights.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// A prime number of inputs, repeated: no length of the past is a multiple of it by design.
constexpr std::size_t check_samples = 37;

// A constant that every compiler reads back to the same bits: decimal with the digits of a round trip, since hex floats
// are not C++11.
std::string real_literal(const std::string& type, double value) {
    std::string text = type == "float" ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
    text += text.find_first_of(".e") == std::string::npos ? ".0" : "";
    return text + (type == "float" ? "F" : "");
}

// Bits as an unsigned constant.
std::string bits_literal(std::uint64_t bits, bool wide) {
    return wide ? fmt::format("UINT64_C(0x{:016X})", bits) : fmt::format("0x{:08X}U", bits);
}

std::string array(const std::string& type, const std::string& name, const std::vector<std::string>& literals) {
    std::string text = "static const " + type + " " + name + "[" + std::to_string(literals.size()) + "] = {\n";
    std::string line;
    for (const std::string& literal : literals) {
        if (line.size() + literal.size() + 6 > 118) {
            text += "   " + line + "\n";
            line.clear();
        }
        line += " " + literal + ",";
    }
    return text + "   " + line + "\n};\n";
}

std::vector<std::string> literals(const Numbers& numbers) {
    std::vector<std::string> texts;
    for (const double real : numbers.reals) {
        texts.push_back(real_literal(numbers.type, real));
    }
    for (const std::int64_t integer : numbers.integers) {
        texts.push_back(integer == INT32_MIN ? "INT32_MIN" : std::to_string(integer));
    }
    return texts;
}

// Two coefficients a word, the first in the lower half.
std::vector<std::string> words(const std::vector<std::int64_t>& coefficients) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < coefficients.size(); i += 2) {
        const auto low = static_cast<std::uint16_t>(coefficients.at(i));
        const auto high = static_cast<std::uint16_t>(coefficients.at(i + 1));
        texts.push_back(bits_literal(static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 16, false));
    }
    return texts;
}

std::vector<std::string> bits(std::span<const std::uint64_t> outputs, bool wide) {
    std::vector<std::string> texts;
    for (const std::uint64_t output : outputs) {
        texts.push_back(bits_literal(output, wide));
    }
    return texts;
}

// Lines of a comment, which none of them may end.
std::string comment(const std::string& text) {
    std::string lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        for (std::size_t at; (at = line.find("*/")) != std::string::npos;) {
            line.replace(at, 2, "* /");
        }
        lines += line.empty() ? " *\n" : " * " + line + "\n";
    }
    return lines;
}

// What the sum of the coefficients beyond the length can come to for |x| <= 1, at any length of the record; twice that
// where other samples stand for those dropped.
std::string truncation_bound(double order, std::size_t taps, const KernelData& data) {
    if (data.increments && order <= 0.0) {
        return "none for v <= 0: the signal's level goes with the increments";
    }
    if (order < 0.0) {
        return std::string("none for records without end (v < 0); of N samples, ") + (data.guesses ? "twice " : "") +
               "the sum of |a_j| from L to N-1";
    }
    const double all = order == 0.0 ? 1.0 : order <= 1.0 ? 2.0 : 2.0 * order;
    const double largest = data.increments || data.guesses ? 2.0 : 1.0;
    return base::rounded_up(largest * std::max(0.0, all - glsum::absolute_sum(order, taps)) * (1.0 + 1e-9) + 1e-14);
}

const char* const head = R"(
#include <stddef.h>
#include <stdint.h>
#include <string.h>
@includes@
#define @NAME@_TAPS @taps@U               /* L: coefficients, a_0 included */
#define @NAME@_PAST @past@U               /* past samples that a sum reads */
#define @NAME@_SAMPLES @samples@U            /* past samples that the instance holds */
@constants@
/* Define them before the inclusion to place the table (flash) and the step (tightly coupled memory). */
#ifndef @NAME@_TABLE_ATTRIBUTES
#define @NAME@_TABLE_ATTRIBUTES
#endif
#ifndef @NAME@_STEP_ATTRIBUTES
#define @NAME@_STEP_ATTRIBUTES
#endif

#if defined(__GNUC__)
#define @NAME@_HELPER static inline __attribute__((always_inline))
#else
#define @NAME@_HELPER static inline
#endif
)";

const char* const guard_floating = R"(
/* The bits are promised for IEEE arithmetic as written. A compiler may still fuse a product with the addition behind it
   (GCC does so by default, for a core with fused instructions): KEEP passes the rounded product through an empty
   instruction, which costs nothing and cannot be fused. Others are told by the standard's pragma. */
#if defined(__FAST_MATH__)
#error "@name@: -ffast-math reorders sums; compile without it"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "@name@: arithmetic in excess precision (x87) does not give the bits of this kernel"
#endif
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__x86_64__))
#define @NAME@_KEEP(value) __asm__("" : "+x"(value))
#elif defined(__GNUC__) && (defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & @fp_bit@)))
#define @NAME@_KEEP(value) __asm__("" : "+@fp_register@"(value))
#elif defined(__GNUC__) && defined(__arm__)
#define @NAME@_KEEP(value) ((void)(value)) /* in software: nothing is fused there */
#elif defined(__GNUC__) && defined(__riscv_flen)
#define @NAME@_KEEP(value) __asm__("" : "+f"(value))
#elif defined(__GNUC__)
#define @NAME@_KEEP(value) __asm__("" : "+m"(value))
#else
#pragma STDC FP_CONTRACT OFF
#define @NAME@_KEEP(value) ((void)(value))
#endif
)";

const char* const guard_fixed = R"(
#if (-1 >> 1) != -1
#error "@name@: needs arithmetic shifts of negative numbers"
#endif
)";

// Before a loop in software double. In one that is unrolled each turn would call the addition from a place of its own,
// and a core without a return stack guesses that it returns to the place before: a tenth more cycles.
const char* const not_unrolled =
    R"(#if defined(@NAME@_SOFT_DOUBLE) && !defined(__clang__) && __GNUC__ >= 8
#pragma GCC unroll 1
#endif
)";

const char* const soft_double = R"(#if defined(__GNUC__) && defined(__arm__) && !(defined(__ARM_FP) && (__ARM_FP & 8))
#define @NAME@_SOFT_DOUBLE /* double precision takes calls */
#endif
)";

const char* const keep_word = R"(#if defined(__GNUC__)
#define @NAME@_KEEP_WORD(value) __asm__("" : "+r"(value))
#else
#define @NAME@_KEEP_WORD(value) ((void)(value))
#endif
)";

const char* const instance = R"(
/** What changes from sample to sample; the caller owns it. One for each signal. */
typedef struct {
@fields@} @prefix@_@f@_instance;

/** Forgets the past: x = 0 before the next sample. Call it before the first step. */
static inline void @prefix@_init_@f@(@prefix@_@f@_instance *S)
{
    size_t i;
@reset@}
)";

const char* const step = R"(
/** One sample in, one sum out: S_k of x_k = newest and @reads@ before it. */
@NAME@_STEP_ATTRIBUTES
static inline @output@ @prefix@_step_@f@(@prefix@_@f@_instance *S, @sample@ newest)
{
@body@}
)";

const char* const dsp = R"(
/* Two samples as one word, the lower address in the lower half, and two products added at once. */
#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#endif
@NAME@_HELPER int32_t @name@_load_pair(const int16_t *pair)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    int32_t word;
    memcpy(&word, pair, sizeof word);
    return word;
#else
    return (int32_t)((uint32_t)(uint16_t)pair[0] | ((uint32_t)(uint16_t)pair[1] << 16));
#endif
}
@NAME@_HELPER @wide@ @name@_@word@(int32_t a, int32_t b, @wide@ sum)
{
#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
    return __@word@((int16x2_t)a, (int16x2_t)b, sum);
#else
@two_products@#endif
}
)";

const char* const written_out = R"(
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8
#define @NAME@_UNROLLED _Pragma("GCC unroll @turns@")
#else
#define @NAME@_UNROLLED
#endif
)";

const char* const self_check = R"(
/* The self-check: inputs, repeated, and what the registered kernel gave for them, bit by bit. */
@inputs@@first@@last@
/**
 * Runs @steps@ samples through the instance, which is initialised before and after, and compares every output with
 * those of the kernel that this header was made from.
 * Returns 0 when all bits are the same, else the number of the first sample that is known to differ, from 1.
 */
static inline uint32_t @prefix@_self_check_@f@(@prefix@_@f@_instance *S)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325); /* FNV-1a of all outputs, the lowest byte first */
    uint32_t wrong = 0U;
    uint32_t k;
    @prefix@_init_@f@(S);
    for (k = 0U; k < @steps@U; ++k) {
        const @output@ output = @prefix@_step_@f@(S, @name@_check_input[k % @check@U]);
        @bits@ bits;
        unsigned int byte;
        memcpy(&bits, &output, sizeof bits);
        for (byte = 0U; byte < sizeof bits; ++byte) {
            hash = (hash ^ ((bits >> (8U * byte)) & 0xFFU)) * UINT64_C(0x100000001B3);
        }
        if (wrong == 0U && ((k < @check@U && bits != @name@_check_first[k]) ||
                            (k >= @from@U && bits != @name@_check_last[k - @from@U]))) {
            wrong = k + 1U;
        }
    }
    @prefix@_init_@f@(S);
    return wrong != 0U ? wrong : hash == @hash@ ? 0U : @steps@U;
}

#endif /* @NAME@_H */
)";

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
        text.replace(at, ours.size(), "@NAME@_");
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

std::string opening_comment(const Spec& spec, const KernelData& data, const Places& places) {
    const std::string name = places.at("name");
    const std::string length = data.blocks.count > 0
                                   ? fmt::format("{} taps and {} blocks", data.past + 1, data.blocks.count)
                               : data.modes == 0 ? fmt::format("{} taps", spec.taps)
                                                 : fmt::format("{} taps and {} modes", data.past + 1, data.modes);
    std::string text =
        spec.past_of_model
            ? fmt::format("{}, {}: the past of a model\n\n  S_k = sum a_j x_(k-j), a_0 = 1, a_j of the table\n\n",
                          spec.kernel, length)
            : fmt::format(
                  "{}, {}: {} of order v = {}\n{}\n"
                  "{} {} S_k approximates the derivative of order v (v < 0: the integral).\n",
                  spec.kernel, length, spec.fitted ? "a sum fitted to the derivative" : "the Grünwald-Letnikov sum",
                  spec.order, spec.use.empty() ? "" : "\n" + spec.use,
                  spec.fitted ? "  S_k = sum a_j x_(k-j), a_0 = 1, a_j of the table;"
                  : data.history_text.formula.empty()
                      ? "  S_k = sum_{j=0..min(k, L-1)} a_j x_(k-j),   a_0 = 1,   a_j = a_(j-1) (1 "
                        "- (1+v)/j)\n\none sum a sample;"
                      : data.history_text.formula,
                  spec.fitted ? "w_0 h^-v" : "h^-v");
    text += "Made by glsum; make it again rather than edit it.\n\n";
    text += fmt::format(
        "  static {0}_instance line;\n  {1}_init_{2}(&line);\n  {3} sum = {1}_step_{2}(&line, x);  once a sample\n\n",
        name, spec.prefix, data.format, data.output);
    text += fmt::format("History: {}.\nSum: {}.\nNumbers: {}.\n\nScaling and overflow behaviour\n{}\n\n",
                        data.history_text.summary, data.technique_text.summary, data.format_text.summary,
                        fill(data.format_text.scaling, places));
    text += fmt::format(
        "Error bounds, absolute, of S_k for |x| <= 1, before h^-v\n"
        "against the exact sum of {}{}, rounding of coefficients and inputs included: {}\n{}\n",
        data.guesses            ? fmt::format("{} taps and the tail's weights", spec.taps)
        : data.blocks.count > 0 ? "these taps and blocks"
        : data.modes == 0       ? fmt::format("{} taps", spec.taps)
                                : "these taps and modes, as designed in double",
        data.bound_grows ? fmt::format(", over {} samples", spec.horizon) : "", base::rounded_up(data.error_bound),
        spec.fitted
            ? ""
            : fmt::format("of that sum against full memory ({}): {}\n",
                          data.modes == 0 && !data.has_blocks ? "truncation"
                                                              : fmt::format("{} samples from rest", spec.horizon),
                          data.modes == 0 && !data.has_blocks ? truncation_bound(spec.order, spec.taps, data)
                                                              : base::rounded_up(data.design_error)));
    for (const std::string& line : spec.provenance) {
        text += line + "\n";
    }
    if (!spec.licence.empty()) {
        text += (spec.provenance.empty() ? "" : "\n") + licence_line(spec.licence);
    }
    while (text.ends_with('\n')) {
        text.pop_back();
    }
    return "/**\n" + comment(text) + " */\n";
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
    return fill(guard_floating, {{"name", name}, {"NAME", upper(name)}, {"fp_bit", "4"}, {"fp_register", "t"}});
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
                  {"rolled", wide_sum ? fill(not_unrolled, {{"NAME", upper(name)}}) : ""},
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
    places["first"] = array(places["bits"], name + "_check_first", bits(outputs.first(check_samples), wide_bits));
    places["last"] = array(places["bits"], name + "_check_last", bits(outputs.last(check_samples), wide_bits));

    std::string text = fill(fixed ? guard_fixed : guard_floating, places);
    const bool uses = past > 0;
    text += uses && wide_sum ? fill(soft_double, places) : "";
    text += uses && body.find("_KEEP_WORD(") != std::string::npos ? fill(keep_word, places) : "";
    if (uses && !(data.table.reals.empty() && data.table.integers.empty())) {
        text += fill("\n/* The coefficients. */\n@NAME@_TABLE_ATTRIBUTES\n", places) +
                array(places["coefficient"], name + "_table",
                      data.pairs ? words(data.table.integers) : literals(data.table));
    }
    text += fill(instance, places);
    const std::string helpers = helpers_of(data, body);
    text += (helpers + body).find("_UNROLLED") != std::string::npos ? fill(written_out, places) : "";
    text += uses && data.pairs ? fill(dsp, places) : "";
    text += uses ? fill(m7_loop_of(data.technique_text.m7), places) : "";
    text += fill(helpers, places);
    text += fill(step, places) + fill(self_check, places);
    places["design"] = fmt::format(
        "{}, {}, v = {}{}", spec.kernel, length_of(spec).text(), spec.order,
        (spec.step_s ? fmt::format(", h = {} s", *spec.step_s) : "") + (spec.past_of_model ? ", the past of a model"
                                                                        : spec.fitted ? ", fitted to the derivative"
                                                                                      : ""));
    places["fingerprint"] = fingerprint(places["constants"] + text);
    return opening_comment(spec, data, places) + include_guard(name, places["design"], places["fingerprint"]) +
           fill(head, places) + text;
}

}  // namespace generate
