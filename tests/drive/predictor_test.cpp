// The residuals of a form's model, and how they change with each of its parameters: by differences of the residuals.
#include "drive/predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "drive/closed_loop.hpp"
#include "drive/controller.hpp"
#include "drive/response.hpp"

namespace {

using drive::Form;
using drive::Kind;
using drive::Model;
using drive::Record;

// With a zero of order 0.6, and terms of orders that are no whole ones.
Model with_zero() {
    Model model;
    model.gain = 1.5;
    model.numerator = {{0.4, 0.6}, {1.2, 0.0}};
    model.denominator = {{0.5, 1.7}, {0.8, 0.9}, {1.1, 0.0}};
    model.delay_s = 0.213;
    return model;
}

Record open_record() {
    Record record;
    record.changes = {{0.0, 1.0}, {1.0, -0.75}, {2.0, 0.5}};
    for (int k = 0; k < 40; ++k) {
        record.time_s.push_back(0.1 * k);
        record.output.push_back(0.02 * k);
    }
    return record;
}

Record looped_record() {
    Record record = open_record();
    record.controller = drive::to_model({.kp = 0.6, .ki = 0.4, .integral_order = 0.9}, "controller");
    for (std::size_t k = 0; k < record.time_s.size(); ++k) {
        record.reference.push_back(k < 20 ? 1.0 : 0.25);
    }
    record.changes = drive::changes_of(record.time_s, record.reference);
    return record;
}

Form free_form(Kind kind, const Model& model) {
    Form form(kind, model);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name == "beta0" || parameter.name == "alpha0";  // an order of 0 is no number
    }
    return form;
}

std::vector<double> free_values(const drive::Predictor& predictor, const Form& form) {
    std::vector<double> values;
    for (const std::size_t index : predictor.free()) {
        values.push_back(form.parameters()[index].value);
    }
    return values;
}

void expect_slopes(const Form& form, const std::vector<Record>& records) {
    const drive::Predictor predictor(form, records);
    std::vector<double> values = free_values(predictor, form);
    Eigen::VectorXd residuals;
    drive::Jacobian jacobian;
    predictor.evaluate(values.data(), residuals, &jacobian);
    ASSERT_EQ(residuals.size(), static_cast<Eigen::Index>(drive::samples_of(records)));
    ASSERT_EQ(jacobian.rows(), residuals.size());
    ASSERT_EQ(jacobian.cols(), static_cast<Eigen::Index>(values.size()));
    Eigen::VectorXd alone;
    predictor.evaluate(values.data(), alone, nullptr);
    EXPECT_LT((alone - residuals).cwiseAbs().maxCoeff(), 1e-7);
    for (std::size_t p = 0; p < values.size(); ++p) {
        const double value = values[p];
        constexpr double by = 1e-4;
        Eigen::VectorXd up;
        Eigen::VectorXd down;
        values[p] = value + by;
        predictor.evaluate(values.data(), up, nullptr);
        values[p] = value - by;
        predictor.evaluate(values.data(), down, nullptr);
        values[p] = value;
        const Eigen::VectorXd slope = (up - down) / (2.0 * by);
        const auto column = jacobian.col(static_cast<Eigen::Index>(p));
        EXPECT_GT(slope.cwiseAbs().maxCoeff(), 0.01);
        EXPECT_LT((slope - column).cwiseAbs().maxCoeff(), 1e-4 * (1.0 + slope.cwiseAbs().maxCoeff()))
            << form.parameters()[predictor.free()[p]].name;
    }
}

TEST(Predictor, KnowsTheSlopeByEachParameter) {
    expect_slopes(free_form(Kind::fotf, with_zero()), {open_record()});
    expect_slopes(free_form(Kind::fopdt, drive::make_fopdt(1.5, 0.7, 0.213)), {open_record()});
    expect_slopes(free_form(Kind::sopdt, drive::make_sopdt(-1.5, 0.4, 0.213)), {open_record(), open_record()});
}

TEST(Predictor, KnowsTheSlopeByEachParameterInALoop) {
    expect_slopes(free_form(Kind::fotf, with_zero()), {looped_record()});
    expect_slopes(free_form(Kind::sopdt, drive::make_sopdt(1.5, 0.4, 0.213)), {open_record(), looped_record()});
}

// What is simulated less what was measured, the offset included.
TEST(Predictor, LeavesTheSimulatedLessTheMeasured) {
    Form form = free_form(Kind::fotf, with_zero());
    form.parameter("offset").value = 0.25;
    for (const Record& record : {open_record(), looped_record()}) {
        const std::vector<Record> records{record};  // which the predictor refers to
        const drive::Predictor predictor(form, records);
        Eigen::VectorXd residuals;
        predictor.evaluate(free_values(predictor, form).data(), residuals, nullptr);
        const std::vector<double> simulated = drive::respond_to(with_zero(), record, 0.25);
        for (std::size_t i = 0; i < record.output.size(); ++i) {
            EXPECT_NEAR(residuals(static_cast<Eigen::Index>(i)), simulated[i] - record.output[i], 1e-7) << i;
        }
    }
}

}  // namespace
