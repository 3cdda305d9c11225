#include <fmt/format.h>

#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

// A fixed-point number of 32 bits and whether it stands for one beyond them, and how sums come to it.
const Words rounding = {{"Rounded", "@name@_rounded"},
                        {"saturate(", "@name@_saturate("},
                        {"bool", "int"},
                        {"false", "0"},
                        {"true", "1"},
                        {"scale.", "S->"},
                        {" [[unlikely]]", ""}};

// What the kernel's text takes for the shift of its scale is known here.
Words shifted(int shift) { return {{"shift", std::to_string(shift)}}; }

}  // namespace

FormatText floating_text(bool wide_data, bool wide_sum, bool normal_table) {
    const bool exact_product = wide_sum && !wide_data;
    const Words fused = {{"fused", wide_sum ? "fma" : "fmaf"}};
    FormatText text;
    text.summary = exact_product ? "single precision, sums in double precision"
                   : wide_data   ? "double precision"
                                 : "single precision";
    // In software each conversion is a call; that of a coefficient, which is known to be normal, needs none.
    const bool widens = exact_product && normal_table;
    Words calls = {{"product(", "@name@_product("}, {"multiply(", "@name@_multiply("}};
    if (widens) {
        calls["static_cast<Accumulator>(a)"] = "@name@_widen(a)";
        calls["static_cast<Accumulator>(c)"] = "@name@_widen(c)";
    }
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
        {"product", helper("@accumulator@", "product", "@accumulator@ a, @accumulator@ b", shared("product"))},
        {"multiply", helper("@accumulator@", "multiply", "@coefficient@ a, @sample@ x", shared("multiply", calls))},
        {"multiply_add", helper("@accumulator@", "multiply_add", "@accumulator@ sum, @coefficient@ a, @sample@ x",
                                shared("multiply_add", calls))},
        // Adds to a number and keeps what the addition lost, for the next one.
        {"carry", helper("void", "carry", "@sample@ *carried, @sample@ step",
                         shared("carried", {{"value", "carried[0]"}, {"lost", "carried[1]"}, {"Number", "@sample@"}}))},
        {"add", helper("void", "add", "@accumulator@ *sum, @accumulator@ *lost, @accumulator@ term",
                       shared("compensated term", {{"sum", "*sum"}, {"lost", "*lost"}}))},
        {"fused_multiply_add",
         helper("@accumulator@", "fused_multiply_add", "@accumulator@ sum, @coefficient@ a, @sample@ x",
                shared("fused_multiply_add", fused))},
        {"horner_step", helper("@accumulator@", "horner_step", "@sample@ x, @coefficient@ c, @accumulator@ inner",
                               shared("horner step", calls))},
        {"fused_horner_step",
         helper("@accumulator@", "fused_horner_step", "@sample@ x, @coefficient@ c, @accumulator@ inner",
                shared("fused horner step", fused))},
        {"together", helper("@sample@", "together", "@sample@ one, @sample@ other", shared("together"))},
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
        {"start", helper("int64_t", "start", "@sample@ sample", shared("start fixed", shifted(shift)))},
        {"multiply_add",
         helper("int64_t", "multiply_add", "int64_t sum, @coefficient@ a, @sample@ x", shared("multiply_add fixed"))},
        {"horner_step", helper("int64_t", "horner_step", "@sample@ x, @coefficient@ c, int64_t inner",
                               shared("horner step fixed", shifted(shift)))},
        {"together", helper("@sample@", "together", "@sample@ one, @sample@ other", shared("together fixed"))},
        {"saturate", "typedef struct {\n    int32_t value;\n    int saturated;\n} @name@_rounded;\n" +
                         helper("@name@_rounded", "saturate", "int64_t value", shared("saturate", rounding))},
        {"round_shift", helper("@name@_rounded", "round_shift", "int64_t sum, int shift",
                               shared("round shift") + "    return @name@_saturate(value);\n")},
        {"finish",
         helper("int32_t", "finish", "@name@_instance *S, int64_t sum",
                fmt::format("    const @name@_rounded rounded = @name@_round_shift(sum, {});\n", scale.output_shift) +
                    shared("finish fixed", rounding))},
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
