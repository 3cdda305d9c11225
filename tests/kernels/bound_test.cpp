// The error bound that each kernel promises holds on every signal, order and length; and it is not an empty promise.
#include "glsum/bound.hpp"

#include <map>
#include <numeric>

#include "bench/reference/bdf.hpp"
#include "bench/signals.hpp"
#include "modes/bdf.hpp"
#include "tests/kernels/any_kernel.hpp"

namespace {

struct Reference {
    double order;
    std::size_t taps;
    std::vector<double> record;
    reference::Sums exact;
};

std::vector<Reference> make_references(reference::Dropped dropped) {
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
}

class BoundTest : public test::EveryKernel {};
INSTANTIATE_TEST_SUITE_P(, BoundTest, testing::ValuesIn(test::any_kernels()), test::name_of);

TEST_P(BoundTest, HoldsOnEverySignalOrderAndLength) {
    static std::map<reference::Dropped, std::vector<Reference>> references;
    auto& cases = references[kernel.dropped];
    if (cases.empty()) {
        cases = make_references(kernel.dropped);
    }
    double largest_share = 0.0;
    for (const Reference& reference : cases) {
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

// Weights that no order has: those of higher order, as a kernel gets them and in 50 digits.
struct HigherOrder {
    unsigned steps;
    double order;
    std::size_t taps;
    std::vector<double> named;
    std::vector<double> record;
    reference::Sums exact;
};

std::vector<HigherOrder> make_higher_order(bool increments) {
    std::vector<HigherOrder> made;
    constexpr std::size_t samples = 300;
    for (unsigned steps = 2; steps <= 4; ++steps) {
        for (const double order : {0.2, 0.5, 0.98319, 1.5, 1.9909, -0.5}) {
            auto named = increments ? glsum::modes::bdf_increment_weights(steps, order, samples)
                                    : glsum::modes::bdf_weights(steps, order, samples);
            named.erase(named.begin());
            const auto weights = reference::bdf_weights(steps, reference::Real(order), samples);
            for (const std::size_t taps : {7U, 50U, 150U}) {
                // Of increments the differences of the weights' sums, which end with the taps.
                std::vector<reference::Real> near(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(taps));
                if (increments) {
                    near.push_back(-std::accumulate(near.begin(), near.end(), reference::Real(0)));
                }
                const std::size_t reach[] = {near.size()};
                for (const std::string_view signal : {"step", "sine50", "noise"}) {
                    const auto record = bench::make_signal(signal, samples, 1);
                    made.push_back({steps, order, taps, named, record, reference::sums(near, record, reach).front()});
                }
            }
        }
    }
    return made;
}

TEST_P(BoundTest, HoldsForWeightsOfHigherOrder) {
    static std::map<bool, std::vector<HigherOrder>> higher_order;
    const bool increments = kernel.dropped == reference::Dropped::increments;
    auto& cases = higher_order[increments];
    if (cases.empty()) {
        cases = make_higher_order(increments);
    }
    std::size_t held = 0;
    for (const HigherOrder& test : cases) {
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
    const bool refuses = kernel.guesses() || (kernel.fixed_point && kernel.nested());
    EXPECT_EQ(held, refuses ? 0U : cases.size());
}

}  // namespace
