// What every room uses.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/failure.hpp"
#include "base/glob.hpp"
#include "base/machines.hpp"
#include "base/nearest_name.hpp"
#include "base/parallel.hpp"
#include "base/rounded_up.hpp"
#include "base/words.hpp"

namespace {

TEST(RoundedUp, IsTheLeastNumberOfThreeDigitsThatIsNotBelow) {
    EXPECT_EQ(base::rounded_up(0.00173273), "0.00174");
    EXPECT_EQ(base::rounded_up(0.00173), "0.00173");
    EXPECT_EQ(base::rounded_up(9.991), "10");
    EXPECT_EQ(base::rounded_up(1.2e-7, 1), "2e-07");
    EXPECT_EQ(base::rounded_up(0.0), "0");
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-12.0, 4.0);
    for (int i = 0; i < 10000; ++i) {
        const double bound = std::pow(10.0, exponent(random));
        const double printed = std::stod(base::rounded_up(bound));
        ASSERT_GE(printed, bound);
        ASSERT_LT(printed, bound * 1.01);
    }
}

TEST(NearestName, TakesTheFewestLetters) {
    const std::vector<std::string> names = {"backlash", "end_stop", "gain_error", "gain_drift"};
    EXPECT_EQ(base::nearest_name("bcklash", names), "backlash");
    EXPECT_EQ(base::nearest_name("endstop", names), "end_stop");
    EXPECT_EQ(base::nearest_name("gain_erorr", names), "gain_error");
    EXPECT_EQ(base::letters_between("ab", "ba"), 1U);
    EXPECT_EQ(base::letters_between("", "abc"), 3U);
    EXPECT_EQ(base::letters_between("kitten", "sitting"), 3U);
}

// Each counts one: a letter that is changed, inserted or dropped, and two neighbours that are exchanged.
TEST(NearestName, CountsTheLettersBetween) {
    const struct {
        const char* one;
        const char* other;
        std::size_t letters;
    } known[] = {
        {"", "", 0},         {"abc", "abc", 0},       {"abc", "", 3},      {"abc", "xbc", 1},   {"abc", "axc", 1},
        {"abc", "abx", 1},   {"abc", "xabc", 1},      {"abc", "abxc", 1},  {"abc", "abcx", 1},  {"abcd", "bacd", 1},
        {"abcd", "acbd", 1}, {"abcd", "abdc", 1},     {"abc", "cba", 2},   {"abab", "baba", 2}, {"ab", "cb", 1},
        {"ab", "bc", 2},     {"badcfe", "abcdef", 3}, {"flaw", "lawn", 2}, {"aabb", "bbaa", 3}, {"a", "b", 1},
        {"ca", "abc", 3},  // between exchanged letters nothing is inserted
    };
    for (const auto& [one, other, letters] : known) {
        EXPECT_EQ(base::letters_between(one, other), letters) << one << ' ' << other;
        EXPECT_EQ(base::letters_between(other, one), letters) << other << ' ' << one;
    }
}

TEST(NearestName, TakesTheFirstOfEqualsAndLooksWhereTheNameIs) {
    struct Fault {
        int number;
        std::string name;
    };
    const std::vector<Fault> faults = {{1, "drift"}, {2, "gain"}, {3, "rain"}};
    EXPECT_EQ(base::nearest_name("pain", faults, &Fault::name), "gain");
    EXPECT_EQ(base::nearest_name("rrain", faults, &Fault::name), "rain");
}

TEST(Globs, MatchWholeNames) {
    EXPECT_TRUE(base::matches("ring_*_f32", "ring_plain_f32"));
    EXPECT_FALSE(base::matches("ring_*_f32", "ring_plain_f32x"));
    EXPECT_TRUE(base::matches_any({"a", "ring_?"}, "ring_a"));
    EXPECT_FALSE(base::matches_any({"a", "ring_?"}, "ring_ab"));
    EXPECT_FALSE(base::matches_any({}, "ring_a"));
}

// ARM's manuals: a Cortex-M7 issues two instructions a cycle, a Cortex-M4 one.
TEST(Machines, AreFoundByTheirWordAndTheirCore) {
    EXPECT_EQ(base::machine_words()[0], "m7");
    EXPECT_EQ(base::machine_words()[1], "m4");
    ASSERT_NE(base::machine_called("m4"), nullptr);
    EXPECT_EQ(base::machine_called("m4")->core, "cortex-m4");
    EXPECT_EQ(base::machine_called("m7")->issues_a_cycle, 2U);
    EXPECT_EQ(base::machine_called("m4")->issues_a_cycle, 1U);
    EXPECT_EQ(base::machine_called("m3"), nullptr);
    EXPECT_EQ(base::machine_of_core("cortex-m7").word, "m7");
    EXPECT_EQ(base::machine_of_core("cortex-m4").word, "m4");
    EXPECT_EQ(base::machine_of_core("unheard-of").word, "m7");  // the first one
}

TEST(Words, AreTakenOneByOne) {
    base::Words words("  row 19  ff x");
    EXPECT_FALSE(words.done());
    EXPECT_EQ(words.next(), "row");
    EXPECT_EQ(words.number<std::uint32_t>(), 19U);
    EXPECT_EQ(words.number<std::uint32_t>(16), 255U);
    EXPECT_FALSE(words.done());
    EXPECT_EQ(words.next(), "x");
    EXPECT_TRUE(words.done());
    EXPECT_EQ(words.next(), "");
    EXPECT_FALSE(words.number<std::uint32_t>());
    EXPECT_TRUE(base::Words("   ").done());
    EXPECT_TRUE(base::Words("").done());
    base::Words spaced("a   ");
    EXPECT_EQ(spaced.next(), "a");
    EXPECT_TRUE(spaced.done());
}

// Whole words within the type's range; what is none is taken all the same.
TEST(Words, NumbersAreWholeWordsWithinTheirRange) {
    base::Words words("-1 +1 4x 256 255 0 18446744073709551616 18446744073709551615");
    EXPECT_FALSE(words.number<std::uint32_t>());
    EXPECT_FALSE(words.number<std::uint32_t>());
    EXPECT_FALSE(words.number<std::uint32_t>());
    EXPECT_FALSE(words.number<std::uint8_t>());
    EXPECT_EQ(words.number<std::uint8_t>(), std::uint8_t{255});
    EXPECT_EQ(words.number<std::uint8_t>(), std::uint8_t{0});
    EXPECT_FALSE(words.number<std::uint64_t>());
    EXPECT_EQ(words.number<std::uint64_t>(), ~std::uint64_t{0});
    EXPECT_TRUE(words.done());
}

TEST(Parallel, EachPieceIsDoneOnce) {
    for (const unsigned jobs : {0U, 1U, 2U, 5U}) {
        std::vector<std::atomic<int>> done(100);
        base::parallel_for(done.size(), jobs, [&](std::size_t i) { ++done[i]; });
        for (const auto& times : done) {
            EXPECT_EQ(times.load(), 1) << jobs;
        }
        base::parallel_for(0, jobs, [](std::size_t) { ADD_FAILURE() << "there was nothing to do"; });
    }
    // One after the other by the caller itself, where no more are asked for.
    std::vector<std::size_t> order;
    const std::thread::id caller = std::this_thread::get_id();
    base::parallel_for(4, 1, [&](std::size_t i) {
        order.push_back(i);
        EXPECT_EQ(std::this_thread::get_id(), caller);
    });
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3}));
}

// Three at once are waited for; a fourth, if there were one, had time to come.
TEST(Parallel, AsManyAreAtWorkAsWereAskedFor) {
    std::atomic<int> at_work = 0;
    std::atomic<int> most = 0;
    base::parallel_for(4, 3, [&](std::size_t i) {
        const int now = ++at_work;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        const auto begin = std::chrono::steady_clock::now();
        while (i < 3 && most < 3 && std::chrono::steady_clock::now() - begin < std::chrono::seconds(10)) {
            std::this_thread::yield();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        --at_work;
    });
    EXPECT_EQ(most.load(), 3);
}

TEST(Parallel, AFailureEndsTheWorkAndIsThrownAgain) {
    std::vector<std::size_t> begun;
    try {
        base::parallel_for(10, 1, [&](std::size_t i) {
            begun.push_back(i);
            if (i == 2) {
                throw std::runtime_error("the third");
            }
        });
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the third");
    }
    EXPECT_EQ(begun, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_THROW(base::parallel_for(10, 3, [](std::size_t) { throw std::runtime_error("all"); }), std::runtime_error);
}

// The statuses that scripts ask for, as the manual has them.
TEST(Failures, EndWithTheirStatus) {
    EXPECT_EQ(static_cast<int>(glsum::Exit::good), 0);
    EXPECT_EQ(static_cast<int>(glsum::Exit::check_failed), 1);
    EXPECT_EQ(static_cast<int>(glsum::Exit::bad_input), 2);
    EXPECT_EQ(static_cast<int>(glsum::Exit::missing), 3);
    EXPECT_EQ(static_cast<int>(glsum::Exit::not_comparable), 4);
    const glsum::Failure failure(glsum::Exit::missing, "no board");
    EXPECT_EQ(failure.status(), glsum::Exit::missing);
    EXPECT_STREQ(failure.what(), "no board");
}

}  // namespace
