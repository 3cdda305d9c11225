// A program made by hand as the firmware's `measure` is, and the call log of its instrument's check.
#pragma once

#include <string>

#include "tests/qemu/made_elf.hpp"

namespace test {

// The loops whose counts targets/firmware/check_loops.S derives: of each turn, and once.
struct Loop {
    const char* name;
    int turn[4];
    int once[4];
};
inline constexpr Loop loops[] = {
    {"glsum_check_steps", {4, 1, 1, 1}, {1, 0, 0, 1}},    {"glsum_check_one_more", {4, 1, 1, 1}, {2, 0, 0, 1}},
    {"glsum_check_multiple", {4, 4, 4, 1}, {3, 2, 2, 1}}, {"glsum_check_wide", {8, 7, 7, 1}, {1, 0, 0, 1}},
    {"glsum_check_edge", {4, 1, 1, 1}, {3, 0, 0, 1}},     {"glsum_check_skipped", {5, 0, 0, 1}, {1, 0, 0, 1}},
    {"glsum_check_nested", {6, 1, 1, 3}, {3, 2, 2, 1}},
};

inline constexpr std::uint32_t ring = 0x400;
inline constexpr std::uint32_t block = 0x440;
inline constexpr std::uint32_t block_answer = 0x480;

// A program with two kernels, one in halves; marks and loops. The first may be another.
inline MadeElf program(const std::string& first = "ring_plain_f32") {
    const std::string names = first + "block_plain_q31";
    const auto length = static_cast<std::uint32_t>(first.size());
    std::vector<std::uint8_t> text(names.begin(), names.end());
    MadeElf made;
    made.sections = {
        {0x1000, text},
        {0x2000, bytes_of({0x1000, length, ring + 1, 0, 0x1000 + length, 15, block + 1, block_answer + 1, 2})}};
    made.symbols = {{"glsum_watched", 0x2000, 32},
                    {"glsum_watched_count", 0x2020, 4},
                    {"glsum_mark_row", 0x601, 2, true},
                    {"glsum_mark_on", 0x611, 2, true},
                    {"glsum_mark_off", 0x621, 2, true},
                    {"step_of_ring", ring + 1, 0x20, true},
                    {"step_of_block", block + 1, 0x30, true},
                    {"helper", 0x501, 0x10, true}};
    std::uint32_t at = 0x801;
    for (const Loop& loop : loops) {
        made.symbols.push_back({loop.name, at, 0x10, true});
        at += 0x10;
    }
    return made;
}

inline std::string calls(std::uint32_t entry, int count, const char* counts) {
    return "calls " + std::to_string(entry) + ' ' + std::to_string(count) + ' ' + counts + '\n';
}

inline std::string check_calls() {
    std::string log;
    std::uint32_t at = 0x800;
    for (const Loop& loop : loops) {
        for (const int turns : {1, 10, 1000}) {
            std::string counts;
            for (int i = 0; i < 4; ++i) {
                counts += (i > 0 ? " " : "") + std::to_string(loop.turn[i] * turns + loop.once[i]);
            }
            log += calls(at, 1, counts.c_str());
        }
        at += 0x10;
    }
    return log;
}

}  // namespace test
