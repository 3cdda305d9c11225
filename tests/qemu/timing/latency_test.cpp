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

// Of what the core file only assumes, or nobody waits for in a usual program, by the figures it has.
TEST(Latencies, OfSeldomUsesFollowFromTheirFigures) {
    expect_all("VCMP to VMRS", {{Producer::compare, Consumer::condition, 1}});
    expect_all("as VMOV s, s", {{Producer::fp_immediate, Consumer::operand, 3},
                                {Producer::fp_immediate, Consumer::store_data, 3},
                                {Producer::fp_immediate, Consumer::mla_accumulator, 3}});
    expect_all("as a store of it", {{Producer::mla, Consumer::fma_accumulator, 4}});
    expect_all("as to other consumers", {{Producer::fp_load, Consumer::store_data, 1}});
    expect_all("a quotient is a late result", {{Producer::divide, Consumer::operand, 1},
                                               {Producer::divide, Consumer::address, 2},
                                               {Producer::divide, Consumer::accumulator, 0}});
}

// A result of stage n is waited for by what reads at stage m for n - m cycles, or not at all.
TEST(Latencies, AreFromTheStageOfTheResultToTheStageOfItsUse) {
    timing::Figures figures;
    figures.read_address = 1;
    figures.read_shifted = 2;
    figures.read_operand = 4;
    figures.read_multiplicand = 6;
    figures.read_accumulator = 9;
    figures.read_store_data = 12;
    figures.read_condition = 16;
    figures.result_early = 20;
    figures.result_late = 30;
    figures.result_base = 40;
    figures.result_bitfield = 50;
    figures.result_saturated = 60;
    figures.result_load_narrow = 70;
    figures.result_flags = 80;
    figures.result_multiply = 90;
    figures.fp_to_core = 100;
    figures.result_multiply_to_address_extra = 1000;
    const Latencies latencies(figures);
    struct Result {
        Producer producer;
        std::int64_t stage;
    };
    for (const Result& result :
         {Result{Producer::early, 20}, Result{Producer::late, 30}, Result{Producer::base, 40},
          Result{Producer::bitfield, 50}, Result{Producer::saturated, 60}, Result{Producer::load_narrow, 70},
          Result{Producer::flags, 80}, Result{Producer::multiply, 90}, Result{Producer::to_core, 100},
          Result{Producer::divide, 30}}) {
        const std::int64_t extra = result.producer == Producer::multiply ? 1000 : 0;
        const auto cycles = [&](Consumer consumer) { return latencies.between(result.producer, consumer); };
        EXPECT_EQ(cycles(Consumer::address), result.stage + extra - 1) << result.stage;
        EXPECT_EQ(cycles(Consumer::index), result.stage + extra - 1) << result.stage;
        EXPECT_EQ(cycles(Consumer::shifted), result.stage - 2) << result.stage;
        EXPECT_EQ(cycles(Consumer::operand), result.stage - 4) << result.stage;
        EXPECT_EQ(cycles(Consumer::operand_beside_shifted), result.stage - 4) << result.stage;
        EXPECT_EQ(cycles(Consumer::multiplicand), result.stage - 6) << result.stage;
        EXPECT_EQ(cycles(Consumer::accumulator), result.stage - 9) << result.stage;
        EXPECT_EQ(cycles(Consumer::store_data), result.stage - 12) << result.stage;
        EXPECT_EQ(cycles(Consumer::condition), result.stage - 16) << result.stage;
        EXPECT_EQ(latencies.longest(result.producer), result.stage + extra - 1) << result.stage;
    }
    figures.result_load_word = 10;
    figures.result_load_to_index_extra = 200;
    figures.result_load_to_multiplicand_extra = 300;
    figures.result_load_beside_shifted_extra = 400;
    figures.result_younger_add_to_address = 25;
    figures.result_reverse = 45;
    figures.fp_compare_to_status = 7;
    const Latencies with_bypasses(figures);
    const auto cycles = [&](Producer producer, Consumer consumer) { return with_bypasses.between(producer, consumer); };
    EXPECT_EQ(cycles(Producer::load_word, Consumer::address), 10 - 1);
    EXPECT_EQ(cycles(Producer::load_word, Consumer::index), 10 + 200 - 1);
    EXPECT_EQ(cycles(Producer::load_word, Consumer::operand), 10 - 4);
    EXPECT_EQ(cycles(Producer::load_word, Consumer::operand_beside_shifted), 10 + 400 - 4);
    EXPECT_EQ(cycles(Producer::load_word, Consumer::multiplicand), 10 + 300 - 6);
    EXPECT_EQ(cycles(Producer::load_word, Consumer::store_data), 0);  // later than it comes
    EXPECT_EQ(cycles(Producer::younger_add, Consumer::address), 25 - 1);
    EXPECT_EQ(cycles(Producer::younger_add, Consumer::index), 25 - 1);
    EXPECT_EQ(cycles(Producer::younger_add, Consumer::shifted), 30 - 2);  // as a late one
    EXPECT_EQ(cycles(Producer::reversed, Consumer::operand), 45 - 4);
    EXPECT_EQ(cycles(Producer::reversed, Consumer::address), 50 - 1);  // as a bit field's
    EXPECT_EQ(cycles(Producer::reversed, Consumer::shifted), 50 - 2);
    EXPECT_EQ(cycles(Producer::compare, Consumer::condition), 7);  // no stages: so many cycles to any use
    EXPECT_EQ(cycles(Producer::compare, Consumer::operand), 7);
}

// Where an instruction needs a register decides which of its latencies counts.
TEST(Latencies, AUseIsAsItsRoleAndItsUnitSay) {
    using timing::Role;
    timing::Decoded integer;
    integer.read(Role::operand, 1);
    const std::pair<Role, Consumer> of_the_core[] = {
        {Role::address, Consumer::address},         {Role::index, Consumer::index},
        {Role::shifted, Consumer::shifted},         {Role::condition, Consumer::condition},
        {Role::store_data, Consumer::store_data},   {Role::multiplicand, Consumer::multiplicand},
        {Role::accumulator, Consumer::accumulator}, {Role::operand, Consumer::operand}};
    for (const auto& [role, consumer] : of_the_core) {
        EXPECT_EQ(timing::consumer_of(integer, role), consumer) << static_cast<int>(role);
    }
    timing::Decoded unit;
    unit.is_fp = true;
    EXPECT_EQ(timing::consumer_of(unit, Role::multiplicand), Consumer::operand);
    EXPECT_EQ(timing::consumer_of(unit, Role::accumulator), Consumer::mla_accumulator);
    unit.fused = true;
    EXPECT_EQ(timing::consumer_of(unit, Role::accumulator), Consumer::fma_accumulator);
    integer.read(Role::shifted, 2);
    EXPECT_EQ(timing::consumer_of(integer, Role::operand), Consumer::operand_beside_shifted);
    EXPECT_EQ(timing::consumer_of(integer, Role::shifted), Consumer::shifted);
}

TEST(Latencies, AWaitIsNamedAfterWhatItIsFor) {
    using timing::Effect;
    for (std::size_t p = 0; p < static_cast<std::size_t>(Producer::count); ++p) {
        const auto producer = static_cast<Producer>(p);
        const bool loads =
            producer == Producer::load_word || producer == Producer::load_narrow || producer == Producer::fp_load;
        const Effect expected = loads                            ? Effect::load_use
                                : producer == Producer::multiply ? Effect::mac_latency
                                : producer >= Producer::to_core  ? Effect::fpu_latency
                                                                 : Effect::result_latency;
        EXPECT_EQ(timing::effect_of(producer), expected) << p;
    }
}

}  // namespace
