#include "bench/sweep/sweep.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace bench {

std::optional<Length> parse_length(const std::string& text, std::size_t samples) {
    if (text == "full") {
        return Length{samples, true};
    }
    std::size_t taps = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, taps);
    if (error != std::errc{} || taps < 1 || taps > longest_length) {
        return std::nullopt;
    }
    if (behind == end) {
        return Length{taps};
    }
    std::size_t modes = 0;
    const auto [read_to, fault] = std::from_chars(behind + 1, end, modes);
    if (*behind != '+' || fault != std::errc{} || read_to != end || modes > longest_length) {
        return std::nullopt;
    }
    return Length{taps + 2 * modes, false, modes};
}

RowKey row_key(const std::string& kernel, double order, const Length& length, std::string_view aspect) {
    RowKey key;
    key.kernel = kernel;
    key.order = fmt::format("{}", order);
    key.taps = length.text();
    key.aspect = aspect;
    return key;
}

}  // namespace bench
