#include "bench/steppers/controller/controller_header.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/rounded_up.hpp"
#include "bench/generate/header.hpp"
#include "bench/generate/literals.hpp"
#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "bench/steppers/controller/texts.hpp"
#include "bench/texts/guards.hpp"
#include "bench/texts/text.hpp"
#include "glsum/registry.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

constexpr std::size_t steps = 37 * 16;

std::string sum_header(const ControllerSpec& spec, const char* kernel, const SumOfController& of,
                       const std::string& prefix, const char* part, const std::string& licence) {
    Spec sum;
    sum.kernel = kernel;
    sum.order = of.order;
    sum.taps = of.taps;
    sum.step_s = spec.controller.sample_time_s;
    sum.prefix = prefix;
    sum.part = part;
    sum.licence = licence;
    sum.horizon = spec.horizon;
    return make_header(sum);
}

std::string limit_text(double limit) { return std::isfinite(limit) ? fmt::format("{}", limit) : "none"; }

// What stands around the two sums, and what its opening comment says of the format.
struct Around {
    Places places;
    std::string statements;
    std::string scales;
    std::string promise;  // lines of the comment
    std::string hash;     // of the self-check's outputs
};

Around around_f32(const ControllerSpec& spec, const std::string& prefix) {
    const drive::Fopid& controller = spec.controller;
    const drive::Gains& gains = controller.gains;
    const Factors factors = factors_of(controller);
    const std::string sums = upper(prefix);
    const std::string pid = prefix + "_pid";
    Around around;
    around.places = {{"number", "float"},
                     {"pid", pid},
                     {"step", float_literal(controller.sample_time_s)},
                     {"weight", float_literal(controller.setpoint_weight)},
                     {"per_ki", float_literal(factors.integral)},
                     {"per_kd", float_literal(factors.derivative)},
                     {"kp", float_literal(gains.kp)},
                     {"ki", float_literal(gains.ki * factors.integral)},
                     {"kd", float_literal(gains.kd * factors.derivative)},
                     {"passes", "    S->pid.passes = " + float_literal(factors.passes) + ";\n"},
                     {"low", float_literal(controller.low)},
                     {"high", float_literal(controller.high)},
                     {"weighted", fmt::format("{}_product({}_F32_WEIGHT, setpoint) - measured", pid, sums)},
                     {"error", "setpoint - measured"},
                     {"ki_scaled", fmt::format("{}_product(ki, {}_F32_INTEGRAL)", pid, sums)},
                     {"kd_scaled", fmt::format("{}_product(kd, {}_F32_DERIVATIVE)", pid, sums)},
                     {"none", "0.0F"},
                     {"gains_note", ""},
                     {"step_note", ""}};
    around.statements = replaced(std::string(pid_text), "glsum_pid", pid);
    around.statements = replaced(around.statements, "GLSUM_REAL", "float");
    around.statements = replaced(around.statements, "GLSUM_PID_KEEP", sums + "_INTEGRAL_F32_KEEP");
    around.scales = scales_f32_text;
    around.promise = " * the output beyond it. NaN and infinities pass through and stay, until init.\n";
    SteppedController stepped(spec);
    const std::vector<double> inputs = check_signal();
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        hash.add(stepped.step(static_cast<float>(inputs[k % inputs.size()]),
                              static_cast<float>(inputs[(k + 5) % inputs.size()])));
    }
    around.hash = literal(hash.value());
    return around;
}

Around around_q31(const ControllerSpec& spec, const std::string& prefix) {
    const std::string pid = prefix + "_pid_q31";
    const std::string name = upper(prefix) + "_Q31";
    FixedController stepped(spec);
    const FixedPid& fixed = stepped.numbers();
    const auto number = [](auto value) { return std::to_string(value); };
    Around around;
    around.places = {{"number", "int32_t"},
                     {"pid", pid},
                     {"step", literal(spec.controller.sample_time_s)},
                     {"input_full_scale", literal(fixed.input_full_scale)},
                     {"output_full_scale", literal(fixed.output_full_scale)},
                     {"per_input", literal(0x1p31 / fixed.input_full_scale)},
                     {"per_output", literal(0x1p31 / fixed.output_full_scale)},
                     {"per_kp", literal(1.0 / fixed.kp.unit)},
                     {"per_ki", literal(1.0 / fixed.ki.unit)},
                     {"per_kd", literal(1.0 / fixed.kd.unit)},
                     {"shift_kp", number(fixed.kp.shift)},
                     {"shift_ki", number(fixed.ki.shift)},
                     {"shift_kd", number(fixed.kd.shift)},
                     {"extra", number(fixed.extra)},
                     {"weight", number(fixed.weight)},
                     {"passes_mantissa", number(fixed.passes.mantissa)},
                     {"passes_shift", number(fixed.passes.shift)},
                     {"kp", literal(fixed.kp.mantissa)},
                     {"ki", literal(fixed.ki.mantissa)},
                     {"kd", literal(fixed.kd.mantissa)},
                     {"passes", ""},
                     {"low", literal(fixed.low)},
                     {"high", literal(fixed.high)},
                     {"weighted", pid + "_weighted(&S->pid, setpoint, measured)"},
                     {"error", pid + "_error(setpoint, measured)"},
                     {"ki_scaled", "ki"},
                     {"kd_scaled", "kd"},
                     {"none", "0"},
                     {"gains_note", fmt::format("\n * Integers, as {}_KP, _KI and _KD make them.", name)},
                     {"step_note", " Fractions of their full scales."}};
    around.statements = replaced(std::string(pid_q31_text), "glsum_pid", pid);
    around.statements = replaced(around.statements, "    GLSUM_PID_DESIGN\n", "");
    around.statements = replaced(around.statements, "GLSUM_PID_ROUND", name + "_ROUND");
    for (const char* const word : {"SHIFT_KP", "SHIFT_KI", "SHIFT_KD", "EXTRA", "WEIGHT", "PASSES", "PASSES_SHIFT"}) {
        around.statements =
            replaced(around.statements, fmt::format("GLSUM_PID_NUMBER({})", word), fmt::format("{}_{}", name, word));
    }
    around.scales = scales_q31_text;
    const FixedError& error = stepped.error();
    around.promise = fmt::format(
        " * the output beyond it.\n *\n"
        " * Full scales: {} for r and y (--input-scale), {} for u, the larger of its limits; an integer of 32 bits is\n"
        " * that many 2^-31. What lies beyond the input's saturates where it becomes an integer, as {}_INPUT\n"
        " * does. Behind that nothing overflows, whatever the samples and the gains are: e and w are held as "
        "fractions\n"
        " * of twice that full scale, u stops at its limits, the highest of which is 1 - 2^-31 of full scale, and the\n"
        " * integral has 64 bits, {} of them behind those of u.\n"
        " * Rounding: u is within {} + {} n of exact arithmetic with these taps and modes after n samples at which no\n"
        " * limit was met. The second adds up what the slow modes of the integral's sum lose, all of them, always.\n",
        fixed.input_full_scale, fixed.output_full_scale, name, fixed.extra, base::rounded_up(error.direct),
        base::rounded_up(error.per_sample));
    const std::vector<double> inputs = check_signal();
    std::vector<std::int32_t> fractions;
    for (const double input : inputs) {
        fractions.push_back(glsum::modes_plain_q31::from_real(input));
    }
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        hash.add(stepped.step(fractions[k % fractions.size()], fractions[(k + 5) % fractions.size()]));
    }
    around.hash = literal(hash.value());
    return around;
}

}  // namespace

std::string make_controller_header(const ControllerSpec& spec, const std::string& prefix, const std::string& licence,
                                   const std::vector<std::string>& lines) {
    check_prefix(prefix);
    const drive::Fopid& controller = spec.controller;
    const drive::Gains& gains = controller.gains;
    const std::string format = spec.format();
    const std::string name = upper(prefix + "_" + format);
    const std::string integral =
        sum_header(spec, integral_kernel(spec), integral_sum(spec), prefix, "_integral", licence);
    const bool derives = gains.kd != 0.0;
    const std::string derivative =
        derives ? sum_header(spec, derivative_kernel(spec), derivative_sum(spec), prefix, "_derivative", licence) : "";
    Around around = spec.input_full_scale ? around_q31(spec, prefix) : around_f32(spec, prefix);
    Places& places = around.places;
    places.merge(Places{
        {"prefix", prefix},
        {"format", format},
        {"NAME", name},
        {"derivative_field", derives ? fmt::format("    {}_derivative_{}_instance derivative;\n", prefix, format) : ""},
        {"derivative_init", derives ? fmt::format("    {}_derivative_init_{}(&S->derivative);\n", prefix, format) : ""},
        {"derivative_index", derives ? "    size_t i;\n" : ""},
        {"derivative_start", derives ? fmt::format("    for (i = 0U; i < {}_SAMPLES; ++i) {{\n"
                                                   "        S->derivative.past[i] = weighted;\n    }}\n",
                                                   upper(prefix + "_derivative_" + format))
                                     : ""},
        {"kd_note", derives ? "" : " There is no derivative part: kd is not used."},
        {"derivative_sum",
         derives ? fmt::format("{}_derivative_step_{}(&S->derivative, weighted)", prefix, format) : places.at("none")},
        {"steps", std::to_string(steps)},
        {"check", std::to_string(check_signal().size())},
        {"hash", around.hash}});
    std::string text = fmt::format(
        "/**\n * A fractional PID controller in {}, sampled every {} s:\n *\n"
        " *   u = {} w + {} D^-{} e + {} D^{} w / ({} s + 1),   e = r - y,   w = {} r - y,   {} <= u <= {}\n *\n"
        " *   static {}_{}_instance pid;\n *   {}_init_{}(&pid);   or {}_start_{}(&pid, r, y, u)\n"
        " *   {} u = {}_step_{}(&pid, r, y);   once a sample\n *\n"
        " * {}_set_gains_{} changes kp, ki, kd without a bump. At a limit the integral waits while it would drive\n",
        spec.input_full_scale ? "q31" : "single precision", controller.sample_time_s, gains.kp, gains.ki,
        gains.integral_order, gains.kd, gains.derivative_order, gains.filter_s, controller.setpoint_weight,
        limit_text(controller.low), limit_text(controller.high), prefix, format, prefix, format, prefix, format,
        places.at("number"), prefix, format, prefix, format);
    text += around.promise;
    text += fmt::format(
        " * The weights of the integral's sum are off by at most {} (the sum of the magnitudes over {} samples).\n",
        spec.max_error, spec.horizon);
    for (const std::string& line : lines) {
        text += line.empty() ? " *\n" : " * " + replaced(line, "*/", "* /") + "\n";
    }
    text += (licence.empty() ? "" : " * " + licence_line(licence)) + " */\n";
    const std::string code = integral + "\n" + derivative + fill(around.scales, places) + "\n" + around.statements +
                             fill(controller_text, places);
    return text +
           include_guard(prefix + "_" + format,
                         fmt::format("kp = {}, ki = {}, kd = {}, orders {} and {}, h = {} s", gains.kp, gains.ki,
                                     gains.kd, gains.integral_order, gains.derivative_order, controller.sample_time_s),
                         fingerprint(code)) +
           "\n" + code;
}

}  // namespace generate
