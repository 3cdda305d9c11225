// Floating-point kernels bit for bit in the order of summation that their technique states, one number at a time. A
// product that is fused where none is promised, or is not where one is, changes these bits.
#include <cmath>
#include <random>

#include "tests/kernels/registered.hpp"

namespace {

// The sum of one technique over a past x_(k-1), x_(k-2), ... that is complete or cut at the window's end.
template <class Format>
class Stated {
    using Data = typename Format::Sample;
    using Wide = typename Format::Accumulator;

public:
    /// \param contiguous  whether the window lies in one piece
    Stated(const glsum::Design& design, std::string_view technique, bool keeps_modes, bool contiguous)
        : fused_(technique.ends_with("fma")),
          // Without modes, which have a test of their own, nothing is compensated: that is of their states.
          form_(keeps_modes ? "plain"
                : fused_    ? technique.substr(0, technique.size() - 3)
                            : technique),
          contiguous_(contiguous) {
        glsum::Weights walk(design.order);
        for (std::size_t j = 1; j < design.taps + 4; ++j) {
            walk.next();
            weights_.push_back(static_cast<Data>(walk.weight()));
            factors_.push_back(walk.factor());
        }
        past_.assign(design.taps - 1, Data(0));
    }

    Data step(Data newest) {
        const Wide sum = evaluate(newest);
        past_.insert(past_.begin(), newest);
        past_.pop_back();
        return static_cast<Data>(sum);
    }

private:
    [[nodiscard]] Wide accumulate(Wide sum, Wide a, Wide x) const {
        if (fused_) {
            return std::fma(a, x, sum);
        }
        const volatile Wide product = a * x;
        return sum + product;
    }

    Wide evaluate(Data newest) {
        const std::size_t count = past_.size();
        const auto a = [&](std::size_t i) { return static_cast<Wide>(weights_[i]); };
        const auto x = [&](std::size_t i) { return static_cast<Wide>(past_[i]); };
        const auto first = static_cast<Wide>(newest);
        if (form_ == "plain" || form_ == "fir") {
            Wide sum = first;
            for (std::size_t i = 0; i < count; ++i) {
                sum = accumulate(sum, a(i), x(i));
            }
            return sum;
        }
        if (form_ == "oldest") {
            Wide sum = 0;
            for (std::size_t i = count; i > 0; --i) {
                sum = accumulate(sum, a(i - 1), x(i - 1));
            }
            return first + sum;
        }
        if (form_ == "multi") {
            // Each piece of the window begins with the first accumulator.
            Wide sum[4] = {};
            const std::size_t newer = pieces();
            for (std::size_t i = 0; i < count; ++i) {
                Wide& chain = sum[(i < newer ? i : i - newer) % 4];
                chain = accumulate(chain, a(i), x(i));
            }
            return first + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
        }
        if (form_ == "pairwise") {
            return first + pairwise(count);
        }
        if (form_ == "compensated") {
            // Neumaier's own comparison: the kernel's way without it must give the same bits.
            Wide sum = first;
            Wide lost = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const volatile Wide term = a(i) * x(i);
                const Wide next = sum + term;
                lost += std::fabs(sum) >= std::fabs(term) ? (sum - next) + term : (term - next) + sum;
                sum = next;
            }
            return sum + lost;
        }
        if (form_ == "horner") {
            Wide sum = 0;
            for (std::size_t i = count; i > 0; --i) {
                sum = accumulate(x(i - 1), i == count ? Wide(0) : static_cast<Data>(factors_[i]), sum);
            }
            return accumulate(first, count == 0 ? Wide(0) : static_cast<Data>(factors_[0]), sum);
        }
        if (form_ == "hornersplit") {
            Wide chain[4] = {};
            for (std::size_t i = count; i > 0; --i) {
                const std::size_t at = i - 1;
                const double factor = factor_of_four(at + 4);
                // A chain's step before its oldest sample is one with 0: it changes nothing.
                chain[at % 4] = accumulate(x(at), static_cast<Data>(factor), chain[at % 4]);
            }
            const volatile Wide products[4] = {a(0) * chain[0], a(1) * chain[1], a(2) * chain[2], a(3) * chain[3]};
            return first + ((products[0] + products[1]) + (products[2] + products[3]));
        }
        ADD_FAILURE() << "no order is stated for " << form_;
        return 0;
    }

    // The 2^n-fold of eight products from `from` on, halved until two are left.
    [[nodiscard]] Wide halved(std::size_t from, std::size_t many) const {
        if (many == 1) {
            const volatile Wide product = static_cast<Wide>(weights_[from]) * static_cast<Wide>(past_[from]);
            return product;
        }
        return halved(from, many / 2) + halved(from + many / 2, many / 2);
    }

    // The largest such part first, what is left over of eights last; added up from there.
    [[nodiscard]] Wide pairwise(std::size_t count) const {
        std::vector<Wide> parts;
        std::size_t at = 0;
        while (count - at >= 8) {
            std::size_t many = 8;
            while (2 * many <= count - at) {
                many *= 2;
            }
            parts.push_back(halved(at, many));
            at += many;
        }
        Wide sum = 0;
        for (; at < count; ++at) {
            sum = accumulate(sum, static_cast<Wide>(weights_[at]), static_cast<Wide>(past_[at]));
        }
        for (; !parts.empty(); parts.pop_back()) {
            sum = parts.back() + sum;
        }
        return sum;
    }

    // c_(i+1) c_i c_(i-1) c_(i-2), multiplied as the table is: by position modulo four.
    [[nodiscard]] double factor_of_four(std::size_t i) const {
        double by_place[4] = {};
        for (std::size_t back = 0; back < 4; ++back) {
            by_place[(i - back) % 4] = factors_[i - back];
        }
        return (by_place[0] * by_place[1]) * (by_place[2] * by_place[3]);
    }

    // Samples in the newer piece of a ring: the head starts at 0 and moves down.
    std::size_t pieces() {
        if (contiguous_ || past_.empty()) {
            return past_.size();
        }
        const std::size_t head = head_;
        head_ = (head_ == 0 ? past_.size() : head_) - 1;
        return past_.size() - head;
    }

    std::vector<Data> weights_;
    std::vector<double> factors_;
    std::vector<Data> past_;
    std::size_t head_ = 0;
    bool fused_;
    std::string_view form_;
    bool contiguous_;
};

template <class K>
class OrderTest : public testing::Test {};
TYPED_TEST_SUITE(OrderTest, test::FloatingKernels, test::KernelNames);

TYPED_TEST(OrderTest, EqualsTheStatedOrderBitForBit) {
    using Sample = typename TypeParam::Sample;
    for (const double order : {0.5, 0.98319, 1.9909, -0.5}) {
        for (const std::size_t taps : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 33U, 50U}) {
            test::Line<TypeParam> line({order, taps});
            Stated<typename TypeParam::FormatPart> stated({order, taps}, TypeParam::TechniquePart::word,
                                                          glsum::keeps_modes<typename TypeParam::HistoryPart>,
                                                          TypeParam::HistoryPart::contiguous);
            std::mt19937_64 generator(taps);
            for (std::size_t k = 0; k < 2 * taps + 10; ++k) {
                const auto x = static_cast<Sample>(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                ASSERT_EQ(line.step(x), stated.step(x)) << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

}  // namespace
