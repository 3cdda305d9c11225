#include "gap/drive/start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "gap/drive/base/find.hpp"
#include "gap/drive/base/leftover.hpp"
#include "gap/drive/base/structure.hpp"

namespace gap {
namespace {

drive::Model unit_model(const std::string& form, double time_constant_s, double delay_s) {
    if (form == "fopdt") {
        return drive::make_fopdt(1.0, time_constant_s, delay_s);
    }
    if (form != "integrator") {
        return drive::make_sopdt(1.0, time_constant_s, delay_s);
    }
    drive::Model model;
    model.denominator = {{time_constant_s, 2.0}, {1.0, 1.0}};
    model.delay_s = delay_s;
    return model;
}

}  // namespace

drive::Form search_form(const std::string& form, const std::vector<Record>& records) {
    if (const Structure* structure = structure_named(form)) {
        return starts_of(*structure, records).whole;
    }
    if (form != "fopdt" && form != "sopdt" && form != "niopdt" && form != "integrator") {
        std::vector<std::string> known = {"fopdt", "sopdt", "niopdt", "integrator"};
        for (const Structure& structure : structures()) {
            known.emplace_back(structure.name);
        }
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("fit:{}: expected one of {}; the nearest is {}", form, fmt::join(known, ", "),
                                         base::nearest_name(form, known)));
    }
    if (form == "niopdt") {
        // Of whole orders: where the plant swings, no lag leads there.
        return {drive::Kind::niopdt, model_of(starts_of(*structure_named("second_order"), records).whole)};
    }
    std::vector<Course> courses;
    double length_s = 0.0;
    for (const Record& record : records) {
        courses.emplace_back(record, 1);
        length_s = std::max(length_s, record.time_s.back() - record.time_s.front());
    }
    drive::Model best;
    double least = std::numeric_limits<double>::infinity();
    const double shortest_s = records.front().usual_interval_s;
    constexpr int constants = 9;
    for (int i = 0; i < constants; ++i) {
        const double time_constant_s =
            0.3 * length_s * std::pow(shortest_s / (0.3 * length_s), static_cast<double>(i) / constants);
        for (const double share : {0.0, 0.3, 1.0, 2.0, 4.0}) {
            if (share * time_constant_s < 0.3 * length_s) {
                drive::Model model = unit_model(form, time_constant_s, share * time_constant_s);
                if (const Leftover left = leftover_of(model, courses, true); left.squares < least) {
                    least = left.squares;
                    best = model;
                    best.gain = left.gain;
                }
            }
        }
    }
    if (!std::isfinite(least)) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: no {} explains anything of it: do input and output belong together?",
                                         records.front().name, form));
    }
    if (form == "integrator") {
        drive::Model model = best;  // gain into the coefficients: the form has none of its own
        for (drive::Term& term : model.denominator) {
            term.coefficient /= model.gain;
        }
        model.gain = 1.0;
        return form_of(model);
    }
    return {form == "fopdt" ? drive::Kind::fopdt : drive::Kind::sopdt, best};
}

void take_base(Question& question, const std::string& words) {
    question.refit = true;
    if (words == "fit") {
        question.find = true;
        question.form = form_to_find();
        return;
    }
    question.base_name = words.substr(words.find(':') + 1);
    question.form = search_form(question.base_name, question.train);
}

drive::Form form_of(const drive::Model& model) {
    drive::Form form(model.kind, model);
    if (model.kind == drive::Kind::fotf) {
        for (drive::Parameter& parameter : form.parameters()) {
            const bool order = parameter.name.starts_with("alpha") || parameter.name.starts_with("beta");
            parameter.fixed = parameter.fixed || (order && parameter.value == std::floor(parameter.value));
        }
    }
    return form;
}

}  // namespace gap
