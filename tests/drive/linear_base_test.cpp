// A linear base against its closed form: what it leaves of a record of its own, where a fit begins, what it finds.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "drive/stand/blind/refit.hpp"

namespace {

using stand::blind::EvenRecord;
using stand::blind::LinearBase;

constexpr double step_s = 0.05;

// Held levels that begin at rest, none twice as long as another.
std::vector<double> levels() {
    std::vector<double> input;
    std::size_t hold = 7;
    for (const double level : {1.0, 0.25, 0.75, -0.5, 0.0, 1.25, 0.5, 1.0, -1.0, 0.25}) {
        input.insert(input.end(), hold, level);
        hold += 6;
    }
    return input;
}

// Each change of the input is a step: of two poles s1 and s2, 1 + (s2 e^(s1 t) - s1 e^(s2 t)) / (s1 - s2), and the lead
// T times its slope.
EvenRecord record_of(const LinearBase& base, std::size_t from = 0) {
    const std::complex<double> root = std::sqrt(std::complex<double>(base.damping * base.damping - 1.0));
    const auto s1 = (-base.damping + root) / base.time_s;
    const auto s2 = (-base.damping - root) / base.time_s;
    EvenRecord record;
    record.from = from;
    record.input = levels();
    for (std::size_t k = 0; k < record.input.size(); ++k) {
        double output = base.offset;
        double before = 0.0;
        for (std::size_t j = 0; j < k; ++j) {
            const double change = record.input[j] - before;
            before = record.input[j];
            const double t = static_cast<double>(k - j) * step_s - base.delay_s;
            if (change != 0.0 && t > 0.0) {
                const auto place = 1.0 + (s2 * std::exp(s1 * t) - s1 * std::exp(s2 * t)) / (s1 - s2);
                const auto lead = base.time_s * s1 * s2 * (std::exp(s1 * t) - std::exp(s2 * t)) / (s1 - s2);
                output += change * (base.gain * place.real() + base.lead_gain * lead.real());
            }
        }
        record.output.push_back(k < from ? 1e3 : output);  // what is not logged does not count
    }
    return record;
}

LinearBase made(double time_s, double damping, double delay_s, double gain = 2.0, double lead_gain = 0.5) {
    return {time_s, damping, delay_s, 0.25, gain, lead_gain};
}

TEST(LinearBase, LeavesNothingOfItsOwnRecord) {
    for (const double damping : {0.2, 0.9, 3.0}) {
        for (const double delay_s : {0.0, 0.1, 0.13, 0.02, 1.0}) {  // a dead time need not be whole steps
            const LinearBase base = made(0.7, damping, delay_s);
            EXPECT_LT(stand::blind::misfit(base, std::vector{record_of(base), record_of(base, 40)}, step_s), 1e-10)
                << damping << ' ' << delay_s;
        }
    }
}

// A swing of 150 radians a step, too: six terms of Taylor's, of a 4096th of the step, leave 1e-10 of it.
TEST(LinearBase, IsAsExactHoweverFewTheSamples) {
    const LinearBase base = made(step_s / 150.0, 0.02, 0.0);
    EXPECT_LT(stand::blind::misfit(base, std::vector{record_of(base)}, step_s), 1e-10);
}

// As the root of the mean square, over all records' samples alike.
TEST(LinearBase, MissesByTheRootOfTheMeanSquare) {
    const LinearBase base = made(0.7, 0.9, 0.1);
    std::vector<EvenRecord> records{record_of(base, 10), record_of(base, 41)};
    const double first = static_cast<double>(records[0].output.size() - 10);
    const double second = static_cast<double>(records[1].output.size() - 41);
    for (double& value : records[1].output) {
        value += 0.5;
    }
    EXPECT_NEAR(stand::blind::misfit(base, records, step_s), 0.5 * std::sqrt(second / (first + second)), 1e-11);
}

// What is on the grid is found there, with its gains by least squares.
TEST(LinearBase, BeginsAtTheBestOfItsGrid) {
    const double tau_s = 0.8;
    for (const double time : {0.15, 0.3, 0.6, 1.0, 1.8}) {
        for (const double damping : {0.3, 0.7, 1.2, 2.5}) {
            for (const double delay : {0.0, 0.1, 0.25, 0.5, 1.0}) {
                const LinearBase base = made(time * tau_s, damping, delay * tau_s);
                const LinearBase found = stand::blind::start_of(std::vector{record_of(base, 3)}, step_s, tau_s);
                EXPECT_EQ(found.time_s, base.time_s);
                EXPECT_EQ(found.damping, damping);
                EXPECT_EQ(found.delay_s, base.delay_s);
                EXPECT_NEAR(found.gain, 2.0, 1e-6);
                EXPECT_NEAR(found.lead_gain, 0.5, 1e-6);
                EXPECT_NEAR(found.offset, 0.25, 1e-6);
            }
        }
    }
}

TEST(LinearBase, IsFoundBesideTheGrid) {
    const LinearBase base = made(0.9, 0.5, 0.23, -3.0, -0.75);
    const LinearBase found = stand::blind::fit_base(std::vector{record_of(base)}, step_s, 0.8);
    EXPECT_NEAR(found.time_s, 0.9, 0.02);
    EXPECT_NEAR(found.damping, 0.5, 0.02);
    EXPECT_NEAR(found.delay_s, 0.23, 0.01);
    EXPECT_NEAR(found.gain, -3.0, 0.02);
    EXPECT_NEAR(found.lead_gain, -0.75, 0.03);
    EXPECT_NEAR(found.offset, 0.25, 0.02);
    EXPECT_LT(stand::blind::misfit(found, std::vector{record_of(base)}, step_s), 0.01);
    // In other units, too.
    EvenRecord other = record_of(base);
    for (double& value : other.output) {
        value = 1e-6 * value + 5.0;
    }
    const LinearBase scaled = stand::blind::fit_base(std::vector{other}, step_s, 0.8);
    EXPECT_NEAR(scaled.gain, 1e-6 * found.gain, 1e-9);
    EXPECT_NEAR(scaled.offset, 5.0 + 1e-6 * found.offset, 1e-9);
}

// No less damped than 0.05, and no earlier than its input.
TEST(LinearBase, KeepsToWhatAPlantCanBe) {
    const LinearBase swings = made(0.9, 0.02, 0.1);
    const LinearBase found = stand::blind::fit_base(std::vector{record_of(swings)}, step_s, 0.9);
    EXPECT_EQ(found.damping, 0.05);
    const LinearBase prompt = made(0.9, 0.8, 0.0);
    EXPECT_GE(stand::blind::fit_base(std::vector{record_of(prompt)}, step_s, 0.9).delay_s, 0.0);
}

}  // namespace
