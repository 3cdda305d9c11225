// Which figure of a core file says how long a use waits for a result, by figures that are all different.
#include "qemu/timing/latency.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using timing::Consumer;
using timing::Figures;
using timing::Latencies;
using timing::Producer;

// What is ready in a stage and read in another waits for the difference: results far behind all reads, so that none is
// cut off at 0.
Figures distinct() {
    Figures f;
    std::int64_t read = 1;
    for (auto figure :
         {&Figures::read_address, &Figures::read_shifted, &Figures::read_operand, &Figures::read_multiplicand,
          &Figures::read_accumulator, &Figures::read_store_data, &Figures::read_condition}) {
        f.*figure = read;
        read *= 2;
    }
    std::int64_t result = 1000;
    for (auto figure : {&Figures::result_early,
                        &Figures::result_late,
                        &Figures::result_younger_add_to_address,
                        &Figures::result_bitfield,
                        &Figures::result_reverse,
                        &Figures::result_saturated,
                        &Figures::result_base,
                        &Figures::result_load_word,
                        &Figures::result_load_narrow,
                        &Figures::result_load_to_index_extra,
                        &Figures::result_load_beside_shifted_extra,
                        &Figures::result_load_to_multiplicand_extra,
                        &Figures::result_multiply,
                        &Figures::result_multiply_to_address_extra,
                        &Figures::result_flags,
                        &Figures::fp_to_core,
                        &Figures::fp_compare_to_status,
                        &Figures::fp_convert_to_use,
                        &Figures::fp_move_to_use,
                        &Figures::fp_core_to_fp,
                        &Figures::fp_immediate_to_use,
                        &Figures::fp64_add_to_use,
                        &Figures::fp64_mul_to_use,
                        &Figures::fp64_mac_to_use}) {
        f.*figure = result;
        result += 1000;
    }
    return f;
}

std::map<Consumer, std::int64_t> stages_of(const Figures& f) {
    return {{Consumer::address, f.read_address},
            {Consumer::index, f.read_address},
            {Consumer::shifted, f.read_shifted},
            {Consumer::operand, f.read_operand},
            {Consumer::operand_beside_shifted, f.read_operand},
            {Consumer::multiplicand, f.read_multiplicand},
            {Consumer::accumulator, f.read_accumulator},
            {Consumer::store_data, f.read_store_data},
            {Consumer::condition, f.read_condition},
            {Consumer::fma_accumulator, f.read_operand},
            {Consumer::mla_accumulator, f.read_operand}};
}

TEST(Latencies, OfTheCoreAreFromItsResultsStageToItsUses) {
    const Figures f = distinct();
    const Latencies latencies(f);
    const std::map<Producer, std::int64_t> results{{Producer::early, f.result_early},
                                                   {Producer::late, f.result_late},
                                                   {Producer::younger_add, f.result_late},
                                                   {Producer::bitfield, f.result_bitfield},
                                                   {Producer::reversed, f.result_reverse},
                                                   {Producer::saturated, f.result_saturated},
                                                   {Producer::base, f.result_base},
                                                   {Producer::load_word, f.result_load_word},
                                                   {Producer::load_narrow, f.result_load_narrow},
                                                   {Producer::multiply, f.result_multiply},
                                                   {Producer::divide, f.result_late},
                                                   {Producer::flags, f.result_flags},
                                                   {Producer::to_core, f.fp_to_core}};
    // But for these, which have a way, or a wait, of their own.
    const std::map<std::pair<Producer, Consumer>, std::int64_t> others{
        {{Producer::younger_add, Consumer::address}, f.result_younger_add_to_address},
        {{Producer::younger_add, Consumer::index}, f.result_younger_add_to_address},
        {{Producer::reversed, Consumer::address}, f.result_bitfield},  // early for the ALU alone
        {{Producer::reversed, Consumer::index}, f.result_bitfield},
        {{Producer::reversed, Consumer::shifted}, f.result_bitfield},
        {{Producer::load_word, Consumer::index}, f.result_load_word + f.result_load_to_index_extra},
        {{Producer::load_word, Consumer::operand_beside_shifted},
         f.result_load_word + f.result_load_beside_shifted_extra},
        {{Producer::load_word, Consumer::multiplicand}, f.result_load_word + f.result_load_to_multiplicand_extra},
        {{Producer::multiply, Consumer::address}, f.result_multiply + f.result_multiply_to_address_extra},
        {{Producer::multiply, Consumer::index}, f.result_multiply + f.result_multiply_to_address_extra}};
    for (const auto& [producer, result] : results) {
        std::int64_t longest = 0;
        for (const auto& [consumer, stage] : stages_of(f)) {
            const auto other = others.find({producer, consumer});
            const std::int64_t expected = (other != others.end() ? other->second : result) - stage;
            EXPECT_EQ(latencies.between(producer, consumer), expected)
                << static_cast<int>(producer) << " to " << static_cast<int>(consumer);
            longest = std::max(longest, expected);
        }
        EXPECT_EQ(latencies.longest(producer), longest);
    }
    for (const auto& [consumer, stage] : stages_of(f)) {
        EXPECT_EQ(latencies.between(Producer::nothing, consumer), 0);
        EXPECT_EQ(latencies.between(Producer::compare, consumer), f.fp_compare_to_status);
    }
}

// What is there before it is read waits for nothing.
TEST(Latencies, AreNotBelowZero) {
    Figures f = distinct();
    f.read_operand = 5000;
    EXPECT_EQ(Latencies(f).between(Producer::early, Consumer::operand), 0);
}

TEST(Latencies, OfTheFpuAreAFigureForEachUse) {
    Figures f = distinct();
    const auto uses = [](std::int64_t Figures::*operand, std::int64_t Figures::*fma, std::int64_t Figures::*mla,
                         std::int64_t Figures::*store) {
        return std::array{operand, fma, mla, store};
    };
    const std::map<Producer, std::array<std::int64_t Figures::*, 4>> rows{
        {Producer::fp_add, uses(&Figures::fp_add_to_operand, &Figures::fp_add_to_fma_accumulator,
                                &Figures::fp_add_to_mla_accumulator, &Figures::fp_add_to_store)},
        {Producer::fp_mul, uses(&Figures::fp_mul_to_operand, &Figures::fp_mul_to_fma_accumulator,
                                &Figures::fp_mul_to_mla_accumulator, &Figures::fp_mul_to_store)},
        {Producer::fma, uses(&Figures::fp_fma_to_operand, &Figures::fp_fma_to_fma_accumulator,
                             &Figures::fp_fma_to_mla_accumulator, &Figures::fp_fma_to_store)},
        {Producer::mla, uses(&Figures::fp_mla_to_operand, &Figures::fp_mla_to_fma_accumulator,
                             &Figures::fp_mla_to_mla_accumulator, &Figures::fp_mla_to_store)},
        {Producer::fp_load, uses(&Figures::fp_load_to_operand, &Figures::fp_load_to_fma_accumulator,
                                 &Figures::fp_load_to_mla_accumulator, &Figures::fp_load_to_store)}};
    std::int64_t next = 1;
    for (const auto& [producer, figures] : rows) {
        for (auto figure : figures) {
            f.*figure = next++;
        }
    }
    const Latencies latencies(f);
    const Consumer consumers[] = {Consumer::operand, Consumer::fma_accumulator, Consumer::mla_accumulator,
                                  Consumer::store_data};
    for (const auto& [producer, figures] : rows) {
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(latencies.between(producer, consumers[i]), f.*figures[i]) << static_cast<int>(producer) << i;
        }
    }
    const std::map<Producer, std::int64_t> same{
        {Producer::fp_convert, f.fp_convert_to_use}, {Producer::fp_move, f.fp_move_to_use},
        {Producer::core_to_fp, f.fp_core_to_fp},     {Producer::fp_immediate, f.fp_immediate_to_use},
        {Producer::add64, f.fp64_add_to_use},        {Producer::mul64, f.fp64_mul_to_use}};
    for (const auto& [producer, cycles] : same) {
        for (const Consumer consumer : consumers) {
            EXPECT_EQ(latencies.between(producer, consumer), cycles) << static_cast<int>(producer);
        }
    }
    // Multiplications with additions in double wait for the unit alone.
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::operand), f.fp64_mac_to_use);
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::store_data), f.fp64_mac_to_use);
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::fma_accumulator), 0);
    EXPECT_EQ(latencies.between(Producer::mac64, Consumer::mla_accumulator), 0);
}

}  // namespace
