// The plan that the host writes and the firmware carries out, and the text that it answers with.
//
//   glsum-plan-3 <path of the signals> <samples of each signal>
//   <kernel> <order, its 64 bits in hex> <taps> <signal> <calls> <blocks> <a level's> <modes> { <decay> <weight> } ...
//   ...
//
// Signals: one binary file, float64 little-endian, one record after the other. Words are separated by one space; real
// numbers are their 64 bits in hex.
#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "glsum/kernel.hpp"
#include "port.hpp"

namespace firmware {

/// Takes the next word, up to a space or a line's end, off the text.
inline std::string_view take_word(std::string_view& text) {
    const std::size_t end = text.find_first_of(" \n");
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return word;
}

/// Reads a whole word as a number into `value`. \return whether it is one that fits.
template <class Number>
bool to_number(std::string_view word, Number& value, int base = 10) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    return error == std::errc{} && end == word.data() + word.size();
}

/// Of one design.
inline constexpr std::size_t most_modes = 64;

struct PlanRow {
    std::string_view kernel;
    double order;
    std::size_t taps;
    std::size_t signal;
    std::size_t calls;
    glsum::Blocks blocks;
    std::size_t mode_count;
    glsum::Mode modes[most_modes];
    [[nodiscard]] glsum::Design design() const { return {order, taps, {modes, mode_count}, {}, blocks}; }
};

/// Reads a whole word as the bits of a real number. \return whether it is one.
inline bool to_real(std::string_view word, double& value) {
    std::uint64_t bits = 0;
    const bool whole = to_number(word, bits, 16);
    value = std::bit_cast<double>(bits);
    return whole;
}

/// Takes the next row off the plan. \return whether all its words are there and are numbers.
inline bool take_row(std::string_view& plan, PlanRow& row) {
    row.kernel = take_word(plan);
    if (!to_real(take_word(plan), row.order) || !to_number(take_word(plan), row.taps) ||
        !to_number(take_word(plan), row.signal) || !to_number(take_word(plan), row.calls) ||
        !to_number(take_word(plan), row.blocks.count) || !to_number(take_word(plan), row.blocks.per_level) ||
        !to_number(take_word(plan), row.mode_count) || row.mode_count > most_modes) {
        return false;
    }
    for (std::size_t m = 0; m < row.mode_count; ++m) {
        if (!to_real(take_word(plan), row.modes[m].decay) || !to_real(take_word(plan), row.modes[m].weight)) {
            return false;
        }
    }
    return true;
}

/// One line of the answer: words with a separator before each number, then the line's end.
class Answer {
public:
    explicit Answer(std::string_view first, char separator = ' ') : separator_{separator} { add(first); }
    Answer& add(std::string_view word) {
        for (const char letter : word) {
            if (size_ < sizeof text_ - 1) {
                text_[size_++] = letter;
            }
        }
        return *this;
    }
    Answer& number(std::uint64_t value, int base = 10) {
        char digits[24];
        const auto end = std::to_chars(digits, digits + sizeof digits, value, base);
        return add({&separator_, 1}).add({digits, static_cast<std::size_t>(end.ptr - digits)});
    }
    void write() {
        text_[size_++] = '\n';
        port::write({text_, size_});
    }

private:
    char separator_;
    char text_[256];
    std::size_t size_ = 0;
};

}  // namespace firmware
