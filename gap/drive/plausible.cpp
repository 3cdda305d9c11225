#include "gap/drive/plausible.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/moments.hpp"

namespace gap {
namespace {

[[noreturn]] void refuse(const Record& record, const std::string& what) {
    throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: {}", record.name, what));
}

// The longest of the model's times, its terms alone.
double slowest_s(const drive::Model& model) {
    const double constant = drive::constant_coefficient(model.denominator);
    double slowest = 0.0;
    for (const drive::Term& term : model.denominator) {
        if (term.order > 0.0 && constant != 0.0) {
            slowest = std::max(slowest, std::pow(std::fabs(term.coefficient / constant), 1.0 / term.order));
        }
    }
    return slowest;
}

void check_times(const Record& record, const drive::Model& model) {
    const double length_s = record.time_s.back() - record.time_s.front();
    if (model.delay_s >= length_s) {
        refuse(record,
               fmt::format("expected a log longer than the model's dead time of {:.4g} s, found one of {:.4g} s",
                           model.delay_s, length_s));
    }
    const double slowest = slowest_s(model);
    if (slowest == 0.0) {
        return;
    }
    if (length_s < 0.1 * slowest) {
        refuse(record, fmt::format("lasts {:.4g} s, but the model takes {:.4g} s to move: are the stamps in seconds?",
                                   length_s, slowest));
    }
    if (record.usual_interval_s > 5.0 * (slowest + model.delay_s)) {
        refuse(record,
               fmt::format("has a sample every {:.4g} s, but the model is done after {:.4g} s: are the stamps in "
                           "seconds?",
                           record.usual_interval_s, slowest + model.delay_s));
    }
}

// Mean-free, how far the simulation must be scaled and how well it then fits.
void check_units(const Course& course, const drive::Model& model) {
    Scenario plain;
    plain.model = model;
    const std::vector<double> simulated = simulate(plain, course);
    const std::vector<double>& measured = course.record().output;
    for (const double reading : simulated) {
        if (!std::isfinite(reading)) {
            refuse(course.record(), fmt::format("the model runs away on its input: {}", drive::to_text(model)));
        }
    }
    const auto [ss, sm, mm] = moments_of(simulated, measured);
    const double ratio = std::sqrt(mm / ss);
    if (std::fabs(sm) > 0.7 * std::sqrt(ss * mm) && (ratio > 50.0 || ratio < 0.02)) {
        refuse(course.record(),
               fmt::format("its output moves {:.3g} times as far as the model's: expected the model's units, "
                           "found others, of input or output",
                           ratio));
    }
}

}  // namespace

void check_plausible(const Study& study) {
    if (study.base.refit) {
        return;  // the base takes its gain and times from the records
    }
    const drive::Model model = model_of(study.base.form);
    for (const Course& course : study.courses) {
        if (!study.scales.driven && course.record().simulated.empty()) {
            refuse(
                course.record(),
                "the input is 0 throughout: from rest a given model stays there; --refit or --model fit find where a "
                "free motion begins");
        }
        check_times(course.record(), model);
        check_units(course, model);
    }
}

}  // namespace gap
