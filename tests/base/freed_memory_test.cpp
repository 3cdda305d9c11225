// Whether freed pages are there when the next vectors want some.
#include "base/freed_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace {

long page_faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

// Ten vectors of 64 KiB, as a simulation of 8000 nodes makes, made and dropped: 160 pages a round.
void simulate(int rounds) {
    for (int round = 0; round < rounds; ++round) {
        const std::vector<std::vector<double>> all(10, std::vector<double>(8192, static_cast<double>(round)));
        ASSERT_EQ(all.back().back(), round);
    }
}

TEST(FreedMemory, IsThereForTheNextVectors) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "another allocator";
#else
    base::keep_freed_memory();
    simulate(2);
    const long before = page_faults();
    simulate(100);
    EXPECT_LT(page_faults() - before, 1000);
#endif
}

}  // namespace
