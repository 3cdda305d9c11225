// Stability: the paper's models, cases on the border, cases beyond; roots and argument principle held against each
// other.
#include "drive/stability.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <random>

#include "base/failure.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Model;
using drive::Stability;

Model with(std::vector<drive::Term> denominator) {
    Model model;
    model.denominator = std::move(denominator);
    return model;
}

Stability verdict(const Model& model, double base_order) {
    const auto judged = drive::judge_stability(model, base_order);
    EXPECT_TRUE(judged.agree()) << drive::to_text(model) << ": " << judged.unstable_by_roots << " by roots, "
                                << judged.unstable_by_argument << " by argument";
    EXPECT_LT(judged.largest_residual, 1e-12);
    return judged.verdict;
}

TEST(Stability, ThePapersModelsAreStable) {
    EXPECT_EQ(verdict(plants::niopdt(), 0.01), Stability::stable);
    EXPECT_EQ(verdict(plants::sopdt(), 1.0), Stability::stable);
    EXPECT_EQ(verdict(plants::fopdt(), 1.0), Stability::stable);
    EXPECT_EQ(verdict(plants::fopdt(), 0.01), Stability::stable);
    EXPECT_EQ(drive::judge_stability(plants::niopdt(), 0.01).roots.size(), 199U);
    EXPECT_EQ(drive::usual_base_order(plants::niopdt()), 0.01);
    EXPECT_EQ(drive::usual_base_order(plants::sopdt()), 1.0);
}

// s^v + 2 cos(phi) ... : D^a y + k y = u has sigma^n = -k, its nearest roots at pi / n: stable for a < 2, on the border
// at a = 2, and for a > 2 unstable.
TEST(Stability, OfOneTermTurnsAtOrderTwo) {
    EXPECT_EQ(verdict(with({{1, 1.9}, {3, 0}}), 0.1), Stability::stable);
    EXPECT_EQ(verdict(with({{1, 2.0}, {3, 0}}), 0.1), Stability::borderline);
    EXPECT_EQ(verdict(with({{1, 2.0}, {3, 0}}), 1.0), Stability::borderline);
    EXPECT_EQ(verdict(with({{1, 2.1}, {3, 0}}), 0.1), Stability::unstable);
    EXPECT_EQ(drive::judge_stability(with({{1, 2.1}, {3, 0}}), 0.1).unstable_by_roots, 2);
}

// Where a pole lies is no question of the input's unit.
TEST(Stability, OfAnyUnitIsTheSame) {
    for (const double unit : {1e-12, 1.0, 1e12}) {
        const auto judged = [&](double order) {
            return drive::judge_stability(with({{unit, order}, {0.2 * unit, 0.5}, {3 * unit, 0}}), 0.1);
        };
        EXPECT_EQ(verdict(with({{unit, 1.9}, {0.2 * unit, 0.5}, {3 * unit, 0}}), 0.1), Stability::stable) << unit;
        EXPECT_EQ(verdict(with({{unit, 2.0}, {3 * unit, 0}}), 0.1), Stability::borderline) << unit;
        EXPECT_EQ(judged(1.9).unstable_by_argument, 0) << unit;
        EXPECT_EQ(judged(2.3).unstable_by_argument, 2) << unit;
        EXPECT_EQ(judged(2.3).unstable_by_roots, 2) << unit;
    }
}

TEST(Stability, IntegratorsAreOnTheBorder) {
    EXPECT_EQ(verdict(with({{1, 1}}), 1.0), Stability::borderline);
    EXPECT_EQ(verdict(with({{1, 1.5}, {1, 0.5}}), 0.5), Stability::borderline);
    EXPECT_EQ(verdict(with({{1, 2}, {1, 1}}), 1.0), Stability::borderline);
}

TEST(Stability, SeesOnePositiveRootAndNegativeDamping) {
    EXPECT_EQ(verdict(with({{1, 1}, {-1, 0}}), 1.0), Stability::unstable);
    EXPECT_EQ(drive::judge_stability(with({{1, 0.5}, {-1, 0}}), 0.5).unstable_by_argument, 1);
    EXPECT_EQ(verdict(with({{1, 2}, {-0.001, 1}, {1, 0}}), 1.0), Stability::unstable);
    EXPECT_EQ(verdict(with({{1, 2}, {0.001, 1}, {1, 0}}), 1.0), Stability::stable);
    // Negative damping of order 0.5 is stable below sqrt 2, since sigma^2 - 2 c sigma + 1 has its roots at acos c.
    const double limit = std::cos(0.25 * std::numbers::pi);
    EXPECT_EQ(verdict(with({{1, 1}, {-2 * (limit - 1e-3), 0.5}, {1, 0}}), 0.5), Stability::stable);
    EXPECT_EQ(verdict(with({{1, 1}, {-2 * (limit + 1e-3), 0.5}, {1, 0}}), 0.5), Stability::unstable);
    EXPECT_EQ(verdict(with({{1, 1}, {-2 * limit, 0.5}, {1, 0}}), 0.5), Stability::borderline);
}

TEST(Stability, RootsAndArgumentAgreeOnRandomModels) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> coefficient(-2.0, 2.0);
    std::uniform_int_distribution<int> power(1, 60);
    int unstable = 0;
    for (int i = 0; i < 300; ++i) {
        Model model = with({{coefficient(random), 0.0}});
        for (int j = 0; j < 3; ++j) {
            const double order = 0.05 * power(random);
            if (order != model.denominator.back().order && (j < 2 || order != model.denominator[1].order)) {
                model.denominator.push_back({coefficient(random), order});
            }
        }
        try {
            drive::check_model(model, "random");
        } catch (const glsum::Failure&) {
            continue;
        }
        unstable += verdict(model, 0.05) == Stability::unstable ? 1 : 0;
    }
    EXPECT_GT(unstable, 50);
    EXPECT_LT(unstable, 290);
}

TEST(Stability, RefusesADegreeThatIsTooLarge) {
    EXPECT_THROW((void)drive::judge_stability(plants::niopdt(), 0.001), glsum::Failure);
    EXPECT_THROW((void)drive::judge_stability(plants::niopdt(), 0.0), glsum::Failure);
    EXPECT_THROW((void)drive::judge_stability(plants::niopdt(), -0.01), glsum::Failure);
    EXPECT_THROW((void)drive::judge_stability(with({{1, 1.0}, {1, 0.9}}), 0.5), glsum::Failure);
    // Of more than 600 the roots would lose their digits.
    EXPECT_EQ(drive::to_commensurate(with({{1, 6.0}, {1, 0}}), 0.01).denominator.size(), 601U);
    EXPECT_THROW((void)drive::to_commensurate(with({{1, 6.01}, {1, 0}}), 0.01), glsum::Failure);
}

TEST(Commensurate, FindsTheCommonOrderWhereThereIsOne) {
    EXPECT_EQ(drive::common_base_order(plants::sopdt()), 1.0);
    EXPECT_EQ(drive::common_base_order(with({{1, 1.5}, {1, 0.5}, {1, 0}})), 0.5);
    EXPECT_NEAR(drive::common_base_order(with({{1, 1.2}, {1, 0.9}, {1, 0}})).value(), 0.3, 1e-12);
    EXPECT_FALSE(drive::common_base_order(plants::niopdt()).has_value());
}

TEST(Commensurate, StateSpaceIsTheSameTransferFunction) {
    Model model = with({{2, 1.5}, {3, 1.0}, {-1, 0.5}, {4, 0}});
    model.gain = 1.7;
    model.numerator = {{0.5, 1.5}, {6, 0.5}, {1, 0}};
    const auto space = drive::to_state_space(drive::to_commensurate(model, 0.5));
    EXPECT_EQ(space.a.rows(), 3);
    for (const std::complex<double> s : {std::complex<double>(0.3, 2.0), std::complex<double>(4.0, 0.1)}) {
        const std::complex<double> sigma = std::sqrt(s);
        const Eigen::MatrixXcd resolvent =
            (sigma * Eigen::MatrixXcd::Identity(3, 3) - space.a.cast<std::complex<double>>()).inverse();
        const Eigen::VectorXcd column = resolvent * space.b.cast<std::complex<double>>();
        const std::complex<double> found = (space.c.cast<std::complex<double>>() * column)(0) + space.d;
        EXPECT_LT(std::abs(found - drive::evaluate_without_delay(model, s)), 1e-12);
    }
}

}  // namespace
