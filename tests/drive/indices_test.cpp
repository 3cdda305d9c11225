// The indices on errors whose integrals are known, and which of the two NRMSE the paper's table holds.
#include "drive/indices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/failure.hpp"
#include "drive/response.hpp"
#include "tests/drive/plants.hpp"

namespace {

TEST(Indices, OfAConstantErrorAreItsIntegrals) {
    std::vector<double> time, measured, modelled;
    for (int k = 0; k <= 1000; ++k) {
        time.push_back(2.0 + 0.003 * k);  // time counts from the first stamp
        measured.push_back(1.0 + 0.001 * k);
        modelled.push_back(measured.back() - 0.5);
    }
    const auto found = drive::compute_indices(time, measured, modelled);
    EXPECT_NEAR(found.ise, 0.25 * 3.0, 1e-12);
    EXPECT_NEAR(found.iae, 0.5 * 3.0, 1e-12);
    EXPECT_NEAR(found.itse, 0.25 * 4.5, 1e-12);
    EXPECT_NEAR(found.itae, 0.5 * 4.5, 1e-12);
    EXPECT_NEAR(found.max_ape, 0.5, 1e-12);
    EXPECT_NEAR(found.rmse, 0.5, 1e-12);
    EXPECT_NEAR(found.nrmse_printed, 1.0 - 0.5 * std::sqrt(1001.0) / 1001.0, 1e-12);
    EXPECT_NEAR(found.nrmse_fit, 1.0 - 0.5 / (std::sqrt((1001.0 * 1001.0 - 1.0) / 12.0) * 0.001), 1e-9);
}

TEST(Indices, LeaveZerosOutOfTheRelativeErrorAndSayHowMany) {
    const std::vector<double> time{0, 1, 2}, measured{0, 1, 2}, modelled{1, 1, 1};
    const auto found = drive::compute_indices(time, measured, modelled);
    EXPECT_EQ(found.max_ape, 0.5);
    EXPECT_EQ(found.max_ape_skipped, 1U);
    EXPECT_THROW((void)drive::compute_indices(time, std::vector<double>{1, 1, 1}, modelled), glsum::Failure);
    EXPECT_THROW((void)drive::compute_indices(time, measured, std::vector<double>{1, 1}), glsum::Failure);
}

// Tables 2 and 3 of the paper: ISE = sum e^2 h, so each row's ISE and NRMSE give ||y - mean||^2 h if NRMSE is the fit:
// the same number thrice, and near that of a model of the record. The printed formula would give NRMSE above 99.9 %.
TEST(Indices, TheTablesOfThePaperHoldTheFitAndNotThePrintedFormula) {
    const double ise[] = {6.9119e-3, 3.0031e-3, 9.6876e-4};
    const double nrmse[] = {0.9115, 0.9417, 0.9668};
    std::vector<double> spread;
    for (int i = 0; i < 3; ++i) {
        spread.push_back(ise[i] / ((1.0 - nrmse[i]) * (1.0 - nrmse[i])));
    }
    EXPECT_NEAR(spread[0], 0.88, 0.004);
    EXPECT_NEAR(spread[1], 0.88, 0.004);
    EXPECT_NEAR(spread[2], 0.88, 0.004);
    std::vector<double> time, zero(5001, 0.0);
    for (int k = 0; k <= 5000; ++k) {
        time.push_back(0.001 * k);
    }
    const auto modelled = drive::respond(plants::niopdt(), std::vector<drive::Change>{{0.0, 1.0}}, time);
    const auto against_zero = drive::compute_indices(time, modelled, zero);  // ||y||, and from it ||y - mean||
    const double own = 0.001 * std::pow(against_zero.rmse * std::sqrt(5001.0) / (1.0 - against_zero.nrmse_fit), 2);
    EXPECT_NEAR(own, 0.90, 0.01);
    for (const double value : ise) {
        EXPECT_GT(1.0 - std::sqrt(value / 0.001) / 5001.0, 0.999);  // with y_max - y_min = 1
    }
}

}  // namespace
