// Constants and tables of a header: values in C that every compiler reads back to the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace generate {

/// A type of C with its values, each exactly a double or a 64-bit integer.
struct Numbers {
    std::string type;  ///< "float", "double", "int32_t", "int16_t"
    std::vector<double> reals;
    std::vector<std::int64_t> integers;
};

/// Decimal with the digits of a round trip, since hex floats are not C++11. \param type  "float" or "double"
[[nodiscard]] std::string real_literal(const std::string& type, double value);

/// Bits as an unsigned constant. \param wide  of 64 bits, else of 32
[[nodiscard]] std::string bits_literal(std::uint64_t bits, bool wide);

[[nodiscard]] std::vector<std::string> literals(const Numbers& numbers);
[[nodiscard]] std::vector<std::string> literals(std::span<const std::uint64_t> bits, bool wide);

/// Two coefficients a word, the first in the lower half.
[[nodiscard]] std::vector<std::string> words_of_pairs(const std::vector<std::int64_t>& coefficients);

/// The definition of a constant array, in lines of at most 118 letters.
[[nodiscard]] std::string array(const std::string& type, const std::string& name,
                                const std::vector<std::string>& literals);

}  // namespace generate
