// Windows summed for four coming outputs at once: the bits of a ring with the same technique, and no call that does
// more than its share.
#include <cmath>
#include <random>

#include "tests/kernels/registered.hpp"

namespace {

template <class K>
using IsBlock = std::is_same<typename K::HistoryPart, glsum::Block>;
using BlockKernels = test::Filter<IsBlock, test::Kernels>::Types;

template <class K>
class BlockKernelTest : public testing::Test {};
TYPED_TEST_SUITE(BlockKernelTest, BlockKernels, test::KernelNames);

double noise(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0; }

// Lengths about whole groups, odd and even numbers of them, and a reset in every phase.
TYPED_TEST(BlockKernelTest, HasTheBitsOfARingAtEveryLengthAndPhase) {
    using Ring = glsum::Sum<glsum::Ring, typename TypeParam::TechniquePart, typename TypeParam::FormatPart>;
    for (const double order : {0.5, 1.9909, -0.5}) {
        for (std::size_t taps = 1; taps < 75; ++taps) {
            test::Line<TypeParam> line({order, taps});
            bench::HostLine<Ring> ring({order, taps});
            ASSERT_EQ(line.status(), glsum::Status::ok);
            for (std::size_t early = 0; early < 5; ++early) {
                std::mt19937_64 generator(taps);
                for (std::size_t k = 0; k < 3 * taps + 9 + early; ++k) {
                    const auto x = TypeParam::from_real(noise(generator));
                    ASSERT_EQ(line.step(x), ring.step(x)) << order << ", taps " << taps << ", k " << k;
                }
                TypeParam::reset(line.state());
                Ring::reset(ring.state());
            }
        }
    }
}

// What is left when a group is complete: nothing, and no call had more than its quarter of the groups, rounded up.
TYPED_TEST(BlockKernelTest, DealsTheWorkOutEvenly) {
    for (const std::size_t taps : {2U, 5U, 6U, 17U, 50U, 600U}) {
        test::Line<TypeParam> line({0.5, taps});
        const std::size_t groups = glsum::Block::groups(taps - 1);
        ASSERT_EQ(line.state().left, groups);
        for (std::size_t k = 0; k < 4 * groups + 8; ++k) {
            const std::size_t before = line.state().left;
            line.step(TypeParam::from_real(0.25));
            const std::size_t after = k % 4 == 3 ? 0 : line.state().left;
            ASSERT_LE(before - after, (groups + 3) / 4) << taps << " " << k;
            ASSERT_GE(before - after, groups / 4) << taps << " " << k;
            if (k % 4 == 3) {
                ASSERT_EQ(line.state().left, groups) << taps << " " << k;
            }
        }
    }
}

}  // namespace
