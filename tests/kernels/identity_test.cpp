// Identities of the sum that every kernel must satisfy within its own bound.
#include <Eigen/Core>
#include <cmath>
#include <random>

#include "tests/kernels/any_kernel.hpp"

namespace {

class IdentityTest : public test::EveryKernel {};
INSTANTIATE_TEST_SUITE_P(, IdentityTest, testing::ValuesIn(test::any_kernels()), test::name_of);

std::vector<double> noise(std::size_t samples, double peak) {
    std::mt19937_64 generator(samples);
    std::vector<double> x(samples);
    for (double& sample : x) {
        sample = peak * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
    }
    return x;
}

// Semi-group: v and then -v give the input back. The middle is scaled by 1/4, so that it fits every format's sample.
TEST_P(IdentityTest, AnOrderAndItsNegativeCancel) {
    constexpr std::size_t samples = 150;
    for (const double order : {0.3, 0.5, 0.9, 1.0, -0.5, -0.98319}) {
        if (!kernel.order_in_range(order) || !kernel.order_in_range(-order)) {
            continue;
        }
        const auto there = kernel.line({order, samples});
        const auto back = kernel.line({-order, samples});
        const auto x = noise(samples, order > 0.0 ? 0.9 : 0.02);
        const double middle_peak = 0.25 * glsum::absolute_sum(order, samples) * (order > 0.0 ? 0.9 : 0.02);
        ASSERT_LT(middle_peak, 1.0);
        const double allowed = 4.0 * back->bound({-order, samples}, middle_peak, samples) +
                               there->bound({order, samples}, 0.9, samples) * glsum::absolute_sum(-order, samples);
        for (std::size_t k = 0; k < samples; ++k) {
            const double middle = 0.25 * there->step(x[k]);
            ASSERT_NEAR(4.0 * back->step(middle), x[k], allowed) << "order " << order << ", k " << k;
        }
    }
}

// The matrix form (4) of [Matusiak2020]: one row of weights times the column of samples; all rows at once are a lower
// triangular Toeplitz matrix.
TEST_P(IdentityTest, EqualsTheMatrixForm) {
    constexpr Eigen::Index samples = 90;
    for (const double order : {0.5, 0.98319, 1.9909, -0.5}) {
        for (const Eigen::Index taps : {1, 7, 40, 90}) {
            Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(samples, samples);
            glsum::Weights weights(order);
            double weight = 1.0;
            for (Eigen::Index j = 0; j < taps; ++j) {
                matrix.diagonal(-j).setConstant(weight);
                weights.next();
                weight = weights.weight();
            }
            if (!kernel.takes_zero()) {
                // What it makes of the dropped samples changes from row to row.
                matrix.setZero();
                for (Eigen::Index k = 0; k < samples; ++k) {
                    const auto row = reference::weights_of(kernel.dropped, {order, static_cast<std::size_t>(taps)},
                                                           static_cast<std::size_t>(k) + 1);
                    for (Eigen::Index j = 0; j <= k; ++j) {
                        matrix(k, k - j) = static_cast<double>(row[static_cast<std::size_t>(j)]);
                    }
                }
            }
            const auto x = noise(samples, 0.9);
            const Eigen::VectorXd sums = matrix * Eigen::Map<const Eigen::VectorXd>(x.data(), samples);
            const glsum::Design design{order, static_cast<std::size_t>(taps)};
            const auto line = kernel.line(design);
            const double bound = line->bound(design, 0.9, samples) + 1e-13;
            for (Eigen::Index k = 0; k < samples; ++k) {
                ASSERT_NEAR(line->step(x[static_cast<std::size_t>(k)]), sums[k], bound)
                    << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

// Inputs that die out into denormal numbers, and zeros after them: nothing sticks, nothing becomes NaN.
TEST_P(IdentityTest, DenormalInputsStayWithinTheBound) {
    constexpr std::size_t taps = 40;
    const auto line = kernel.line({0.5, taps});
    double x = 64.0 * kernel.smallest_sample;
    std::vector<double> past;
    for (std::size_t k = 0; k < 3 * taps; ++k, x *= 0.75) {
        // Rounded to a sample of floating point; behind the window zeros.
        past.push_back(kernel.fixed_point ? x
                       : k < taps         ? std::nearbyint(x / kernel.smallest_sample) * kernel.smallest_sample
                                          : 0.0);
        glsum::Weights weights(0.5);
        double expected = past[k];
        for (std::size_t j = 1; j < std::min(taps, k + 1); ++j) {
            weights.next();
            expected += weights.weight() * past[k - j];
        }
        if (!kernel.takes_zero()) {
            expected = kernel.exact_sums({0.5, taps}, past).back().high;
        }
        ASSERT_NEAR(line->step(past[k]), expected, line->bound({0.5, taps}, 64.0 * kernel.smallest_sample, 3 * taps))
            << k;
    }
    for (std::size_t k = 0; k < taps; ++k) {
        line->step(0.0);
    }
    if (kernel.dropped != reference::Dropped::line) {  // it ends in x_0
        ASSERT_EQ(line->step(0.0), 0.0);
    }
}

// A change of order in mid-stream, as variable-order models make it: prepare forgets the past and takes the new table.
TEST_P(IdentityTest, AChangeOfOrderStartsAfresh) {
    const auto changed = kernel.line({1.9909, 60});
    for (const double sample : noise(100, 0.9)) {
        changed->step(sample);
    }
    ASSERT_EQ(changed->prepare({0.3, 45}), glsum::Status::ok);
    const auto fresh = kernel.line({0.3, 45});
    for (const double sample : noise(100, 0.5)) {
        ASSERT_EQ(changed->step(sample), fresh->step(sample));
    }
}

}  // namespace
