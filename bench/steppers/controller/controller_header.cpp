#include "bench/steppers/controller/controller_header.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/generate/header.hpp"
#include "bench/steppers/controller/texts.hpp"
#include "bench/texts/guards.hpp"
#include "bench/texts/text.hpp"
#include "targets/shared/output_hash.hpp"

namespace generate {
namespace {

constexpr std::size_t steps = 37 * 16;

std::string sum_header(const ControllerSpec& spec, const char* kernel, const SumOfController& of,
                       const std::string& prefix, const std::string& licence) {
    Spec sum;
    sum.kernel = kernel;
    sum.order = of.order;
    sum.taps = of.taps;
    sum.step_s = spec.controller.sample_time_s;
    sum.prefix = prefix;
    sum.licence = licence;
    sum.horizon = spec.horizon;
    return make_header(sum);
}

std::string limit_text(double limit) { return std::isfinite(limit) ? fmt::format("{}", limit) : "none"; }

}  // namespace

std::string make_controller_header(const ControllerSpec& spec, const std::string& prefix, const std::string& licence,
                                   const std::vector<std::string>& lines) {
    const drive::Fopid& controller = spec.controller;
    const drive::Gains& gains = controller.gains;
    const Factors factors = factors_of(controller);
    const std::string sums = upper(prefix);
    const std::string name = sums + "_F32";
    const std::string integral = sum_header(spec, integral_kernel, integral_sum(spec), prefix + "_integral", licence);
    const bool derives = gains.kd != 0.0;
    const std::string derivative =
        derives ? sum_header(spec, derivative_kernel, derivative_sum(spec), prefix + "_derivative", licence) : "";

    SteppedController stepped(spec);
    const std::vector<double> inputs = check_signal();
    firmware::OutputHash hash;
    for (std::size_t k = 0; k < steps; ++k) {
        hash.add(stepped.step(static_cast<float>(inputs[k % inputs.size()]),
                              static_cast<float>(inputs[(k + 5) % inputs.size()])));
    }
    const Places places{
        {"prefix", prefix},
        {"NAME", name},
        {"step", float_literal(controller.sample_time_s)},
        {"weight", float_literal(controller.setpoint_weight)},
        {"per_ki", float_literal(factors.integral)},
        {"per_kd", float_literal(factors.derivative)},
        {"kp", float_literal(gains.kp)},
        {"ki", float_literal(gains.ki * factors.integral)},
        {"kd", float_literal(gains.kd * factors.derivative)},
        {"passes", float_literal(factors.passes)},
        {"low", float_literal(controller.low)},
        {"high", float_literal(controller.high)},
        {"derivative_field", derives ? "    " + prefix + "_derivative_f32_instance derivative;\n" : ""},
        {"derivative_init", derives ? "    " + prefix + "_derivative_init_f32(&S->derivative);\n" : ""},
        {"derivative_index", derives ? "    size_t i;\n" : ""},
        {"derivative_start", derives ? fmt::format("    for (i = 0U; i < {0}_SAMPLES; ++i) {{\n"
                                                   "        S->derivative.past[i] = weighted;\n    }}\n",
                                                   sums + "_DERIVATIVE_F32")
                                     : ""},
        {"kd_note", derives ? "" : " There is no derivative part: kd is not used."},
        {"kd_scaled", fmt::format("{}_pid_product(kd, {}_DERIVATIVE)", prefix, name)},
        {"derivative_sum", derives ? prefix + "_derivative_step_f32(&S->derivative, weighted)" : std::string("0.0F")},
        {"steps", std::to_string(steps)},
        {"check", std::to_string(inputs.size())},
        {"hash", fmt::format("UINT64_C(0x{:016X})", hash.value())}};
    std::string text = fmt::format(
        "/**\n * A fractional PID controller in single precision, sampled every {} s:\n *\n"
        " *   u = {} w + {} D^-{} e + {} D^{} w / ({} s + 1),   e = r - y,   w = {} r - y,   {} <= u <= {}\n *\n"
        " *   static {}_f32_instance pid;\n *   {}_init_f32(&pid);   or {}_start_f32(&pid, r, y, u)\n"
        " *   float u = {}_step_f32(&pid, r, y);   once a sample\n *\n"
        " * {}_set_gains_f32 changes kp, ki, kd without a bump. At a limit the integral waits while it would drive\n"
        " * the output beyond it. NaN and infinities pass through and stay, until init.\n"
        " * The weights of the integral's sum are off by at most {} (the sum of the magnitudes over {} samples).\n",
        controller.sample_time_s, gains.kp, gains.ki, gains.integral_order, gains.kd, gains.derivative_order,
        gains.filter_s, controller.setpoint_weight, limit_text(controller.low), limit_text(controller.high), prefix,
        prefix, prefix, prefix, prefix, spec.max_error, spec.horizon);
    for (const std::string& line : lines) {
        text += line.empty() ? " *\n" : " * " + replaced(line, "*/", "* /") + "\n";
    }
    text += (licence.empty() ? "" : " * " + licence_line(licence)) + " */\n";
    std::string statements = replaced(std::string(pid_text), "glsum_pid", prefix + "_pid");
    statements = replaced(statements, "GLSUM_REAL", "float");
    statements = replaced(statements, "GLSUM_PID_KEEP", sums + "_INTEGRAL_F32_KEEP");
    const std::string code = integral + "\n" + derivative + "\n" + statements + fill(controller_text, places);
    return text +
           include_guard(prefix + "_f32",
                         fmt::format("kp = {}, ki = {}, kd = {}, orders {} and {}, h = {} s", gains.kp, gains.ki,
                                     gains.kd, gains.integral_order, gains.derivative_order, controller.sample_time_s),
                         fingerprint(code)) +
           "\n" + code;
}

}  // namespace generate
