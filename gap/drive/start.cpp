#include "gap/drive/start.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "gap/drive/simulate.hpp"
#include "qemu/failure.hpp"

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

struct Found {
    drive::Model model;
    double left = std::numeric_limits<double>::infinity();
};

// Gain, and offset and initial output of each record, by linear least squares.
void try_model(const drive::Model& model, const std::vector<Course>& courses, Found& best) {
    Eigen::Index rows = 0;
    for (const Course& course : courses) {
        rows += static_cast<Eigen::Index>(course.record().size());
    }
    const auto columns = static_cast<Eigen::Index>(1 + 2 * courses.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
    Eigen::VectorXd right(rows);
    Eigen::Index row = 0;
    for (std::size_t r = 0; r < courses.size(); ++r) {
        Scenario driven;
        driven.model = model;
        const std::vector<double> forced = simulate(driven, courses[r]);
        Scenario released = driven;
        released.model.gain = 0.0;
        released.initial_output = 1.0;
        const std::vector<double> free = simulate(released, courses[r]);
        for (std::size_t i = 0; i < forced.size(); ++i, ++row) {
            matrix(row, 0) = forced[i];
            matrix(row, static_cast<Eigen::Index>(1 + 2 * r)) = 1.0;
            matrix(row, static_cast<Eigen::Index>(2 + 2 * r)) = free[i];
            right(row) = courses[r].record().output[i];
        }
    }
    if (!matrix.allFinite()) {
        return;
    }
    const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
    const double left = (matrix * solution - right).squaredNorm();
    if (std::isfinite(left) && left < best.left && solution(0) != 0.0) {
        best.left = left;
        best.model = model;
        best.model.gain = solution(0);
    }
}

}  // namespace

drive::Form search_form(const std::string& form, const std::vector<Record>& records) {
    if (form != "fopdt" && form != "sopdt" && form != "niopdt" && form != "integrator") {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("fit:{}: expected fit:fopdt, fit:sopdt, fit:niopdt or fit:integrator", form));
    }
    std::vector<Course> courses;
    double length_s = 0.0;
    for (const Record& record : records) {
        courses.emplace_back(record, 1);
        length_s = std::max(length_s, record.time_s.back() - record.time_s.front());
    }
    Found best;
    const double shortest_s = records.front().usual_interval_s;
    constexpr int constants = 9;
    for (int i = 0; i < constants; ++i) {
        const double time_constant_s =
            0.3 * length_s * std::pow(shortest_s / (0.3 * length_s), static_cast<double>(i) / constants);
        for (const double share : {0.0, 0.3, 1.0, 2.0, 4.0}) {
            if (share * time_constant_s < 0.3 * length_s) {
                try_model(unit_model(form, time_constant_s, share * time_constant_s), courses, best);
            }
        }
    }
    if (!std::isfinite(best.left)) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: no {} explains anything of it: do input and output belong together?",
                                         records.front().name, form));
    }
    if (form == "integrator") {
        drive::Model model = best.model;  // gain into the coefficients: the form has none of its own
        for (drive::Term& term : model.denominator) {
            term.coefficient /= model.gain;
        }
        model.gain = 1.0;
        return form_of(model);
    }
    const drive::Kind kind = form == "fopdt"   ? drive::Kind::fopdt
                             : form == "sopdt" ? drive::Kind::sopdt
                                               : drive::Kind::niopdt;
    return {kind, best.model};
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
