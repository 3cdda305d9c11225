#include "bench/generate/header.hpp"

#include <fmt/format.h>

#include "bench/choose/counted_order.hpp"
#include "bench/generate/kernel_text.hpp"
#include "bench/generate/opening.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/texts/guards.hpp"
#include "bench/texts/template.hpp"
#include "glsum/catalogue.hpp"

namespace generate {
namespace {

// A prime number of inputs, repeated: no length of the past is a multiple of it by design.
constexpr std::size_t check_samples = 37;

}  // namespace

bench::Length length_of(const Spec& spec) {
    return choose::CountedOrder(spec.order, spec.fitted.has_value()).length(spec.kernel, spec.taps, spec.horizon);
}

std::vector<double> check_signal() { return bench::make_signal("noise", check_samples, 20200601); }

std::string format_word(const std::string& kernel) { return std::string(bench::facts_of(kernel).format); }

std::string make_header(const Spec& spec) {
    check_prefix(spec.prefix);
    HeaderText text = kernel_text(spec);
    Facts& facts = text.facts;
    Places& places = text.places;
    const bool in_software = facts["in_software"] != 0;
    places["fp_bit"] = in_software ? "8" : "4";
    places["fp_register"] = in_software ? "w" : "t";
    places["turns"] = in_software ? "1" : "16";
    places["rolled"] = text.section("header", "rolled");
    places["constants"] = text.section("header", "constants");
    facts["head"] = text.section("history", "fields").find(" head;") != std::string::npos;
    facts["behind"] = !text.section("history", "behind").empty();
    const std::string body = text.section("header", "body");
    const std::string helpers = text.helpers({"format", "sum", "history", "header"}, body);
    const auto says = [&](const std::string& what) { return (helpers + body).find(what) != std::string::npos; };
    // The kernels' loops bring an index of their own.
    facts["indexed"] = facts["alone"] == 0 && (body.find("(i = ") != body.npos || body.find("    i = ") != body.npos);
    facts["keeps_words"] = body.find("_KEEP_WORD(") != body.npos;
    facts["unrolled"] = says("_UNROLLED");
    // Each ends with a line of its own.
    places["body"] = body.substr(0, body.size() - 1);
    places["helpers"] = helpers.substr(0, helpers.size() - 1);
    const std::string code = text.section("header", "code");
    const std::string made = spec.past_of_model ? ", the past of a model" : spec.fitted ? ", " + spec.fitted_by : "";
    const std::string design = fmt::format("{}, {}, v = {}{}{}", spec.kernel, length_of(spec).text(), spec.order,
                                           spec.step_s ? fmt::format(", h = {} s", *spec.step_s) : "", made);
    return opening_comment(spec, text) +
           include_guard(places["name"], design, fingerprint(places["constants"] + code)) +
           text.section("header", "head") + code;
}

}  // namespace generate
