// How wide a figure's band is, by hand: as wide as the rule sets that fit, and on either side by what published rules
// leave open and by how far the furthest set is, refuted or not; never by more than the model may be wrong.
#include "qemu/timing/band.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

timing::Band band(const std::vector<std::int64_t>& figures, bool rival_fits, std::int64_t published = 20,
                  std::int64_t fitted = 105, std::int64_t guessed = 0) {
    timing::CoreFile core;
    for (std::size_t s = 0; s < figures.size(); ++s) {
        core.sets.push_back({"", "", {}, s == 0 || rival_fits});
    }
    core.sets[0].figures.band_published_permille = published;
    core.sets[0].figures.band_fitted_permille = fitted;
    core.sets[0].figures.band_predicted_permille = 300;
    return timing::band_of(core, figures, guessed);
}

void expect(const timing::Band& found, std::int64_t low, std::int64_t high) {
    EXPECT_EQ(found.low, low);
    EXPECT_EQ(found.high, high);
}

TEST(Band, OfOneSetIsWhatPublishedRulesLeaveOpen) {
    expect(band({1010}, true), 989, 1031);  // 2 %: 20.2, outwards to whole half cycles
    expect(band({0}, true), 0, 0);
}

TEST(Band, HoldsTheSetsThatFit) {
    // 40 of 1010 are 3.96 %: beside 990 or 1030, the middle, 20 and 5.96 % of it.
    expect(band({1010, 1050}, true), 948, 1112);
    expect(band({1010, 970}, true), 910, 1070);
}

TEST(Band, ARefutedSetMovesItNowhere) { expect(band({1010, 1050}, false), 949, 1071); }

// 100 of 1000 are lost to wrong guesses: 3 % beside the 2 %.
TEST(Band, GrowsWithWhatThePredictorDecides) {
    expect(band({1000}, true, 20, 105, 100), 950, 1050);
    expect(band({1000}, true, 20, 105, 900), 895, 1105);  // up to what it may be wrong by
}

// 10.5 % of the nominal figure, 106.05, which stays inside. As printed, too: rounded inwards.
TEST(Band, IsNoWiderThanTheModelMayBeWrong) {
    expect(band({1010, 1500}, false), 904, 1116);
    const timing::Band far = band({1010, 1500}, true);
    EXPECT_NEAR(static_cast<double>(far.low), 1010.0, 1.0);
    EXPECT_LE(far.low, 1010);
    EXPECT_EQ(far.high, 1222);
    expect(band({1010}, true, 105, 20), 904, 1116);  // never narrower than published rules leave it
}

// 10.5 % of 3 is no half cycle, and a band of no width would promise that nothing is in doubt.
TEST(Band, OfAShortFigureIsAHalfCycleToEitherSide) {
    expect(band({3}, true, 20, 105, 3), 2, 4);
    expect(band({3}, true), 2, 4);
}

}  // namespace
