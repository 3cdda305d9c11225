#include "bench/steppers/model/model_header.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>

#include "bench/generate/header.hpp"
#include "bench/steppers/model/texts.hpp"
#include "bench/texts/guards.hpp"
#include "bench/texts/shared.hpp"
#include "bench/texts/text.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

// Behind the dead time the tail's slowest states move; the check is of bits.
constexpr std::size_t steps_behind_waiting = 37 * 11 * 4;

// What the header's self-check feeds.
float check_input(std::size_t k) { return static_cast<float>(k % 37) / 16 - static_cast<float>(k % 11) / 8; }

// The sum of the model's past, as a header of its own.
std::string past_header(const ModelSpec& spec, const glsum::PastTable& table, const std::string& prefix,
                        const std::string& licence) {
    Spec sum;
    sum.kernel = spec.kernel();
    sum.order = 0.0;
    sum.taps = table.design().taps;
    sum.prefix = prefix;
    sum.licence = licence;
    sum.past_of_model = true;
    sum.fitted = glsum::design::FittedFilter{
        1.0, {table.ratios.begin(), table.ratios.end()}, {table.modes.begin(), table.modes.end()}, {}};
    return make_header(sum);
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

}  // namespace

std::string make_model_header(const ModelSpec& spec, const std::string& prefix, const std::string& licence,
                              const std::vector<std::string>& lines) {
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
    std::string text = fmt::format(
        "/**\n * A model in single precision, stepped every {} s:\n *\n *   y = {} u\n *\n"
        " *   static {}_f32_instance plant;\n *   {}_init_f32(&plant);\n"
        " *   float y = {}_step_f32(&plant, u);   once a sample: y now, u held from now on\n *\n"
        " * Written on increments of y, of {} order in the sample time. A NaN or an infinity stays, until init.\n",
        spec.step_s, drive::to_text(spec.model), prefix, prefix, prefix, numbers.half_input ? "second" : "first");
    for (const std::string& line : lines) {
        text += line.empty() ? " *\n" : " * " + replaced(line, "*/", "* /") + "\n";
    }
    std::string code = has_past ? past_header(spec, numbers.tables[0], prefix + "_past", licence)
                                : "#include <stdint.h>\n#include <string.h>\n";
    code += floating_guard(prefix + "_f32") + fill(model_text, places);
    return text + (licence.empty() ? "" : " * " + licence_line(licence)) + " */\n" +
           include_guard(prefix + "_f32", fmt::format("{}, h = {} s", drive::to_text(spec.model), spec.step_s),
                         fingerprint(code)) +
           "\n" + code;
}

WrittenStepper written(const ModelSpec& spec, const std::string& prefix, std::string text) {
    WrittenStepper stepper{prefix, std::move(text), "f32", {{}}, {}, {}};
    SteppedModel stepped(spec);
    const std::size_t count = 4000 + stepped.design().design().delay;
    std::mt19937 chance(1);
    float held = 0.0F;
    for (std::size_t k = 0; k < count; ++k) {
        const float jump = std::ldexp(static_cast<float>(chance() >> 8U), -23) - 1.0F;
        held = k % 25 == 0 ? jump : held;
        stepper.inputs[0].push_back(std::bit_cast<std::uint32_t>(held));
        stepper.expected.push_back(std::bit_cast<std::uint32_t>(stepped.step(held)));
    }
    const auto& tables = stepped.design().design().tables;
    if (!tables.empty() && tables[0].design().taps > 1) {
        stepper.tables.emplace_back("past");
    }
    return stepper;
}

}  // namespace generate
