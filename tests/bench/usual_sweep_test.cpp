// What a run measures by itself, and which lengths, kernels and peers its words stand for.
#include "bench/run/usual_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/failure.hpp"
#include "bench/host/peers/peer.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/catalogue.hpp"

namespace {

using testing::Contains;
using testing::Not;

std::vector<std::string> texts_of(const std::vector<bench::Length>& lengths) {
    std::vector<std::string> texts;
    for (const bench::Length& length : lengths) {
        texts.push_back(length.text());
    }
    return texts;
}

TEST(UsualSweep, IsLongOrQuick) {
    const bench::Sweep whole = bench::usual_sweep(false);
    EXPECT_EQ(whole.samples, 5000U);
    EXPECT_EQ(whole.orders, (std::vector{0.2, 0.3, 0.5, 0.7, 0.9, 0.98319, 1.5, 1.9909, -0.5}));
    EXPECT_EQ(texts_of(whole.lengths), (std::vector<std::string>{"50", "75", "100", "150", "200", "300", "400", "500",
                                                                 "600", "800", "1000", "full"}));
    EXPECT_EQ(whole.lengths.back().taps, 5000U);
    EXPECT_EQ(whole.design_errors.size(), 4U);
    EXPECT_EQ(whole.signals.size(), std::size(bench::signal_names));
    EXPECT_TRUE(whole.kernels.empty());
    const bench::Sweep quick = bench::usual_sweep(true);
    EXPECT_EQ(quick.samples, 1000U);
    EXPECT_EQ(quick.orders, (std::vector{0.5, 0.98319, 1.9909, -0.5}));
    EXPECT_EQ(texts_of(quick.lengths), (std::vector<std::string>{"50", "100", "200", "600", "full"}));
    EXPECT_EQ(quick.lengths.back().taps, 1000U);
    EXPECT_EQ(quick.design_errors, std::vector{1e-4});
    EXPECT_EQ(quick.signals, whole.signals);
}

TEST(UsualSweep, LengthsRiseAndComeOnce) {
    EXPECT_EQ(texts_of(bench::lengths_of({"full", "600", "2+7", "600", "5"}, 1000)),
              (std::vector<std::string>{"5", "2+7", "600", "full"}));
    // Of as many terms as they were asked for.
    EXPECT_EQ(texts_of(bench::lengths_of({"full", "1000", "2+7", "16"}, 1000)),
              (std::vector<std::string>{"2+7", "16", "full", "1000"}));
    try {
        (void)bench::lengths_of({"5", "1000001"}, 1000);
        FAIL() << "too long a length was taken";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(std::string(failure.what()),
                  "--taps: expected a number of at least 1 and at most 1000000, full, or near taps and modes as 2+7, "
                  "found 1000001");
    }
}

TEST(UsualSweep, KernelsAreThoseOfTheCatalogueThatMatch) {
    bench::Sweep sweep;
    bench::take_kernels(sweep, {"ring_plain_f*", "shift_plain_f64"});
    EXPECT_EQ(sweep.kernels.front(), "shift_plain_f64");  // in the registry's order
    EXPECT_THAT(sweep.kernels, Contains("ring_plain_f32"));
    EXPECT_THAT(sweep.kernels, Not(Contains("ring_plain_q31")));
    EXPECT_TRUE(sweep.peers.empty());
    bench::Sweep all;
    bench::take_kernels(all, {"*"});
    EXPECT_EQ(all.kernels.size(), glsum::catalogue.size());
    EXPECT_EQ(all.peers.size(), bench::peers().size());
}

TEST(UsualSweep, TimesToBeJudgedHaveWitnesses) {
    const auto peers_of = [](unsigned repetitions, std::vector<std::string> targets, const char* glob) {
        bench::Sweep sweep;
        sweep.repetitions = repetitions;
        sweep.targets = std::move(targets);
        bench::take_kernels(sweep, {glob});
        return sweep.peers;
    };
    EXPECT_THAT(peers_of(2, {"host"}, "ring_plain_f32"), Contains("peer_std_q31"));
    EXPECT_THAT(peers_of(2, {"host"}, "ring_plain_f32"), Contains("peer_std_f32"));
    EXPECT_TRUE(peers_of(1, {"host"}, "ring_plain_f32").empty());
    EXPECT_TRUE(peers_of(2, {"m7"}, "ring_plain_f32").empty());
    EXPECT_EQ(peers_of(2, {"host"}, "peer_std_f32"), std::vector<std::string>{"peer_std_f32"});  // nothing to judge
}

TEST(UsualSweep, KernelsThatCannotSumTheWeightsAreLeftOutByTheirReason) {
    bench::Sweep sweep;
    sweep.kernels = {"ring_plain_f32", "mirrorhold_plain_f32", "ring_horner_q31", "mirrorlinear_multi_f32"};
    EXPECT_TRUE(bench::leave_out_unserved(sweep).empty());
    EXPECT_EQ(sweep.kernels.size(), 4U);
    sweep.weights = bench::Discretisation::bdf2;
    const auto left_out = bench::leave_out_unserved(sweep);
    EXPECT_EQ(sweep.kernels, std::vector<std::string>{"ring_plain_f32"});
    ASSERT_EQ(left_out.size(), 2U);
    for (const auto& [reason, kernels] : left_out) {
        const bool guesses = std::ranges::count(kernels, "ring_horner_q31") == 0;
        EXPECT_EQ(kernels.size(), guesses ? 2U : 1U) << reason;
    }
}

}  // namespace
