// Cycles on the host: from a counter that counts, else from the time stamp.
#include "bench/host/cycle_counter.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <span>
#include <string>
#include <vector>

namespace {

// What a counter's reads give, one after the other.
int counter_of(std::span<const std::uint64_t> values, std::size_t bytes) {
    const int file = memfd_create("counter", 0);
    EXPECT_EQ(write(file, values.data(), bytes), static_cast<ssize_t>(bytes));
    lseek(file, 0, SEEK_SET);
    return file;
}

bool is_open(int file) { return fcntl(file, F_GETFD) >= 0; }

const std::string core = "core cycles (perf_event)";
const std::string time_stamp = "time-stamp counter (reference cycles, not core cycles)";

TEST(CycleCounter, ReadsACounterThatCounts) {
    const std::vector<std::uint64_t> values{5, 7, 1'000'000'000'000};
    const int file = counter_of(values, 24);
    {
        const bench::CycleCounter counter(file);
        EXPECT_EQ(counter.name(), core);
        EXPECT_EQ(counter.read(), 7U);  // the first told that it counts
        EXPECT_EQ(counter.read(), 1'000'000'000'000U);
        EXPECT_GT(counter.read(), 1000U);  // nothing came: the time stamp
        EXPECT_TRUE(is_open(file));
    }
    EXPECT_FALSE(is_open(file));
}

TEST(CycleCounter, LeavesOneThatDoesNot) {
    const std::vector<std::uint64_t> values{0, 7};
    for (const auto& [first, bytes] : {std::pair(0U, std::size_t{16}), std::pair(1U, std::size_t{4})}) {
        const int file = counter_of(std::span(values).subspan(first), bytes == 16 ? 16 : 4);
        const bench::CycleCounter counter(file);
        EXPECT_EQ(counter.name(), time_stamp);
        EXPECT_FALSE(is_open(file));
        const std::uint64_t before = counter.read();
        for (volatile int i = 0; i < 1000;) {
            i = i + 1;
        }
        EXPECT_GT(counter.read(), before);
    }
    EXPECT_EQ(bench::CycleCounter(-1).name(), time_stamp);
}

// Standard input's number is a file's too.
TEST(CycleCounter, MayBeTheFirstFile) {
    const int input = dup(0);
    const std::vector<std::uint64_t> values{5, 7};
    const int file = counter_of(values, 16);
    ASSERT_EQ(dup2(file, 0), 0);
    close(file);
    EXPECT_EQ(bench::CycleCounter(0).name(), core);
    EXPECT_FALSE(is_open(0));
    if (input >= 0) {
        dup2(input, 0);
        close(input);
    }
}

// Of this machine, whichever it has.
TEST(CycleCounter, GoesOn) {
    const bench::CycleCounter counter;
    const std::uint64_t before = counter.read();
    for (volatile int i = 0; i < 1000;) {
        i = i + 1;
    }
    EXPECT_GT(counter.read(), before + 100);
    EXPECT_TRUE(counter.name() == core || counter.name() == time_stamp);
}

}  // namespace
