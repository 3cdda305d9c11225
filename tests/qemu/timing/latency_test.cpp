// The M7's latencies as measured and published, whatever figures the core's file makes them of.
#include "qemu/timing/latency.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using timing::Consumer;
using timing::Latencies;
using timing::Producer;

Latencies latencies_of_the_m7() { return Latencies(timing::read_core(TEST_CORES, "stm32f746-itcm").sets[0].figures); }

struct Published {
    Producer producer;
    Consumer consumer;
    int cycles;
};

void expect_all(const char* source, const std::vector<Published>& rows) {
    const Latencies latencies = latencies_of_the_m7();
    for (const Published& row : rows) {
        EXPECT_EQ(latencies.between(row.producer, row.consumer), row.cycles)
            << source << ": " << static_cast<int>(row.producer) << " to " << static_cast<int>(row.consumer);
    }
}

// jnk0le/random, "pipeline cycle test/doc/cortex_m7.md", read off an STM32H743.
TEST(Latencies, OfTheCoreAreAsMeasured) {
    expect_all("early and late ALU", {{Producer::early, Consumer::operand, 0},
                                      {Producer::early, Consumer::shifted, 1},
                                      {Producer::early, Consumer::address, 1},
                                      {Producer::base, Consumer::operand, 0},
                                      {Producer::base, Consumer::address, 1},
                                      {Producer::late, Consumer::operand, 1},
                                      {Producer::late, Consumer::shifted, 2},
                                      {Producer::younger_add, Consumer::operand, 1}});
    expect_all("bit fields: no address in the next cycle", {{Producer::bitfield, Consumer::operand, 1},
                                                            {Producer::bitfield, Consumer::address, 2},
                                                            {Producer::bitfield, Consumer::index, 2},
                                                            {Producer::reversed, Consumer::operand, 0},
                                                            {Producer::reversed, Consumer::address, 2},
                                                            {Producer::reversed, Consumer::index, 2}});
    expect_all("words in the next cycle, +1 early; bytes +1 and +2", {{Producer::load_word, Consumer::operand, 1},
                                                                      {Producer::load_word, Consumer::shifted, 2},
                                                                      {Producer::load_word, Consumer::address, 2},
                                                                      {Producer::load_narrow, Consumer::operand, 2},
                                                                      {Producer::load_narrow, Consumer::shifted, 3},
                                                                      {Producer::load_narrow, Consumer::address, 3}});
    expect_all("no word of the cycle before as multiplicand", {{Producer::load_word, Consumer::multiplicand, 2}});
    expect_all("chains of a cycle, +1 for others", {{Producer::multiply, Consumer::accumulator, 1},
                                                    {Producer::multiply, Consumer::operand, 2},
                                                    {Producer::multiply, Consumer::multiplicand, 2}});
    expect_all("an accumulator is read a stage later",
               {{Producer::late, Consumer::accumulator, 0}, {Producer::load_narrow, Consumer::accumulator, 1}});
    expect_all("a store takes any result of its cycle", {{Producer::early, Consumer::store_data, 0},
                                                         {Producer::late, Consumer::store_data, 0},
                                                         {Producer::multiply, Consumer::store_data, 0},
                                                         {Producer::load_word, Consumer::store_data, 0},
                                                         {Producer::load_narrow, Consumer::store_data, 0}});
}

// LLVM's ARMScheduleM7.td and its mutations of latencies, and quinapalus' "data to address 3", "adcs and adcs 2
// cycles".
TEST(Latencies, OfTheCoreAreAsOthersModelThem) {
    expect_all("LLVM: a word that is added to a base +1", {{Producer::load_word, Consumer::index, 3}});
    expect_all("LLVM: beside a shifted operand no fast way",
               {{Producer::load_word, Consumer::operand_beside_shifted, 2},
                {Producer::late, Consumer::operand_beside_shifted, 1}});
    expect_all("LLVM: a product to an address",
               {{Producer::multiply, Consumer::address, 4}, {Producer::multiply, Consumer::index, 4}});
    expect_all("LLVM: SSAT, QADD", {{Producer::saturated, Consumer::operand, 2}});
    expect_all("LLVM: REV comes out of EX1, past no shifter", {{Producer::reversed, Consumer::shifted, 2}});
    expect_all("quinapalus: a carry in the next cycle", {{Producer::flags, Consumer::condition, 1}});
    expect_all("rule Y of the H747 rows",
               {{Producer::younger_add, Consumer::address, 1}, {Producer::younger_add, Consumer::index, 1}});
}

// jnk0le's matrix of the FPU in single precision: to an operand, to VFMA's and VMLA's accumulators, to a store.
TEST(Latencies, OfTheFpuAreTheMeasuredMatrix) {
    const Latencies latencies = latencies_of_the_m7();
    struct Row {
        Producer producer;
        int operand, fma, mla, store;
    };
    constexpr int unmeasured = -1;
    for (const Row& row :
         {Row{Producer::fp_add, 3, 3, 2, 1}, Row{Producer::fp_mul, 3, 3, 2, 1}, Row{Producer::fma, 5, 3, 2, 3},
          Row{Producer::mla, 6, unmeasured, 3, 4}, Row{Producer::fp_load, 1, 3, 2, unmeasured},
          Row{Producer::fp_move, 3, 3, 3, 3}, Row{Producer::core_to_fp, 3, 3, 3, 3}}) {
        const auto name = static_cast<int>(row.producer);
        EXPECT_EQ(latencies.between(row.producer, Consumer::operand), row.operand) << name;
        EXPECT_EQ(latencies.between(row.producer, Consumer::mla_accumulator), row.mla) << name;
        if (row.fma != unmeasured) {
            EXPECT_EQ(latencies.between(row.producer, Consumer::fma_accumulator), row.fma) << name;
        }
        if (row.store != unmeasured) {
            EXPECT_EQ(latencies.between(row.producer, Consumer::store_data), row.store) << name;
        }
    }
    expect_all("VMOV r, s: 1 to the late ALU, 0 to an accumulator",
               {{Producer::to_core, Consumer::operand, 1}, {Producer::to_core, Consumer::accumulator, 0}});
    // Of LLVM's model: conversions, and results in double precision.
    expect_all("LLVM", {{Producer::fp_convert, Consumer::operand, 3},
                        {Producer::add64, Consumer::operand, 4},
                        {Producer::mul64, Consumer::operand, 7},
                        {Producer::mac64, Consumer::operand, 11},
                        {Producer::mac64, Consumer::store_data, 11}});
}

// What is there for long is waited for by nobody; a chain of MACs in double waits for the unit alone, no latency.
TEST(Latencies, AreNoneOfWhatIsThere) {
    const Latencies latencies = latencies_of_the_m7();
    for (std::size_t c = 0; c < static_cast<std::size_t>(Consumer::count); ++c) {
        EXPECT_EQ(latencies.between(Producer::nothing, static_cast<Consumer>(c)), 0);
        for (std::size_t p = 0; p < static_cast<std::size_t>(Producer::count); ++p) {
            EXPECT_GE(latencies.between(static_cast<Producer>(p), static_cast<Consumer>(c)), 0) << p << ' ' << c;
            EXPECT_LE(latencies.between(static_cast<Producer>(p), static_cast<Consumer>(c)),
                      latencies.longest(static_cast<Producer>(p)));
        }
    }
    EXPECT_EQ(latencies.longest(Producer::mla), 6);
    EXPECT_EQ(latencies.longest(Producer::multiply), 4);
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::fma_accumulator), 0);
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::mla_accumulator), 0);
}

}  // namespace
