// The error bound that each kernel promises holds on every signal, order and length; and it is not an empty promise.
#include "glsum/bound.hpp"

#include "bench/sweep/signals.hpp"
#include "tests/kernels/any_kernel.hpp"
#include "tests/kernels/bound_references.hpp"

namespace {

class BoundTest : public test::EveryKernel {};
INSTANTIATE_TEST_SUITE_P(, BoundTest, testing::ValuesIn(test::any_kernels()), test::name_of);

TEST_P(BoundTest, HoldsOnEverySignalOrderAndLength) {
    double largest_share = 0.0;
    for (const test::BoundReference& reference : test::read_bound_references(TEST_REFERENCES, kernel.dropped)) {
        const glsum::Design design{reference.order, reference.taps};
        if (!kernel.order_in_range(reference.order)) {
            continue;
        }
        const auto line = kernel.line(design);
        ASSERT_EQ(line->status(), glsum::Status::ok);
        const double bound = line->bound(design, bench::signal_peak, reference.record.size());
        for (std::size_t k = 0; k < reference.record.size(); ++k) {
            const double error = std::fabs(reference.exact[k].error_of(line->step(reference.record[k])));
            ASSERT_LE(error, bound) << "order " << reference.order << ", taps " << reference.taps << ", k " << k;
            largest_share = std::max(largest_share, error / bound);
        }
    }
    // Some case must use a fair part of it: a bound a thousand times too wide would let every fault pass.
    EXPECT_GE(largest_share, 0.01);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

TEST_P(BoundTest, HoldsForWeightsOfHigherOrder) {
    const auto cases =
        test::read_higher_order_references(TEST_REFERENCES, kernel.dropped == reference::Dropped::increments);
    std::size_t held = 0;
    for (const test::HigherOrderReference& test : cases) {
        const glsum::Design design{test.order, test.taps, {}, test.named};
        const auto line = kernel.line(design);
        if (line->status() == glsum::Status::weights_out_of_range) {
            continue;
        }
        ASSERT_EQ(line->status(), glsum::Status::ok);
        const double bound = line->bound(design, bench::signal_peak, test.record.size());
        for (std::size_t k = 0; k < test.record.size(); ++k) {
            ASSERT_LE(std::fabs(test.exact[k].error_of(line->step(test.record[k]))), bound)
                << test.steps << " steps, order " << test.order << ", taps " << test.taps << ", k " << k;
        }
        ++held;
    }
    const bool refuses = kernel.guesses() || (kernel.fixed_point && kernel.horner());
    EXPECT_EQ(held, refuses ? 0U : cases.size());
}

}  // namespace
