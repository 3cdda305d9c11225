// A descent at its bounds: the others go on without what is held there, and what leads inside again is let go.
#include "drive/descend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "drive/response.hpp"

namespace {

using drive::Attempt;
using drive::Form;
using drive::Kind;
using drive::Model;
using drive::Record;

// A lightly damped second order after a pulse, with noise.
Model ringing(double delay_s) {
    Model model;
    model.kind = Kind::fotf;
    model.denominator = {{0.02, 2.0}, {0.02, 1.0}, {1.0, 0.0}};
    model.delay_s = delay_s;
    return model;
}

Record pulsed(const Model& model) {
    Record record;
    record.name = "pulse";
    record.changes = {{0.5, 1.0}, {6.0, -1.0}};
    for (int k = 0; k < 400; ++k) {
        record.time_s.push_back(0.025 * k);
    }
    record.output = drive::respond(model, record.changes, record.time_s);
    std::mt19937_64 random(11);
    for (double& y : record.output) {
        y += 0.01 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
    }
    return record;
}

// Whose response would be better still a little earlier than its input: the dead time ends at 0, and all others where
// they end without one.
TEST(Descend, GoesOnWithoutWhatIsHeldAtItsBound) {
    const Record full = pulsed(ringing(0.0));
    Record early = full;
    for (drive::Change& change : early.changes) {
        change.time_s += 2e-4;
    }
    const std::vector<Record> records{early};
    Form form(Kind::niopdt, ringing(0.01));
    const drive::Predictor predictor(form, records);
    std::vector<double> start;
    for (const std::size_t i : predictor.free()) {
        start.push_back(form.parameters()[i].value);
    }
    const Attempt attempt = drive::descend(form, predictor, start, {}, {});
    ASSERT_TRUE(attempt.ended);
    EXPECT_EQ(attempt.stopped, "nothing better is near");
    EXPECT_EQ(form.to_model(predictor.all_values(attempt.values.data())).delay_s, 0.0);
    for (drive::Parameter& parameter : form.parameters()) {
        if (parameter.name == "delay_s") {
            parameter.value = 0.0;
            parameter.fixed = true;
        }
    }
    const drive::Predictor without(form, records);
    start.clear();
    for (const std::size_t i : without.free()) {
        start.push_back(form.parameters()[i].value);
    }
    const Attempt least = drive::descend(form, without, start, {}, {});
    ASSERT_TRUE(least.ended);
    EXPECT_NEAR(attempt.sum_of_squares / least.sum_of_squares, 1.0, 1e-7);
    EXPECT_LT(attempt.iterations, 60);
}

// Wherever it begins, a descent ends where no parameter at a bound leads inside.
TEST(Descend, LetsGoWhatLeadsInside) {
    const std::vector<Record> records{pulsed(ringing(0.06))};
    const Form form(Kind::niopdt, ringing(0.06));
    const drive::Predictor predictor(form, records);
    std::mt19937_64 random(5);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    int arrived = 0;
    for (int k = 0; k < 6; ++k) {
        std::vector<double> start;
        for (const std::size_t i : predictor.free()) {
            const drive::Parameter& parameter = form.parameters()[i];
            const double value =
                parameter.name == "delay_s" ? 0.0 : parameter.value * std::exp(0.5 * (uniform() - 0.5));
            start.push_back(std::clamp(value, parameter.lower, parameter.upper));
        }
        const Attempt attempt = drive::descend(form, predictor, start, {}, {});
        if (!attempt.ended || !std::isfinite(attempt.sum_of_squares)) {
            continue;
        }
        Eigen::VectorXd residuals;
        drive::Jacobian jacobian;
        predictor.evaluate(attempt.values.data(), residuals, &jacobian);
        EXPECT_NEAR(residuals.squaredNorm() / attempt.sum_of_squares, 1.0, 1e-7);
        for (std::size_t p = 0; p < attempt.values.size(); ++p) {
            const drive::Parameter& parameter = form.parameters()[predictor.free()[p]];
            const auto column = jacobian.col(static_cast<Eigen::Index>(p));
            const double slope = column.dot(residuals) / column.norm() / residuals.norm();
            if (attempt.values[p] <= parameter.lower) {
                EXPECT_GT(slope, -1e-4) << k << ' ' << parameter.name;
            } else if (attempt.values[p] >= parameter.upper) {
                EXPECT_LT(slope, 1e-4) << k << ' ' << parameter.name;
            }
        }
        arrived += attempt.sum_of_squares < 400 * 1e-4 / 12.0 * 1.2 ? 1 : 0;
    }
    EXPECT_GE(arrived, 3);
}

}  // namespace
