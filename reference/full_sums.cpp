#include "reference/full_sums.hpp"

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace reference {
namespace {

using Integer = boost::multiprecision::mpz_int;

// Numbers are whole multiples of 2^-160. A sum of 2^32 products below 2^(64 + 64), twice the places behind the point
// and a sign take less than 512 bits: one digit.
constexpr int places = 160;
constexpr std::size_t words = 8;
constexpr int word_bits = 64;

// sum_k digit_k B^k, B = 2^512.
Integer in_one(const std::vector<Real>& numbers) {
    std::vector<std::uint64_t> positive(numbers.size() * words, 0);
    std::vector<std::uint64_t> negative(numbers.size() * words, 0);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (!(abs(numbers[k]) < ldexp(Real(1), word_bits))) {
            throw std::invalid_argument("full_sums: a number of 2^64 or more");
        }
        const Integer digit(Real(round(ldexp(numbers[k], places))));
        std::vector<std::uint64_t>& of_sign = digit < 0 ? negative : positive;
        mpz_export(&of_sign[k * words], nullptr, -1, sizeof(std::uint64_t), 0, 0, digit.backend().data());
    }
    const auto whole = [](const std::vector<std::uint64_t>& digits) {
        Integer number;
        mpz_import(number.backend().data(), digits.size(), -1, sizeof(std::uint64_t), 0, 0, digits.data());
        return number;
    };
    return whole(positive) - whole(negative);
}

}  // namespace

Sums full_sums(std::span<const Real> a, std::span<const double> record) {
    if (record.empty()) {
        return {};
    }
    const auto count = static_cast<std::ptrdiff_t>(record.size());
    const Integer product = in_one({a.begin(), a.begin() + count}) * in_one({record.begin(), record.end()});
    std::vector<std::uint64_t> digits(mpz_size(product.backend().data()) + words, 0);
    mpz_export(digits.data(), nullptr, -1, sizeof(std::uint64_t), 0, 0, product.backend().data());
    digits.resize(std::max(digits.size(), record.size() * words), 0);
    const bool all_negative = product < 0;
    Sums sums;
    sums.reserve(record.size());
    Integer borrowed = 0;  // by the digit before, which was negative
    for (std::size_t k = 0; k < record.size(); ++k) {
        Integer digit;
        mpz_import(digit.backend().data(), words, -1, sizeof(std::uint64_t), 0, 0, &digits[k * words]);
        digit += borrowed;
        borrowed = 0;
        if (mpz_sizeinbase(digit.backend().data(), 2) >= words * word_bits) {
            mpz_sub(digit.backend().data(), digit.backend().data(),
                    (Integer(1) << (words * word_bits)).backend().data());
            borrowed = 1;
        }
        sums.emplace_back(ldexp(Real(all_negative ? Integer(-digit) : digit), -2 * places));
    }
    return sums;
}

}  // namespace reference
