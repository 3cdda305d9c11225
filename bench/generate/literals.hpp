// Constants and tables of a header: values in C that every compiler reads back to the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace generate {

template <class T>
[[nodiscard]] constexpr const char* c_type() {
    return std::is_same_v<T, double>          ? "double"
           : std::is_same_v<T, float>         ? "float"
           : std::is_same_v<T, std::uint64_t> ? "uint64_t"
           : std::is_same_v<T, std::uint32_t> ? "uint32_t"
           : std::is_same_v<T, std::int64_t>  ? "int64_t"
           : std::is_same_v<T, std::int32_t>  ? "int32_t"
                                              : "int16_t";
}

/// Reals in decimal with the digits of a round trip, since hex floats are not C++11; unsigned ones are bits.
[[nodiscard]] std::string literal(double value);
[[nodiscard]] std::string literal(float value);
[[nodiscard]] std::string literal(std::int32_t value);
[[nodiscard]] std::string literal(std::uint32_t bits);
[[nodiscard]] std::string literal(std::uint64_t bits);

/// The definition of a constant array, in lines of at most 118 letters, without the end of its last line.
[[nodiscard]] std::string array(const std::string& type, const std::string& name,
                                std::span<const std::string> literals);

template <class T>
[[nodiscard]] std::vector<std::string> literals(std::span<const T> values) {
    std::vector<std::string> texts;
    for (const T value : values) {
        texts.push_back(literal(value));
    }
    return texts;
}

}  // namespace generate
