// A model's step against the recurrence that its header states, written plainly in double: every sign, table, delay,
// format, and what a state held before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "glsum/model/controller.hpp"
#include "glsum/model/stepper.hpp"

namespace {

using glsum::Gain;
using glsum::Mode;
using glsum::ModelDesign;
using glsum::PastTable;
using glsum::Status;
using glsum::Stepper;

using Full = glsum::Sum<glsum::Ring, glsum::Oldest, glsum::F64>;
using Single = glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>;
using Fixed = glsum::Sum<glsum::Ring, glsum::Plain, glsum::Q31>;
using Modes = glsum::Sum<glsum::Modes, glsum::Plain, glsum::F32>;
using Carried = glsum::Sum<glsum::Modes, glsum::Compensated, glsum::F32>;
using FixedModes = glsum::Sum<glsum::Modes, glsum::Plain, glsum::Q31>;

// The weight of x_(k-1-j) in a table's sum.
double weight_of(const PastTable& table, std::size_t j) {
    if (j == 0) {
        return 1.0;
    }
    if (j <= table.ratios.size()) {
        return table.ratios[j - 1];
    }
    double sum = 0.0;
    for (const Mode& mode : table.modes) {
        sum += mode.weight * std::pow(1.0 - mode.decay, static_cast<double>(j - table.ratios.size() - 1));
    }
    return sum;
}

//   x_k = input u_(k-1-d) - constant y_(k-1) - sum_i factor_i S_i,     y_k = y_(k-1) + x_k  or  x_k
std::vector<double> by_definition(const ModelDesign& design, const std::vector<double>& input) {
    std::vector<double> x;
    std::vector<double> y;
    const auto u = [&](std::size_t k, std::size_t back) { return k >= back ? input[k - back] : 0.0; };
    for (std::size_t k = 0; k < input.size(); ++k) {
        const double before = u(k, design.delay + 1);
        const double acting = design.half_input ? 0.5 * (before + u(k, design.delay)) : before;
        double newest = design.input * acting;
        if (design.increments) {
            newest -= design.constant * (k > 0 ? y.back() : 0.0);
        }
        for (const PastTable& table : design.tables) {
            for (std::size_t j = 0; j < k; ++j) {
                newest -= table.factor * weight_of(table, j) * x[k - 1 - j];
            }
        }
        y.push_back(newest + (design.increments && k > 0 ? y.back() : 0.0));
        x.push_back(newest);
    }
    return y;
}

template <class K>
struct Stepped {
    std::vector<double> output;
    std::uint32_t saturations;
};

template <class K>
Stepped<K> stepped(const ModelDesign& design, const std::vector<double>& input) {
    using Model = Stepper<K>;
    std::size_t coefficients = 0;
    std::size_t samples = 0;
    for (const PastTable& table : design.tables) {
        coefficients += Model::table_count(table);
        samples += Model::past_count(table);
    }
    std::vector<typename K::Coefficient> table(coefficients);
    std::vector<typename K::Sample> past(samples);
    const std::size_t waiting = Model::line_count(design.delay);
    std::vector<typename K::Sample> line(waiting + 1);
    // On a microcontroller a state may lie anywhere and begin as anything.
    typename Model::State state;
    std::memset(static_cast<void*>(&state), 0xa5, sizeof state);
    std::memset(static_cast<void*>(table.data()), 0xa5, coefficients * sizeof table[0]);
    std::memset(static_cast<void*>(past.data()), 0xa5, samples * sizeof past[0]);
    std::memset(static_cast<void*>(line.data()), 0xa5, line.size() * sizeof line[0]);
    const typename K::Sample behind = line.back();
    EXPECT_EQ(Model::prepare(state, design, table, past, std::span(line).first(waiting)), Status::ok);
    Stepped<K> found;
    for (const double u : input) {
        found.output.push_back(Model::to_real(design, Model::step(state, Model::from_real(design, u))));
    }
    EXPECT_EQ(std::memcmp(&line.back(), &behind, sizeof behind), 0);  // nobody's sample behind the line
    found.saturations = state.saturations;
    return found;
}

template <class K>
void expect_stepped(const ModelDesign& design, double within) {
    std::mt19937_64 generator(3);
    std::vector<double> input;
    for (int k = 0; k < 120; ++k) {
        input.push_back(k < 2 ? 0.75 : 1.5 * (static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5));
    }
    const std::vector<double> expected = by_definition(design, input);
    const auto found = stepped<K>(design, input);
    EXPECT_EQ(found.saturations, 0U);
    for (std::size_t k = 0; k < input.size(); ++k) {
        ASSERT_NEAR(found.output[k], expected[k], within) << K::name() << " at " << k;
    }
}

const std::vector<double> one = {0.5, -0.25, 0.125};
const std::vector<double> two = {-0.75};
const std::vector<double> three = {0.25, 0.25};
const std::vector<double> none;

TEST(Stepper, IsItsRecurrence) {
    for (const bool increments : {false, true}) {
        for (const bool half_input : {false, true}) {
            for (const std::uint32_t delay : {0U, 1U, 4U}) {
                for (const double sign : {1.0, -1.0}) {
                    const std::vector<PastTable> tables{
                        {0.2 * sign, one}, {-0.1 * sign, two}, {0.15, three}, {-0.05, none}};
                    for (std::size_t count = 0; count <= tables.size(); ++count) {
                        const ModelDesign design{.increments = increments,
                                                 .half_input = half_input,
                                                 .delay = delay,
                                                 .input = 0.3 * sign,
                                                 .constant = increments ? 0.2 : 0.0,
                                                 .input_full_scale = 2.0,
                                                 .stored_full_scale = 1.0,
                                                 .output_full_scale = 8.0,
                                                 .tables = std::span(tables).first(count)};
                        expect_stepped<Full>(design, 1e-14);
                        expect_stepped<Single>(design, 2e-6);
                        expect_stepped<Fixed>(design, 3e-8);
                    }
                }
            }
        }
    }
}

TEST(Stepper, TakesAConstantOfEitherSign) {
    const std::vector<PastTable> tables{{-0.2, one}};
    for (const double constant : {0.25, -0.01}) {
        const ModelDesign design{.input = 0.1,
                                 .constant = constant,
                                 .input_full_scale = 1.0,
                                 .stored_full_scale = 0.5,
                                 .output_full_scale = 4.0,
                                 .tables = tables};
        expect_stepped<Full>(design, 1e-14);
        expect_stepped<Fixed>(design, 3e-8);
    }
}

TEST(Stepper, KeepsModesBehindATable) {
    const std::vector<Mode> slow = {{0.01, 0.002}, {0.2, 0.05}};
    const std::vector<PastTable> tables{{-0.3, two, slow}};
    for (const bool increments : {false, true}) {
        const ModelDesign design{.increments = increments,
                                 .half_input = true,
                                 .delay = 2,
                                 .input = 0.2,
                                 .constant = increments ? 0.1 : 0.0,
                                 .input_full_scale = 2.0,
                                 .stored_full_scale = 1.0,
                                 .output_full_scale = 2.0,
                                 .tables = tables};
        expect_stepped<Modes>(design, 2e-6);
        expect_stepped<Carried>(design, 1e-6);
        expect_stepped<FixedModes>(design, 3e-8);
    }
}

// y of a kernel that compensates carries what its additions lose: beside a large y small increments do not vanish.
TEST(Stepper, CarriesWhatAnAdditionLost) {
    const std::vector<Mode> slow = {{0.01, 0.0}};
    const std::vector<PastTable> tables{{0.0, none, slow}};
    const ModelDesign design{.input = 1.0, .constant = 0.0, .tables = tables};
    std::vector<double> input(20'001, 0x1p-26);
    input[0] = 1.0;
    EXPECT_EQ(stepped<Modes>(design, input).output.back(), 1.0);
    EXPECT_NEAR(stepped<Carried>(design, input).output.back(), 1.0 + 19'999 * 0x1p-26, 0x1p-23);
    std::replace(input.begin(), input.end(), 0x1p-26, -0x1p-26);
    EXPECT_NEAR(stepped<Carried>(design, input).output.back(), 1.0 - 19'999 * 0x1p-26, 0x1p-23);
}

// In fixed point each product that leaves the scale is counted, and so is their sum; what is stored stays at its end.
TEST(Stepper, CountsWhatItSaturates) {
    const ModelDesign loud{.increments = false, .input = 4.0, .tables = {}};
    const auto one_product = stepped<Fixed>(loud, std::vector<double>(5, 0.75));
    EXPECT_EQ(one_product.saturations, 4U);
    EXPECT_NEAR(one_product.output.back(), 1.0, 1e-9);
    // 0.75 u and 0.75 x: no product is too large, their sum is.
    const std::vector<PastTable> tables{{-0.75, none}};
    const ModelDesign growing{.increments = false, .input = 0.75, .tables = tables};
    const auto sums = stepped<Fixed>(growing, std::vector<double>(4, 0.9));
    EXPECT_NEAR(sums.output[1], 0.675, 1e-8);
    EXPECT_NEAR(sums.output[2], 1.0, 1e-8);  // 1.18
    EXPECT_EQ(sums.saturations, 2U);
    // y is exact in 64 bits and may grow beyond any scale.
    const ModelDesign summing{.input = 0.5, .constant = 0.0, .tables = {}};
    EXPECT_NEAR(stepped<Fixed>(summing, std::vector<double>(101, 0.75)).output.back(), 37.5, 1e-6);
}

// A constant of 0 takes nothing from a large y: in q31, too, y grows by exactly the half of what the input is.
TEST(Stepper, AFactorOfNothingTakesNothing) {
    const ModelDesign design{.input = 0.5, .constant = 0.0, .tables = {}};
    using Model = Stepper<Fixed>;
    std::vector<std::int32_t> line(1);
    typename Model::State state{};
    ASSERT_EQ(Model::prepare(state, design, {}, {}, line), Status::ok);
    for (std::int64_t k = 0; k < 20; ++k) {
        EXPECT_EQ(Model::step(state, 1 << 30), k << 29) << k;
    }
}

TEST(Stepper, MeansOfInputsAreRoundedDown) {
    const ModelDesign design{.increments = false, .half_input = true, .input = 1.0, .tables = {}};
    using Model = Stepper<Fixed>;
    std::vector<std::int32_t> line(1);
    typename Model::State state{};
    ASSERT_EQ(Model::prepare(state, design, {}, {}, line), Status::ok);
    EXPECT_EQ(Model::step(state, 3), 1);
    EXPECT_EQ(Model::step(state, 2'147'483'647), 1'073'741'825);
    EXPECT_EQ(Model::step(state, 2'147'483'647), 2'147'483'647);  // no sum that overflows
    EXPECT_EQ(Model::step(state, -2'147'483'647 - 1), -1);
    EXPECT_EQ(Model::step(state, -2'147'483'647 - 1), -2'147'483'647 - 1);
}

TEST(Stepper, RefusesWhatDoesNotFit) {
    using Model = Stepper<Full>;
    typename Model::State state{};
    std::vector<double> line(3);
    std::vector<double> table(50);
    std::vector<double> past(50);
    const std::vector<PastTable> five(5, {0.1, one});
    const ModelDesign delayed{.delay = 2, .tables = std::span(five).first(4)};
    EXPECT_EQ(Model::prepare(state, delayed, table, past, line), Status::ok);
    EXPECT_EQ(Model::prepare(state, delayed, table, past, std::span(line).first(2)), Status::past_too_small);
    EXPECT_EQ(Model::prepare(state, {.tables = five}, table, past, line), Status::no_taps);
    // Each table has its own place behind the one before.
    std::size_t coefficients = 0;
    std::size_t samples = 0;
    for (const PastTable& one_table : delayed.tables) {
        coefficients += Model::table_count(one_table);
        samples += Model::past_count(one_table);
    }
    EXPECT_EQ(
        Model::prepare(state, delayed, std::span(table).first(coefficients), std::span(past).first(samples), line),
        Status::ok);
    EXPECT_EQ(Model::prepare(state, delayed, std::span(table).first(coefficients - 1), past, line),
              Status::table_too_small);
    EXPECT_EQ(Model::prepare(state, delayed, table, std::span(past).first(samples - 1), line), Status::past_too_small);
    const std::vector<double> endless = {INFINITY};
    const std::vector<PastTable> bad{{0.1, endless}};
    EXPECT_EQ(Model::prepare(state, {.tables = bad}, table, past, line), Status::weights_out_of_range);
}

// A controller adds its increments up and stays within its limits; a state that held something else begins at 0.
TEST(ControllerStep, BeginsAtZeroWhateverItHeld) {
    using Line = glsum::Controller<Full>;
    const std::vector<double> ratios = {-0.5};
    glsum::ControllerDesign design;
    design.first = 0.25;
    design.low = -0.5;
    design.high = 0.75;
    design.ratios = ratios;
    std::vector<double> table(Full::table_count(design.design().taps));
    std::vector<double> past(Full::past_count(design.design().taps));
    typename Line::State state;
    std::memset(static_cast<void*>(&state), 0xa5, sizeof state);
    ASSERT_EQ(Line::prepare(state, design, table, past), Status::ok);
    EXPECT_EQ(Line::step(state, 1.0), 0.25);
    EXPECT_EQ(Line::step(state, 1.0), 0.375);  // 0.25 (1 - 0.5) more
    EXPECT_EQ(Line::step(state, 2.0), 0.75);   // 0.75 to the bit: allowed
    EXPECT_EQ(Line::step(state, 2.0), 0.75);
    EXPECT_EQ(Line::step(state, -9.0), -0.5);
    EXPECT_EQ(Line::step(state, 0.0), 0.625);  // from the limit, not from where it would have been
    EXPECT_EQ(Line::prepare(state, design, std::span(table).first(0), past), Status::table_too_small);
}

TEST(Stepper, ItsDesignsAreNothingByThemselves) {
    const ModelDesign model;
    EXPECT_TRUE(model.increments);
    EXPECT_FALSE(model.half_input);
    EXPECT_EQ(model.delay, 0U);
    EXPECT_EQ(model.input, 1.0);
    EXPECT_EQ(model.constant, 0.0);
    EXPECT_EQ(model.input_full_scale, 1.0);
    EXPECT_EQ(model.stored_full_scale, 1.0);
    EXPECT_EQ(model.output_full_scale, 1.0);
    EXPECT_TRUE(model.tables.empty());
    const glsum::ControllerDesign controller;
    EXPECT_EQ(controller.first, 1.0);
    EXPECT_EQ(controller.low, -INFINITY);
    EXPECT_EQ(controller.high, INFINITY);
    EXPECT_TRUE(controller.modes.empty());
    EXPECT_EQ(glsum::most_tables, 4U);
    // A table of so many ratios and modes has a tap more than the ratios, and two for each mode.
    const std::vector<Mode> slow(3, Mode{0.1, 0.01});
    const PastTable table{0.5, one, slow};
    EXPECT_EQ(table.design().taps, 3U + 1U + 6U);
    EXPECT_EQ(Stepper<Modes>::table_count(table), 9U);
    EXPECT_EQ(Stepper<Modes>::past_count(table), 3U + 3U);
    // Multiplications: those of the sums, one for each of them, for the input, and for y where it has a share.
    ModelDesign counted{.tables = std::span(&table, 1)};
    EXPECT_EQ(Stepper<Modes>::multiplications(counted), 9U + 1U + 1U);
    counted.constant = 0.5;
    EXPECT_EQ(Stepper<Modes>::multiplications(counted), 9U + 1U + 2U);
    counted.increments = false;
    EXPECT_EQ(Stepper<Modes>::multiplications(counted), 9U + 1U + 1U);
    // In fixed point an input is a fraction of its full scale, an output a multiple of the stored one's.
    ModelDesign scaled;
    scaled.input_full_scale = 4.0;
    scaled.stored_full_scale = 0.5;
    EXPECT_EQ(Stepper<Fixed>::from_real(scaled, 1.0), 1 << 29);
    EXPECT_EQ(Stepper<Fixed>::to_real(scaled, std::int64_t{1} << 31), 0.5);
    EXPECT_EQ(Stepper<Single>::from_real(scaled, 1.0), 1.0F);
    EXPECT_EQ(Stepper<Single>::to_real(scaled, 0.25F), 0.25);
}

}  // namespace
