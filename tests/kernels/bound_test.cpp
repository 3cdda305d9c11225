// The error bound that each kernel promises holds on every signal, order and length; and it is not an empty promise.
#include "glsum/bound.hpp"

#include "bench/reference/dropped.hpp"
#include "bench/signals.hpp"
#include "tests/kernels/registered.hpp"

namespace {

struct Reference {
    double order;
    std::size_t taps;
    std::vector<double> record;
    reference::Sums exact;
};

template <reference::Dropped dropped>
const std::vector<Reference>& references() {
    static const std::vector<Reference> all = [] {
        std::vector<Reference> made;
        constexpr std::size_t samples = 400;
        const std::vector<std::size_t> lengths{1, 7, 50, 150, samples};
        for (const double order : {0.2, 0.5, 0.9, 0.98319, 1.0, 1.5, 1.9909, 2.0, -0.5, -1.5}) {
            const auto weights = reference::weights(reference::Real(order), samples);
            for (const std::string_view signal : bench::signal_names) {
                const auto record = bench::make_signal(signal, samples, 1);
                auto sums = reference::sums(weights, record, lengths);
                for (std::size_t i = 0; i < lengths.size(); ++i) {
                    made.push_back({order, lengths[i], record,
                                    dropped == reference::Dropped::zero
                                        ? std::move(sums[i])
                                        : reference::sums_of(dropped, {order, lengths[i]}, record)});
                }
            }
        }
        return made;
    }();
    return all;
}

template <class K>
class BoundTest : public testing::Test {};
TYPED_TEST_SUITE(BoundTest, test::Kernels, test::KernelNames);

TYPED_TEST(BoundTest, HoldsOnEverySignalOrderAndLength) {
    double largest_share = 0.0;
    for (const Reference& reference : references<reference::dropped_by<typename TypeParam::HistoryPart>()>()) {
        const glsum::Design design{reference.order, reference.taps};
        if (!TypeParam::order_in_range(reference.order)) {
            continue;
        }
        test::Line<TypeParam> line(design);
        ASSERT_EQ(line.status(), glsum::Status::ok);
        const double bound =
            glsum::error_bound<TypeParam>(design, line.state(), bench::signal_peak, reference.record.size());
        for (std::size_t k = 0; k < reference.record.size(); ++k) {
            const double error = std::fabs(reference.exact[k].error_of(line.step_real(reference.record[k])));
            ASSERT_LE(error, bound) << "order " << reference.order << ", taps " << reference.taps << ", k " << k;
            largest_share = std::max(largest_share, error / bound);
        }
    }
    // Some case must use a fair part of it: a bound a thousand times too wide would let every fault pass.
    EXPECT_GE(largest_share, 0.01);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

}  // namespace
