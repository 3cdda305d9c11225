// NAME=VALUE and numbers, as options take them.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace cli {

/// Of NAME=VALUE both; of a word without `=` the word and nothing.
[[nodiscard]] std::pair<std::string, std::string> split_at_equals(const std::string& word);

/// The whole text as a number; none where it is not one.
template <class Number>
[[nodiscard]] std::optional<Number> to_number(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace cli
