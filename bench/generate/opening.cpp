#include "bench/generate/opening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/rounded_up.hpp"
#include "bench/sweep/designs.hpp"
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
std::string truncation_bound(const Spec& spec, bool increments, bool guesses) {
    const double order = spec.order;
    if (increments && order <= 0.0) {
        return "none for v <= 0: the signal's level goes with the increments";
    }
    if (order < 0.0) {
        return std::string("none for records without end (v < 0); of N samples, ") + (guesses ? "twice " : "") +
               "the sum of |a_j| from L to N-1";
    }
    const double all = order == 0.0 ? 1.0 : order <= 1.0 ? 2.0 : 2.0 * order;
    const double largest = increments || guesses ? 2.0 : 1.0;
    return base::rounded_up(largest * std::max(0.0, all - glsum::absolute_sum(order, spec.taps)) * (1.0 + 1e-9) +
                            1e-14);
}

}  // namespace

std::string opening_comment(const Spec& spec, HeaderText& header) {
    const glsum::CatalogueEntry& kernel = bench::facts_of(spec.kernel);
    Facts& facts = header.facts;
    Places& places = header.places;
    const long near_taps = facts["past"] + 1;
    const bool guesses = facts["guesses"] != 0;
    const bool designed = facts["modes"] != 0 || kernel.blocks;
    facts["model"] = spec.past_of_model;
    facts["fitted"] = spec.fitted.has_value();
    facts["use"] = !spec.use.empty();
    places["use"] = spec.use;
    places["kernel"] = spec.kernel;
    places["order"] = fmt::format("{}", spec.order);
    places["length"] = facts["blocks"] > 0   ? fmt::format("{} taps and {} blocks", near_taps, facts["blocks"])
                       : facts["modes"] == 0 ? fmt::format("{} taps", spec.taps)
                                             : fmt::format("{} taps and {} modes", near_taps, facts["modes"]);
    places["summed"] = (guesses               ? fmt::format("{} taps and the tail's weights", spec.taps)
                        : facts["blocks"] > 0 ? "these taps and blocks"
                        : facts["modes"] == 0 ? fmt::format("{} taps", spec.taps)
                                              : "these taps and modes, as designed in double") +
                       (guesses || kernel.integrator ? fmt::format(", over {} samples", spec.horizon) : "");
    places["against"] = designed ? fmt::format("{} samples from rest", spec.horizon) : "truncation";
    places["memory_bound"] =
        designed ? places["design_error"] : truncation_bound(spec, facts["increments"] != 0, guesses);
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
