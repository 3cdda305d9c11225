#include <fmt/format.h>

#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

// 2^exponent as a C expression of 64 bits.
std::string power(int exponent) { return fmt::format("((int64_t)1 << {})", exponent); }

// sum 2^-shift to nearest, halves up, saturated to 32 bits: kernels/glsum/format/fixed.hpp, round_shift.
std::string finish(int shift) {
    std::string text;
    if (shift == 32) {
        text =
            "    /* The upper word and the bit below it. */\n"
            "    const int64_t value = (int64_t)(int32_t)(sum >> 32) + (int64_t)((uint32_t)sum >> 31);\n";
    } else if (shift > 0) {
        text = fmt::format(
            "    /* Not (sum + half) >> shift: sum + half may leave the 64 bits. */\n"
            "    const int64_t value = ((sum >> {}) + 1) >> 1;\n",
            shift - 1);
    } else if (shift == 0) {
        text = "    const int64_t value = sum;\n";
    } else {
        text = fmt::format(
            "    const int64_t limit = (int64_t)INT32_MAX >> {0};\n"
            "    const int64_t value = sum > limit ? (int64_t)INT32_MAX + 1\n"
            "                          : sum < -limit - 1 ? (int64_t)INT32_MIN - 1 : sum * {1};\n",
            -shift, power(-shift));
    }
    return text +
           "    const int32_t narrow = (int32_t)value;\n"
           "    if (narrow != value) {\n        ++S->saturations;\n"
           "        return value < 0 ? INT32_MIN : INT32_MAX;\n    }\n"
           "    return narrow;\n";
}

}  // namespace

FormatText floating_text(bool wide_data, bool wide_sum, bool normal_table) {
    // The product of two f32 is exact in f64: fused or not, the sum has the same bits.
    const bool exact_product = wide_sum && !wide_data;
    const std::string keep = exact_product ? "" : "    @NAME@_KEEP(product);\n";
    const std::string fma = wide_sum ? "fma" : "fmaf";
    FormatText text;
    text.summary = exact_product ? "single precision, sums in double precision"
                   : wide_data   ? "double precision"
                                 : "single precision";
    // In software each conversion is a call; that of a coefficient, which is known to be normal, needs none.
    const bool widens = exact_product && normal_table;
    const std::string widened = widens ? "@name@_widen(a)" : "(@accumulator@)a";
    if (widens) {
        text.helpers.push_back(
            {"widen", helper("double", "widen", "float a",
                             "#if defined(@NAME@_SOFT_DOUBLE)\n"
                             "    uint32_t bits;\n    uint64_t wide;\n    double widened;\n"
                             "    memcpy(&bits, &a, sizeof bits);\n"
                             "    wide = (uint64_t)((bits & 0x80000000U) | ((bits & 0x7FFFFFFFU) / 8U + 0x38000000U)) "
                             "<< 32 | (uint32_t)(bits << 29);\n"
                             "    memcpy(&widened, &wide, sizeof widened);\n"
                             "    return widened;\n#else\n    return a;\n#endif\n")});
    }
    const std::vector<std::pair<std::string, std::string>> others = {
        {"start", helper("@accumulator@", "start", "@sample@ newest", "    return newest;\n")},
        {"product", helper("@accumulator@", "product", "@accumulator@ a, @accumulator@ b",
                           "    @accumulator@ product = a * b;\n    @NAME@_KEEP(product);\n    return product;\n")},
        {"multiply",
         helper("@accumulator@", "multiply", "@coefficient@ a, @sample@ x",
                "    @accumulator@ product = " + widened + " * (@accumulator@)x;\n" + keep + "    return product;\n")},
        {"multiply_add", helper("@accumulator@", "multiply_add", "@accumulator@ sum, @coefficient@ a, @sample@ x",
                                "    return sum + @name@_multiply(a, x);\n")},
        // Adds to a number and keeps what the addition lost, for the next one.
        {"carry", helper("void", "carry", "@sample@ *carried, @sample@ step",
                         "    const @sample@ whole = step + carried[1];\n"
                         "    const @sample@ after = carried[0] + whole;\n"
                         "    const @sample@ part = after - carried[0];\n"
                         "    carried[1] = (carried[0] - (after - part)) + (whole - part);\n"
                         "    carried[0] = after;\n")},
        {"add", helper("void", "add", "@accumulator@ *sum, @accumulator@ *lost, @accumulator@ term",
                       shared("compensated term", {{"sum", "*sum"}, {"lost", "*lost"}}))},
        {"fused_multiply_add",
         helper("@accumulator@", "fused_multiply_add", "@accumulator@ sum, @coefficient@ a, @sample@ x",
                "    return " + fma + "(a, x, sum);\n")},
        {"nest", helper("@accumulator@", "nest", "@sample@ x, @coefficient@ a, @accumulator@ inner",
                        "    return @name@_product(" + (widens ? widened : "a") + ", inner) + x;\n")},
        {"fused_nest", helper("@accumulator@", "fused_nest", "@sample@ x, @coefficient@ c, @accumulator@ inner",
                              "    return " + fma + "(c, inner, x);\n")},
        {"finish", helper("@output@", "finish", "@name@_instance *S, @accumulator@ sum",
                          "    (void)S;\n    return (@output@)sum;\n")},
    };
    text.helpers.insert(text.helpers.end(), others.begin(), others.end());
    text.scaling =
        std::string("No scaling: any input below overflow (about ") + (wide_data ? "1e308" : "1e38") +
        ").\nOverflow as in IEEE 754: no saturation; infinities and NaN pass through and stay in the past for the\n"
        "length of the memory, until init. Denormal numbers are kept.";
    return text;
}

FormatText fixed_text(const FixedScale& scale) {
    FormatText text;
    text.summary = fmt::format("samples of {} bits, coefficients of {}, exact sums in 64",
                               scale.sample_bits + (scale.half_scale ? 2 : 1), scale.coefficient_bits + 1);
    const int shift = scale.coefficient_bits - scale.table_exponent;
    text.helpers = {
        {"start",
         helper("int64_t", "start", "@sample@ newest", "    return (int64_t)newest * " + power(shift) + ";\n")},
        {"multiply_add", helper("int64_t", "multiply_add", "int64_t sum, @coefficient@ a, @sample@ x",
                                "    return sum + (int64_t)a * x;\n")},
        {"nest",
         helper("int64_t", "nest", "@sample@ x, @coefficient@ c, int64_t inner",
                fmt::format("    /* 64 by 32 bits in two products; the upper one is a whole number of units. */\n"
                            "    const int64_t upper = (int64_t)(int32_t)(inner >> 32) * c;\n"
                            "    const int64_t lower = (int64_t)(uint32_t)inner * c;\n"
                            "    return x + upper * {} + ((lower + {}) >> {});\n",
                            power(32 - shift), power(shift - 1), shift))},
        {"finish", helper("int32_t", "finish", "@name@_instance *S, int64_t sum", finish(scale.output_shift))},
    };
    text.scaling = fmt::format(
        "Input: fractions of {0} bits, x = integer / 2^{0}, so {5}. Coefficients: fractions of {1} bits of\n"
        "a_j / 2^{2}; a_0 = 1 is exact. Output: S_k = output * 2^({3} - 31), to nearest, halves up: {3} integer bit{4} "
        "hold the\n"
        "sum of all |a_j|. The sum itself cannot overflow, whatever the input. Only an output within half a unit of\n"
        "+2^{3} can saturate; it does so to INT32_MAX and is counted in `saturations`{6}.",
        scale.sample_bits, scale.coefficient_bits, scale.table_exponent, scale.output_exponent,
        scale.output_exponent == 1 ? "" : "s", scale.half_scale ? "-2 <= x < 2" : "-1 <= x < 1",
        scale.half_scale ? ",\nas is an increment beyond 2: none where |x| <= 1 - 2^-30" : "");
    return text;
}

}  // namespace generate
