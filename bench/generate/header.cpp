#include "bench/generate/header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <span>

#include "bench/generate/parts.hpp"
#include "bench/generate/text.hpp"
#include "bench/host_line.hpp"
#include "bench/row.hpp"
#include "bench/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/gain.hpp"
#include "qemu/failure.hpp"
#include "targets/firmware/output_hash.hpp"

namespace generate {
namespace {

using glsum::Exit;
using glsum::Failure;

// A prime number of inputs, repeated: no length of the past is a multiple of it by design.
constexpr std::size_t check_samples = 37;

template <class T, class... Ts>
constexpr bool one_of = (std::is_same_v<T, Ts> || ...);

template <class Technique>
constexpr bool is_paired = one_of<Technique, glsum::Smlald, glsum::Smlad, glsum::SmlaldShaped>;

template <class K>
constexpr bool can_generate = false;
template <class H, class T, class F>
constexpr bool can_generate<glsum::Sum<H, T, F>> =
    one_of<H, glsum::Shift, glsum::Ring, glsum::Mirror> &&
    (is_paired<T> ||
     one_of<T, glsum::Plain, glsum::PlainFma, glsum::Oldest, glsum::OldestFma, glsum::Multi, glsum::MultiFma,
            glsum::Compensated, glsum::Horner, glsum::HornerFma, glsum::HornerSplit, glsum::HornerSplitFma, glsum::Fir,
            glsum::FirFma, glsum::Scaled>)&&one_of<F, glsum::F64, glsum::F32, glsum::F32A64, glsum::Q31, glsum::Q15,
                                                   glsum::Q15C31>;

template <class Technique>
TechniqueText technique_text(const HistoryText& history, std::size_t past, const std::vector<int>& shifts) {
    using namespace glsum;
    if constexpr (one_of<Technique, Plain, PlainFma>) {
        return plain_text(history, std::is_same_v<Technique, PlainFma>);
    } else if constexpr (one_of<Technique, Oldest, OldestFma>) {
        return oldest_text(history, std::is_same_v<Technique, OldestFma>);
    } else if constexpr (one_of<Technique, Multi, MultiFma>) {
        return multi_text(history, std::is_same_v<Technique, MultiFma>);
    } else if constexpr (one_of<Technique, Horner, HornerFma>) {
        return horner_text(history, std::is_same_v<Technique, HornerFma>);
    } else if constexpr (one_of<Technique, HornerSplit, HornerSplitFma>) {
        return horner_split_text(history, std::is_same_v<Technique, HornerSplitFma>);
    } else if constexpr (one_of<Technique, Fir, FirFma>) {
        return fir_text(std::is_same_v<Technique, FirFma>);
    } else if constexpr (std::is_same_v<Technique, Compensated>) {
        return compensated_text(history);
    } else if constexpr (std::is_same_v<Technique, Scaled>) {
        return scaled_text(past, shifts);
    } else {
        return paired_text(!std::is_same_v<Technique, Smlad>);
    }
}

template <class T>
std::string c_type() {
    return std::is_same_v<T, double>         ? "double"
           : std::is_same_v<T, float>        ? "float"
           : std::is_same_v<T, std::int64_t> ? "int64_t"
           : std::is_same_v<T, std::int32_t> ? "int32_t"
           : std::is_same_v<T, std::int16_t> ? "int16_t"
                                             : "uint32_t";
}

// A constant that every compiler reads back to the same bits: decimal with the digits of a round trip, since hex floats
// are not C++11.
template <class T>
std::string literal(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        std::string text = fmt::format("{}", value);
        text += text.find_first_of(".e") == std::string::npos ? ".0" : "";
        return text + (std::is_same_v<T, float> ? "F" : "");
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
        return fmt::format("0x{:08X}U", value);
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return fmt::format("UINT64_C(0x{:016X})", value);
    } else if constexpr (std::is_same_v<T, std::int32_t>) {
        return value == INT32_MIN ? "INT32_MIN" : fmt::format("{}", value);
    } else {
        return fmt::format("{}", value);
    }
}

template <class T>
std::string array(const std::string& type, const std::string& name, std::span<const T> values) {
    std::string text = "static const " + type + " " + name + "[" + std::to_string(values.size()) + "] = {\n";
    std::string line;
    for (const T value : values) {
        const std::string next = literal(value) + ",";
        if (line.size() + next.size() + 5 > 118) {
            text += "   " + line + "\n";
            line.clear();
        }
        line += " " + next;
    }
    return text + "   " + line + "\n};\n";
}

template <class Output>
auto bits_of(Output output) {
    if constexpr (sizeof(Output) == 4) {
        return std::bit_cast<std::uint32_t>(output);
    } else {
        return std::bit_cast<std::uint64_t>(output);
    }
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

// Commented text may not end the comment.
std::string comment(const std::string& text) {
    std::string lines = " * ";
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            lines += "\n * ";
        } else if (text[i] == '/' && i > 0 && text[i - 1] == '*') {
            lines += " /";
        } else {
            lines += text[i];
        }
    }
    return lines + "\n";
}

// What the sum of the coefficients beyond the length can come to for |x| <= 1, at any length of the record.
std::string truncation_bound(double order, std::size_t taps) {
    if (order < 0.0) {
        return "without bound for records without end (v < 0); of a record of N samples, the sum of |a_j| from L to "
               "N-1";
    }
    const double all = order == 0.0 ? 1.0 : order <= 1.0 ? 2.0 : 2.0 * order;
    return fmt::format("{:.3g}", std::max(0.0, all - glsum::absolute_sum(order, taps)) * (1.0 + 1e-9) + 1e-14);
}

const char* const head = R"(#ifndef @NAME@_H
#define @NAME@_H

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
#define @NAME@_KEEP(value) __asm__("" : "+r"(value))
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

const char* const keep_fixed = R"(#if defined(__GNUC__)
#define @NAME@_KEEP(value) __asm__("" : "+r"(value))
#else
#define @NAME@_KEEP(value) ((void)(value))
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
/** One sample in, one sum out: S_k of x_k = newest and the @past@ samples before it. */
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
@NAME@_HELPER @wide@ @name@_@word@(uint32_t a, int32_t x, @wide@ sum)
{
#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
    return __@word@((int16x2_t)a, (int16x2_t)x, sum);
#else
    const int32_t low = (int16_t)(uint16_t)a * (int16_t)(uint16_t)x;
    const int32_t high = (int16_t)(uint16_t)(a >> 16) * (x >> 16);
    return sum + low + high;
#endif
}
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

template <class K>
std::string make(const Spec& spec) {
    using History = typename K::HistoryPart;
    using Technique = typename K::TechniquePart;
    using Format = typename K::FormatPart;
    using Sample = typename K::Sample;
    using Coefficient = typename K::Coefficient;
    using Output = typename K::Output;
    constexpr bool fixed = Format::fixed_point;
    const std::size_t past = spec.taps - 1;

    bench::HostLine<K> line({spec.order, spec.taps});
    if (line.status() != glsum::Status::ok) {
        throw Failure(Exit::bad_input, fmt::format("{} with {} taps at order {}: {}", spec.kernel, spec.taps,
                                                   spec.order, bench::to_text(line.status())));
    }
    const auto& state = line.state();
    const std::span<const Coefficient> table(state.table, K::table_count(spec.taps));

    HistoryText history = history_text(History{}, past);
    std::vector<int> shifts;
    if constexpr (std::is_same_v<Technique, glsum::Scaled>) {
        shifts.assign(table.begin() + static_cast<std::ptrdiff_t>(past), table.end());
    }
    TechniqueText technique = technique_text<Technique>(history, past, shifts);
    FormatText format;
    std::string constants;
    if constexpr (fixed) {
        format = fixed_text({Format::sample_bits, Format::coefficient_bits, state.scale.table_exponent,
                             state.scale.output_exponent, state.scale.output_shift});
        constants = fmt::format("#define @NAME@_OUTPUT_EXPONENT {}     /* S_k = output * 2^(OUTPUT_EXPONENT - 31) */\n",
                                static_cast<int>(state.scale.output_exponent));
        if (spec.step_s) {
            const glsum::Gain gain = glsum::make_gain(glsum::step_factor(spec.order, *spec.step_s));
            constants += fmt::format(
                "/* h^-v = GAIN_MANTISSA * 2^(GAIN_EXPONENT - 30): times S_k it is the derivative. */\n"
                "#define @NAME@_GAIN_MANTISSA {}\n#define @NAME@_GAIN_EXPONENT ({})\n",
                gain.mantissa, gain.exponent);
        }
    } else {
        format = floating_text(std::is_same_v<Sample, double>, std::is_same_v<typename Format::Accumulator, double>);
        if (spec.step_s) {
            constants = fmt::format("#define @NAME@_STEP_FACTOR {} /* h^-v: times S_k it is the derivative */\n",
                                    literal(static_cast<Sample>(glsum::step_factor(spec.order, *spec.step_s))));
        }
    }

    const std::string word(Format::word);
    const std::string name = spec.prefix + "_" + word;
    Places places{{"prefix", spec.prefix},
                  {"name", name},
                  {"NAME", upper(name)},
                  {"f", word},
                  {"taps", std::to_string(spec.taps)},
                  {"past", std::to_string(past)},
                  {"samples", std::to_string(std::max<std::size_t>(1, K::past_count(spec.taps)))},
                  {"sample", c_type<Sample>()},
                  {"coefficient", is_paired<Technique> ? "uint32_t" : c_type<Coefficient>()},
                  {"accumulator", c_type<typename Format::Accumulator>()},
                  {"output", c_type<Output>()},
                  {"moved", fixed ? "int32_t" : c_type<Sample>()},
                  {"includes", technique.fused ? "#include <math.h>\n" : ""},
                  {"fp_bit", std::is_same_v<typename Format::Accumulator, double> ? "8" : "4"},
                  {"fp_register", std::is_same_v<typename Format::Accumulator, double> ? "w" : "t"},
                  {"word", std::is_same_v<Technique, glsum::Smlad> ? "smlad" : "smlald"},
                  {"wide", std::is_same_v<Technique, glsum::Smlad> ? "int32_t" : "int64_t"}};
    if constexpr (is_paired<Technique>) {
        const std::size_t aligned = (past + 1) / 2;
        constants += fmt::format(
            "#define @NAME@_ALIGNED {}U            /* words of the table for windows that begin a word */\n"
            "#define @NAME@_SHIFTED {}U            /* and for those that begin in the middle of one */\n",
            aligned, table.size() / 2 - aligned);
    }
    places["constants"] = fill(constants, places);
    if (fixed) {
        history.fields = "    uint32_t saturations; /* outputs that saturated since init */\n" + history.fields;
        history.reset = "    S->saturations = 0U;\n" + history.reset;
    }
    places["fields"] = fill(history.fields, places);
    places["reset"] = fill(history.reset, places);

    // The body: a length of 1 has no past to read or keep.
    const bool pushes = technique.pushes;
    std::string body;
    if (past == 0) {
        // The nested form's sums have other units than those of products.
        constexpr bool nested = one_of<Technique, glsum::Horner, glsum::HornerFma>;
        body = std::string("    return @name@_finish(S, ") + (nested ? "newest" : "@name@_start(newest)") + ");\n";
        technique.sum.clear();
    } else {
        const bool has_head = history.fields.find(" head;") != std::string::npos;
        body = technique.sum + (pushes ? "" : history.push) + "    return @name@_finish(S, sum);\n";
        body = (has_head ? "    size_t head = S->head;\n" : "") +
               std::string(body.find("i = ") != std::string::npos ? "    size_t i;\n" : "") + body;
    }

    std::string text = "/**\n";
    text += comment(
        fmt::format("{}, {} taps: the Grünwald-Letnikov sum of order v = {}\n", spec.kernel, spec.taps, spec.order));
    text += comment("  S_k = sum_{j=0..min(k, L-1)} a_j x_(k-j),   a_0 = 1,   a_j = a_(j-1) (1 - (1+v)/j)\n");
    text +=
        comment(fmt::format("one sum a sample; h^-v S_k approximates the derivative of order v (v < 0: the integral).\n"
                            "Made by glsum; make it again rather than edit it.\n\n"
                            "History: {}.\nSum: {}.\nNumbers: {}.\n\nScaling and overflow behaviour\n{}\n",
                            history.summary, technique.summary, format.summary, fill(format.scaling, places)));
    text +=
        comment(fmt::format("Error bounds, absolute, of S_k for |x| <= 1, before h^-v\n"
                            "against the exact sum of {} taps, rounding of coefficients and inputs included: {:.3g}\n"
                            "that sum against full memory (truncation): {}\n",
                            spec.taps, glsum::error_bound<K>({spec.order, spec.taps}, state, 1.0),
                            truncation_bound(spec.order, spec.taps)));
    if (!spec.provenance.empty()) {
        text += comment(fmt::format("{}\n", fmt::join(spec.provenance, "\n")));
    }
    text += comment(fmt::format(
        "Bytes: instance {} + table {} (elsewhere the instance may be padded otherwise)\nLicence: {}.\n",
        "sizeof(" + name + "_instance)", table.size_bytes() - (shifts.size() * sizeof(Coefficient)), spec.licence));
    text +=
        comment(fmt::format("    static {0}_instance line;\n    {1}_init_{2}(&line);\n    {3} sum = "
                            "{1}_step_{2}(&line, x); /- once a sample -/",
                            name, spec.prefix, word, c_type<Output>()));
    text += " */\n";

    text += fill(head, places);
    if (fixed) {
        text += fill(guard_fixed, places);
        if (pushes && past > 0) {
            text += fill(keep_fixed, places);
        }
    } else {
        text += fill(guard_floating, places);
    }
    const bool moves = !pushes && std::is_same_v<History, glsum::Shift> && past > 0;
    if (moves) {
        text += fill(keep_word, places);
    }
    text += "\n";
    if (past > 0) {
        text += fill("/* The coefficients. */\n@NAME@_TABLE_ATTRIBUTES\n", places);
        if constexpr (is_paired<Technique>) {
            std::vector<std::uint32_t> words;
            for (std::size_t i = 0; i + 1 < table.size(); i += 2) {
                words.push_back(static_cast<std::uint16_t>(table[i]) |
                                static_cast<std::uint32_t>(static_cast<std::uint16_t>(table[i + 1])) << 16);
            }
            text += array<std::uint32_t>("uint32_t", name + "_table", words);
        } else {
            text +=
                array<Coefficient>(c_type<Coefficient>(), name + "_table", table.first(table.size() - shifts.size()));
        }
    }
    text += fill(instance, places);
    if (technique.pairs && past > 0) {
        text += fill(dsp, places);
    }
    // The helpers that the body calls, and those that they call, in the order of their definition.
    std::string used = body;
    std::string helpers;
    for (auto helper = format.helpers.rbegin(); helper != format.helpers.rend(); ++helper) {
        if (used.find("@name@_" + helper->first + "(") != std::string::npos) {
            helpers = "\n" + helper->second + helpers;
            used += helper->second;
        }
    }
    text += fill(helpers, places);
    places["body"] = fill(body, places);
    text += fill(step, places);

    // What the kernel itself gives.
    const std::vector<double> reals = bench::make_signal("noise", check_samples, 20200601);
    std::vector<Sample> inputs;
    for (const double real : reals) {
        inputs.push_back(K::from_real(real));
    }
    const std::size_t blocks = (2 * past + 3 + check_samples - 1) / check_samples + 2;
    const std::size_t steps = blocks * check_samples;
    using Bits = decltype(bits_of(Output{}));
    std::vector<Bits> outputs;
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        const Output output = line.step(inputs[k % check_samples]);
        hash.add(output);
        outputs.push_back(bits_of(output));
    }
    const std::span<const Bits> all(outputs);
    places["bits"] = sizeof(Bits) == 4 ? "uint32_t" : "uint64_t";
    places["steps"] = std::to_string(steps);
    places["check"] = std::to_string(check_samples);
    places["from"] = std::to_string(steps - check_samples);
    places["hash"] = literal(hash.value());
    places["inputs"] = array<Sample>(c_type<Sample>(), name + "_check_input", inputs);
    places["first"] = array<Bits>(places["bits"], name + "_check_first", all.first(check_samples));
    places["last"] = array<Bits>(places["bits"], name + "_check_last", all.last(check_samples));
    return text + fill(self_check, places);
}

bool is_identifier(const std::string& text) {
    return !text.empty() && text.size() <= 60 && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
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

std::string format_word(const std::string& kernel) { return kernel.substr(kernel.rfind('_') + 1); }

std::string make_header(const Spec& spec) {
    if (!is_identifier(spec.prefix)) {
        throw Failure(Exit::bad_input,
                      fmt::format("--prefix: expected letters, digits and underscores, found {}", spec.prefix));
    }
    std::string header;
    bool known = false;
    bool host_only = false;
    glsum::Registry::for_each([&]<class K>() {
        if (K::name() == spec.kernel) {
            known = true;
            host_only = K::host_only;
            if constexpr (can_generate<K>) {
                header = make<K>(spec);
            }
        }
    });
    if (!known) {
        throw Failure(Exit::bad_input, fmt::format("no kernel is called {}", spec.kernel));
    }
    if (header.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{} cannot be generated: {}", spec.kernel,
                                                   host_only ? "it needs the host's vector unit"
                                                             : "no emitter is written for one of its words"));
    }
    return header;
}

}  // namespace generate
