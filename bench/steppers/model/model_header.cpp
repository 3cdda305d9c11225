#include "bench/steppers/model/model_header.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>

#include "base/rounded_up.hpp"
#include "bench/generate/header.hpp"
#include "bench/generate/literals.hpp"
#include "bench/steppers/model/stepped_q31.hpp"
#include "bench/steppers/model/texts.hpp"
#include "bench/texts/guards.hpp"
#include "bench/texts/shared.hpp"
#include "bench/texts/template.hpp"
#include "bench/texts/text.hpp"
#include "glsum/registry.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

// Behind the dead time the tail's slowest states move; the check is of bits.
constexpr std::size_t steps_behind_waiting = 37 * 11 * 4;

// What the header's self-check feeds.
float check_input(std::size_t k) { return static_cast<float>(k % 37) / 16 - static_cast<float>(k % 11) / 8; }

// The same in q31, 16 for 1.
std::int32_t fixed_check_input(std::size_t k) {
    return static_cast<std::int32_t>(k % 37) * (1 << 25) - static_cast<std::int32_t>(k % 11) * (1 << 26);
}

// The sum of the model's past, as a header of its own.
std::string past_header(const ModelSpec& spec, const glsum::PastTable& table, const std::string& prefix,
                        const std::string& licence) {
    Spec sum;
    sum.kernel = spec.kernel();
    sum.order = 0.0;
    sum.taps = table.design().taps;
    sum.prefix = prefix;
    sum.part = "_past";
    sum.licence = licence;
    sum.past_of_model = true;
    sum.fitted = glsum::design::FittedFilter{
        1.0, {table.ratios.begin(), table.ratios.end()}, {table.modes.begin(), table.modes.end()}, {}};
    return make_header(sum);
}

// The statements of a step in q31.
std::string fixed_body_of(const glsum::ModelDesign& numbers, bool has_past) {
    Words words{{"state.line_length", "@NAME@_WAITING"},
                {"state.line_at", "S->waiting_at"},
                {"state.line", "S->waiting"},
                {"state.output_shift", "@NAME@_OUTPUT_SHIFT"},
                {"round_shift(", "@prefix@_q31_round_shift("},
                {"Rounded", "@prefix@_q31_rounded"},
                {"state.", "S->"}};
    // In a header a factor's numbers are constants.
    const auto product = [&](const char* value, const char* of_stepper, const char* factor) {
        words[fmt::format("times(state, {}, {})", value, of_stepper)] = fmt::format(
            "@prefix@_q31_times(S, {0}, @NAME@_{1}_MANTISSA, @NAME@_{1}_SHIFT, @NAME@_{1}_NEGATIVE)", value, factor);
    };
    product("acting", "0, state.input, 16", "INPUT");
    product("held.value", "0, state.constant, 17", "CONSTANT");
    product("past", "state.sums[i].scale.output_exponent, state.factor[i], i", "FACTOR");
    std::string body = shared("model input", words);
    body += numbers.half_input ? shared("model half input fixed", words) : "";
    // Declarations come first in C.
    std::string sum = has_past ? "    const int32_t past = @prefix@_past_step_q31(&S->past, S->newest);\n" : "";
    sum += shared("model forcing fixed", words);
    sum += numbers.constant != 0.0 ? shared("model constant fixed", words) : "";
    sum += has_past ? shared("model past fixed", words) : "";
    return body + sum + shared("model stored fixed", words) + shared("model output fixed", words);
}

std::string body_of(const glsum::ModelDesign& numbers, bool compensated, bool has_past) {
    Words words{{"state.line_length", "@NAME@_WAITING"},
                {"state.line_at", "S->waiting_at"},
                {"state.line", "S->waiting"},
                {"state.input", "@NAME@_INPUT"},
                {"state.constant", "@NAME@_CONSTANT"},
                {"state.", "S->"},
                {"GLSUM_KEEP", "@NAME@_KEEP"}};
    std::string body = shared("model input", words);
    body += numbers.half_input ? shared("model half input", words) : "";
    std::string sum = shared("model forcing", words) + shared("model constant", words);
    if (has_past) {
        words["factor * past"] = "@NAME@_FACTOR * past";
        body += "    const float past = @prefix@_past_step_f32(&S->past, S->newest);\n";
        sum += shared("model past", words);
    }
    return body + sum + "    S->newest = sum;\n" +
           shared(compensated ? "model output compensated" : "model output", words);
}

// Everything but its opening comment and its guard; the numbers are the stepper's.
std::string code_f32(const ModelSpec& spec, const std::string& prefix, const std::string& licence) {
    SteppedModel stepped(spec);
    const glsum::ModelDesign& numbers = stepped.design().design();
    const bool has_past = !numbers.tables.empty();
    const std::string name = upper(prefix) + "_F32";
    const std::size_t steps = steps_behind_waiting + numbers.delay;
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        hash.add(stepped.step(check_input(k)));
    }
    Places places{{"prefix", prefix},
                  {"NAME", name},
                  {"sample", "float"},
                  {"step", float_literal(spec.step_s)},
                  {"waiting", std::to_string(numbers.delay + 1)},
                  {"input", float_literal(numbers.input * (numbers.half_input ? 0.5 : 1.0))},
                  {"constant", float_literal(numbers.constant)},
                  {"factor_define", has_past ? fmt::format("#define {}_FACTOR {} /* times the past's sum */\n", name,
                                                           float_literal(numbers.tables[0].factor))
                                             : ""},
                  {"past_field", has_past ? "    " + prefix + "_past_f32_instance past;\n" : ""},
                  {"past_init", has_past ? "    " + prefix + "_past_init_f32(&S->past);\n" : ""},
                  {"lost_field", spec.compensated ? "    float lost; /* of the output, by its last addition */\n" : ""},
                  {"lost_init", spec.compensated ? "    S->lost = 0;\n" : ""},
                  {"steps", std::to_string(steps)},
                  {"hash", fmt::format("UINT64_C(0x{:016X})", hash.value())}};
    places["body"] = fill(body_of(numbers, spec.compensated, has_past), places);
    std::string code =
        has_past ? past_header(spec, numbers.tables[0], prefix, licence) : "#include <stdint.h>\n#include <string.h>\n";
    return code + floating_guard(prefix + "_f32") + fill(model_text, places);
}

std::string code_q31(const ModelSpec& spec, FixedModel& stepped, const std::string& prefix,
                     const std::string& licence) {
    const glsum::ModelDesign& numbers = stepped.design().design();
    const bool has_past = !numbers.tables.empty();
    const std::string name = upper(prefix) + "_Q31";
    const std::size_t steps = steps_behind_waiting + numbers.delay;
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        hash.add(stepped.step(fixed_check_input(k)));
    }
    std::string factors;
    const auto add = [&](const char* word, const FixedModel::Factor& factor) {
        factors +=
            fmt::format("#define {0}_{1}_MANTISSA {2}\n#define {0}_{1}_SHIFT {3}\n#define {0}_{1}_NEGATIVE {4}\n", name,
                        word, literal(factor.mantissa),
                        factor.shift < 0 ? fmt::format("({})", factor.shift) : std::to_string(factor.shift),
                        factor.negative ? 1 : 0);
    };
    add("INPUT", stepped.input());
    if (numbers.constant != 0.0) {
        add("CONSTANT", stepped.constant());
    }
    if (has_past) {
        add("FACTOR", stepped.past());
    }
    Places places{{"prefix", prefix},
                  {"name", prefix + "_q31"},
                  {"NAME", name},
                  {"sample", "int32_t"},
                  {"step", literal(spec.step_s)},
                  {"input_full_scale", literal(*spec.input_full_scale)},
                  {"output_full_scale", literal(stepped.output_full_scale())},
                  {"waiting", std::to_string(numbers.delay + 1)},
                  {"output_shift", std::to_string(stepped.output_shift())},
                  {"factors", factors},
                  {"past_field", has_past ? "    " + prefix + "_past_q31_instance past;\n" : ""},
                  {"past_init", has_past ? "    " + prefix + "_past_init_q31(&S->past);\n" : ""},
                  {"steps", std::to_string(steps)},
                  {"hash", literal(hash.value())}};
    HeaderText format{{}, places, {{"format", {"fixed"}}}};
    places["helpers"] = format.section("format", "helper saturate") + format.section("format", "helper round_shift");
    const Words words{
        {"Rounded", "@prefix@_q31_rounded"}, {"round_shift(", "@prefix@_q31_round_shift("}, {"state.", "S->"}};
    places["times"] = fill(shared("model times", words) + shared("model times signed", words), places);
    places["body"] = fill(fixed_body_of(numbers, has_past), places);
    std::string code =
        has_past ? past_header(spec, numbers.tables[0], prefix, licence) : "#include <stdint.h>\n#include <string.h>\n";
    return code + fill(model_q31_text, places);
}

}  // namespace

std::string make_model_header(const ModelSpec& spec, const std::string& prefix, const std::string& licence,
                              const std::vector<std::string>& lines) {
    check_prefix(prefix);
    const std::string format = spec.format();
    std::string code;
    std::string promise;
    if (spec.input_full_scale) {
        FixedModel stepped(spec, swing_of(spec));
        code = code_q31(spec, stepped, prefix, licence);
        promise = fmt::format(
            " *\n"
            " * Full scales: {} for u (--input-scale), {} for y; an integer of 32 bits is that many 2^-31. No u "
            "within\n"
            " * its full scale makes y or an increment leave theirs over {} samples from rest: both are above the "
            "sums\n"
            " * of the magnitudes that an impulse makes. What leaves them later saturates; of increments and products\n"
            " * `saturations` counts it.\n"
            " * Rounding: over these samples y is within {} of exact arithmetic with these taps and modes.\n",
            *spec.input_full_scale, stepped.output_full_scale(), spec.samples, base::rounded_up(stepped.error()));
    } else {
        code = code_f32(spec, prefix, licence);
        promise = " A NaN or an infinity stays, until init.\n";
    }
    std::string text = fmt::format(
        "/**\n * A model in {}, stepped every {} s:\n *\n *   y = {} u\n *\n"
        " *   static {}_{}_instance plant;\n *   {}_init_{}(&plant);\n"
        " *   {} y = {}_step_{}(&plant, u);   once a sample: y now, u held from now on\n *\n"
        " * Written on increments of y, of {} order in the sample time.",
        spec.input_full_scale ? "q31" : "single precision", spec.step_s, drive::to_text(spec.model), prefix, format,
        prefix, format, spec.input_full_scale ? "int32_t" : "float", prefix, format,
        spec.writing == drive::Writing::bdf2 ? "second" : "first");
    text += (spec.input_full_scale ? "\n" : "") + promise;
    for (const std::string& line : lines) {
        text += line.empty() ? " *\n" : " * " + replaced(line, "*/", "* /") + "\n";
    }
    return text + (licence.empty() ? "" : " * " + licence_line(licence)) + " */\n" +
           include_guard(prefix + "_" + format, fmt::format("{}, h = {} s", drive::to_text(spec.model), spec.step_s),
                         fingerprint(code)) +
           "\n" + code;
}

WrittenStepper written(const ModelSpec& spec, const std::string& prefix, std::string text) {
    WrittenStepper stepper{prefix, std::move(text), spec.format(), {{}}, {}, {}};
    const auto run = [&](auto&& stepped, auto&& of_format) {
        const glsum::ModelDesign& numbers = stepped.design().design();
        std::mt19937 chance(1);
        float held = 0.0F;
        for (std::size_t k = 0; k < 4000 + numbers.delay; ++k) {
            const float jump = std::ldexp(static_cast<float>(chance() >> 8U), -23) - 1.0F;
            held = k % 25 == 0 ? jump : held;
            const auto input = of_format(held);
            stepper.inputs[0].push_back(std::bit_cast<std::uint32_t>(input));
            stepper.expected.push_back(std::bit_cast<std::uint32_t>(stepped.step(input)));
        }
        if (!numbers.tables.empty() && numbers.tables[0].design().taps > 1) {
            stepper.tables.emplace_back("past");
        }
    };
    if (spec.input_full_scale) {
        run(FixedModel(spec, swing_of(spec)),
            [](float value) { return glsum::modes_plain_q31::from_real(static_cast<double>(value)); });
    } else {
        run(SteppedModel(spec), [](float value) { return value; });
    }
    return stepper;
}

}  // namespace generate
