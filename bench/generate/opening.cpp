#include "bench/generate/opening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/rounded_up.hpp"
#include "glsum/weights.hpp"

namespace generate {
namespace {

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

}  // namespace

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

}  // namespace generate
