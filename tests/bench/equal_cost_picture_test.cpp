// The picture of equal costs: room beside its panels, whatever their number, and where its key stands.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "bench/studies/equal_cost.hpp"
#include "tests/bench/pretend_gnuplot.hpp"

namespace {

class EqualCostPicture : public PretendGnuplot {
protected:
    // Shares of the picture; between panels the last two.
    struct Margins {
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, across = 0.0, down = 0.0;
        double width = 0.0, height = 0.0;
    };
    std::string script_of(const std::vector<double>& orders, const std::vector<std::string>& signals) {
        bench::EqualCost wanted;
        wanted.orders = orders;
        wanted.signals = signals;
        bench::plot_equal_cost(wanted, {}, stem());
        return sent();
    }
    static Margins margins_of(const std::string& script) {
        Margins found;
        EXPECT_EQ(
            std::sscanf(script.substr(script.find(" size ")).c_str(), " size %lf,%lf", &found.width, &found.height), 2);
        EXPECT_EQ(
            std::sscanf(script.substr(script.find(" margins ")).c_str(), " margins %lf,%lf,%lf,%lf spacing %lf,%lf",
                        &found.left, &found.right, &found.bottom, &found.top, &found.across, &found.down),
            6);
        return found;
    }
};

// As many pixels however many panels there are, and most of the picture for these.
TEST_F(EqualCostPicture, MarginsDoNotGrowWithThePanels) {
    const Margins few = margins_of(script_of({0.5}, {"step"}));
    const Margins many = margins_of(script_of({0.1, 0.3, 0.5, 0.7}, {"step", "ramp", "sine1", "noise", "drive"}));
    const auto same = [](double one, double other) {
        EXPECT_GT(one, 10.0);
        EXPECT_NEAR(one, other, 0.2);  // the shares have four digits
    };
    same(few.left * few.width, many.left * many.width);
    same((1.0 - few.right) * few.width, (1.0 - many.right) * many.width);
    same(few.bottom * few.height, many.bottom * many.height);
    same((1.0 - few.top) * few.height, (1.0 - many.top) * many.height);
    same(few.across * few.width, many.across * many.width);
    same(few.down * few.height, many.down * many.height);
    EXPECT_GT(many.right - many.left - 4.0 * many.across, 0.5);
    EXPECT_GT(many.top - many.bottom - 3.0 * many.down, 0.5);
}

// In the margin on the right, as high as the highest panel.
TEST_F(EqualCostPicture, TheKeyStandsBesideTheUppermostPanel) {
    const std::string script = script_of({0.5, 0.9}, {"step", "noise"});
    const Margins margins = margins_of(script);
    double x = 0.0;
    double y = 0.0;
    ASSERT_EQ(std::sscanf(script.substr(script.find("set key at ")).c_str(),
                          "set key at screen %lf, screen %lf left top", &x, &y),
              2);
    EXPECT_GT(x, margins.right);
    EXPECT_LT((x - margins.right) * margins.width, 20.0);
    EXPECT_EQ(y, margins.top);
}

}  // namespace
