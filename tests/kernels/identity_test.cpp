// Identities of the sum that every kernel must satisfy within its own bound.
#include <Eigen/Core>
#include <cmath>
#include <random>

#include "glsum/bound.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using test::Line;

template <class K>
class IdentityTest : public testing::Test {};
TYPED_TEST_SUITE(IdentityTest, test::Kernels, test::KernelNames);

std::vector<double> noise(std::size_t samples, double peak) {
    std::mt19937_64 generator(samples);
    std::vector<double> x(samples);
    for (double& sample : x) {
        sample = peak * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
    }
    return x;
}

// Semi-group: v and then -v give the input back. The middle is scaled by 1/4, so that it fits every format's sample.
TYPED_TEST(IdentityTest, AnOrderAndItsNegativeCancel) {
    constexpr std::size_t samples = 150;
    for (const double order : {0.3, 0.5, 0.9, 1.0, -0.5, -0.98319}) {
        if (!TypeParam::order_in_range(order) || !TypeParam::order_in_range(-order)) {
            continue;
        }
        Line<TypeParam> there({order, samples});
        Line<TypeParam> back({-order, samples});
        const auto x = noise(samples, order > 0.0 ? 0.9 : 0.02);
        const double middle_peak = 0.25 * glsum::absolute_sum(order, samples) * (order > 0.0 ? 0.9 : 0.02);
        ASSERT_LT(middle_peak, 1.0);
        const double allowed =
            4.0 * glsum::error_bound<TypeParam>({-order, samples}, back.state(), middle_peak, samples) +
            glsum::error_bound<TypeParam>({order, samples}, there.state(), 0.9, samples) *
                glsum::absolute_sum(-order, samples);
        for (std::size_t k = 0; k < samples; ++k) {
            const double middle = 0.25 * there.step_real(x[k]);
            ASSERT_NEAR(4.0 * back.step_real(middle), x[k], allowed) << "order " << order << ", k " << k;
        }
    }
}

// The matrix form (4) of [Matusiak2020]: one row of weights times the column of samples; all rows at once are a lower
// triangular Toeplitz matrix.
TYPED_TEST(IdentityTest, EqualsTheMatrixForm) {
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
            if constexpr (!test::takes_zero<TypeParam>) {
                // What it makes of the dropped samples changes from row to row.
                matrix.setZero();
                for (Eigen::Index k = 0; k < samples; ++k) {
                    const auto row =
                        reference::weights_of(reference::dropped_by<typename TypeParam::HistoryPart>(),
                                              {order, static_cast<std::size_t>(taps)}, static_cast<std::size_t>(k) + 1);
                    for (Eigen::Index j = 0; j <= k; ++j) {
                        matrix(k, k - j) = static_cast<double>(row[static_cast<std::size_t>(j)]);
                    }
                }
            }
            const auto x = noise(samples, 0.9);
            const Eigen::VectorXd sums = matrix * Eigen::Map<const Eigen::VectorXd>(x.data(), samples);
            const glsum::Design design{order, static_cast<std::size_t>(taps)};
            Line<TypeParam> line(design);
            const double bound = glsum::error_bound<TypeParam>(design, line.state(), 0.9, samples) + 1e-13;
            for (Eigen::Index k = 0; k < samples; ++k) {
                ASSERT_NEAR(line.step_real(x[static_cast<std::size_t>(k)]), sums[k], bound)
                    << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

// Inputs that die out into denormal numbers, and zeros after them: nothing sticks, nothing becomes NaN.
TYPED_TEST(IdentityTest, DenormalInputsStayWithinTheBound) {
    constexpr std::size_t taps = 40;
    using Sample = typename TypeParam::Sample;
    double smallest = 0x1p-31;
    if constexpr (!TypeParam::FormatPart::fixed_point) {
        smallest = static_cast<double>(std::numeric_limits<Sample>::denorm_min());
    }
    Line<TypeParam> line({0.5, taps});
    double x = 64.0 * smallest;
    std::vector<double> past;
    for (std::size_t k = 0; k < 3 * taps; ++k, x *= 0.75) {
        past.push_back(TypeParam::FormatPart::fixed_point ? x
                       : k < taps                         ? static_cast<double>(static_cast<Sample>(x))
                                                          : 0.0);
        glsum::Weights weights(0.5);
        double expected = past[k];
        for (std::size_t j = 1; j < std::min(taps, k + 1); ++j) {
            weights.next();
            expected += weights.weight() * past[k - j];
        }
        if constexpr (!test::takes_zero<TypeParam>) {
            expected = test::exact_sums<TypeParam>({0.5, taps}, past).back().high;
        }
        const double found = line.step_real(past[k]);
        ASSERT_NEAR(found, expected,
                    glsum::error_bound<TypeParam>({0.5, taps}, line.state(), 64.0 * smallest, 3 * taps))
            << k;
    }
    for (std::size_t k = 0; k < taps; ++k) {
        line.step_real(0.0);
    }
    if (reference::dropped_by<typename TypeParam::HistoryPart>() != reference::Dropped::line) {  // it ends in x_0
        ASSERT_EQ(line.step_real(0.0), 0.0);
    }
}

// A change of order in mid-stream, as variable-order models make it: prepare forgets the past and takes the new table.
TYPED_TEST(IdentityTest, AChangeOfOrderStartsAfresh) {
    Line<TypeParam> changed({1.9909, 60});
    for (const double sample : noise(100, 0.9)) {
        changed.step_real(sample);
    }
    std::vector<typename TypeParam::Coefficient> table(TypeParam::table_count(60));
    std::vector<typename TypeParam::Sample> past(TypeParam::past_count(60));
    ASSERT_EQ(TypeParam::prepare(changed.state(), {0.3, 45}, table, past), glsum::Status::ok);
    Line<TypeParam> fresh({0.3, 45});
    for (const double sample : noise(100, 0.5)) {
        ASSERT_EQ(changed.step_real(sample), fresh.step_real(sample));
    }
}

}  // namespace
