#include "bench/generate/opening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/rounded_up.hpp"
#include "bench/texts/text.hpp"
#include "glsum/catalogue.hpp"
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
std::string truncation_bound(const Spec& spec, glsum::Forgotten forgotten) {
    const double order = spec.order;
    const bool others = forgotten != glsum::Forgotten::zero;
    if (forgotten == glsum::Forgotten::increments && order <= 0.0) {
        return "none for v <= 0: the signal's level goes with the increments";
    }
    if (order < 0.0) {
        return std::string("none for records without end (v < 0); of N samples, ") + (others ? "twice " : "") +
               "the sum of |a_j| from L to N-1";
    }
    const double all = order == 0.0 ? 1.0 : order <= 1.0 ? 2.0 : 2.0 * order;
    const double largest = others ? 2.0 : 1.0;
    return base::rounded_up(largest * std::max(0.0, all - glsum::absolute_sum(order, spec.taps)) * (1.0 + 1e-9) +
                            1e-14);
}

}  // namespace

std::string opening_comment(const Spec& spec, HeaderText& header) {
    header.facts["model"] = spec.past_of_model;
    header.facts["fitted"] = spec.fitted.has_value();
    header.facts["use"] = !spec.use.empty();
    header.places["use"] = spec.use;
    header.places["kernel"] = spec.kernel;
    header.places["order"] = fmt::format("{}", spec.order);
    header.places["truncation_bound"] = truncation_bound(spec, glsum::find_kernel(spec.kernel)->forgotten);
    std::string text = header.section("header", "opening");
    text += spec.provenance.empty() ? "" : "\n";
    for (const std::string& line : spec.provenance) {
        text += line + "\n";
    }
    text += spec.licence.empty() ? "" : "\n" + licence_line(spec.licence);
    text.erase(text.find_last_not_of('\n') + 1);
    return "/**\n" + comment(text) + " */\n";
}

}  // namespace generate
