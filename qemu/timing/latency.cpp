#include "qemu/timing/latency.hpp"

#include <algorithm>

namespace timing {

Effect effect_of(Producer producer) {
    switch (producer) {
        case Producer::load_word:
        case Producer::load_narrow:
        case Producer::fp_load:
            return Effect::load_use;
        case Producer::multiply:
            return Effect::mac_latency;
        case Producer::to_core:
        case Producer::compare:
        case Producer::fp_add:
        case Producer::fp_mul:
        case Producer::fma:
        case Producer::mla:
        case Producer::fp_convert:
        case Producer::fp_move:
        case Producer::core_to_fp:
        case Producer::fp_immediate:
        case Producer::add64:
        case Producer::mul64:
        case Producer::mac64:
            return Effect::fpu_latency;
        default:
            return Effect::result_latency;
    }
}

Latencies::Latencies(const Figures& f) {
    const auto set = [&](Producer p, Consumer c, std::int64_t cycles) {
        table_[static_cast<std::size_t>(p)][static_cast<std::size_t>(c)] = std::max<std::int64_t>(0, cycles);
    };
    struct Stage {
        Consumer consumer;
        std::int64_t stage;
    };
    const Stage stages[] = {
        {Consumer::address, f.read_address},
        {Consumer::index, f.read_address},
        {Consumer::shifted, f.read_shifted},
        {Consumer::operand, f.read_operand},
        {Consumer::operand_beside_shifted, f.read_operand},
        {Consumer::multiplicand, f.read_multiplicand},
        {Consumer::accumulator, f.read_accumulator},
        {Consumer::store_data, f.read_store_data},
        {Consumer::condition, f.read_condition},
        {Consumer::fma_accumulator, f.read_operand},
        {Consumer::mla_accumulator, f.read_operand},
    };
    const auto staged = [&](Producer producer, std::int64_t result) {
        for (const Stage& stage : stages) {
            set(producer, stage.consumer, result - stage.stage);
        }
    };
    staged(Producer::early, f.result_early);
    staged(Producer::late, f.result_late);
    staged(Producer::younger_add, f.result_late);
    const auto as_address = [&](Producer producer, std::int64_t result) {
        set(producer, Consumer::address, result - f.read_address);
        set(producer, Consumer::index, result - f.read_address);
    };
    as_address(Producer::younger_add, f.result_younger_add_to_address);
    staged(Producer::bitfield, f.result_bitfield);
    staged(Producer::reversed, f.result_reverse);
    as_address(Producer::reversed, f.result_bitfield);
    set(Producer::reversed, Consumer::shifted, f.result_bitfield - f.read_shifted);
    staged(Producer::saturated, f.result_saturated);
    staged(Producer::base, f.result_base);
    staged(Producer::load_word, f.result_load_word);
    staged(Producer::load_narrow, f.result_load_narrow);
    // A word comes early, by a bypass that leads to the ALU alone; a byte or half comes a cycle later to every use.
    set(Producer::load_word, Consumer::index, f.result_load_word + f.result_load_to_index_extra - f.read_address);
    set(Producer::load_word, Consumer::operand_beside_shifted,
        f.result_load_word + f.result_load_beside_shifted_extra - f.read_operand);
    set(Producer::load_word, Consumer::multiplicand,
        f.result_load_word + f.result_load_to_multiplicand_extra - f.read_multiplicand);
    staged(Producer::multiply, f.result_multiply);
    as_address(Producer::multiply, f.result_multiply + f.result_multiply_to_address_extra);
    staged(Producer::divide, f.result_late);
    staged(Producer::flags, f.result_flags);
    staged(Producer::to_core, f.fp_to_core);
    for (const Stage& stage : stages) {
        set(Producer::compare, stage.consumer, f.fp_compare_to_status);
    }

    const auto floating = [&](Producer producer, std::int64_t operand, std::int64_t fma, std::int64_t mla,
                              std::int64_t store) {
        set(producer, Consumer::operand, operand);
        set(producer, Consumer::fma_accumulator, fma);
        set(producer, Consumer::mla_accumulator, mla);
        set(producer, Consumer::store_data, store);
    };
    floating(Producer::fp_add, f.fp_add_to_operand, f.fp_add_to_fma_accumulator, f.fp_add_to_mla_accumulator,
             f.fp_add_to_store);
    floating(Producer::fp_mul, f.fp_mul_to_operand, f.fp_mul_to_fma_accumulator, f.fp_mul_to_mla_accumulator,
             f.fp_mul_to_store);
    floating(Producer::fma, f.fp_fma_to_operand, f.fp_fma_to_fma_accumulator, f.fp_fma_to_mla_accumulator,
             f.fp_fma_to_store);
    floating(Producer::mla, f.fp_mla_to_operand, f.fp_mla_to_fma_accumulator, f.fp_mla_to_mla_accumulator,
             f.fp_mla_to_store);
    floating(Producer::fp_load, f.fp_load_to_operand, f.fp_load_to_fma_accumulator, f.fp_load_to_mla_accumulator,
             f.fp_load_to_store);
    const auto same = [&](Producer producer, std::int64_t cycles) {
        floating(producer, cycles, cycles, cycles, cycles);
    };
    same(Producer::fp_convert, f.fp_convert_to_use);
    same(Producer::fp_move, f.fp_move_to_use);
    same(Producer::core_to_fp, f.fp_core_to_fp);
    same(Producer::fp_immediate, f.fp_immediate_to_use);
    same(Producer::add64, f.fp64_add_to_use);
    same(Producer::mul64, f.fp64_mul_to_use);
    floating(Producer::mac64, f.fp64_mac_to_use, 0, 0, f.fp64_mac_to_use);  // chains wait for the unit alone
}

Consumer consumer_of(const Decoded& reader, Role role) {
    switch (role) {
        case Role::address:
            return Consumer::address;
        case Role::index:
            return Consumer::index;
        case Role::shifted:
            return Consumer::shifted;
        case Role::condition:
            return Consumer::condition;
        case Role::store_data:
            return Consumer::store_data;
        case Role::multiplicand:
            return reader.is_fp ? Consumer::operand : Consumer::multiplicand;
        case Role::accumulator:
            if (!reader.is_fp) {
                return Consumer::accumulator;
            }
            return reader.fused ? Consumer::fma_accumulator : Consumer::mla_accumulator;
        case Role::operand:
            break;
    }
    const auto reads_early = [](const Read& read) { return read.role == Role::shifted; };
    return std::ranges::any_of(reader.all_reads(), reads_early) ? Consumer::operand_beside_shifted : Consumer::operand;
}

}  // namespace timing
