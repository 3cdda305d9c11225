// The words of a line of text that another program wrote, taken one by one; numbers are whole words within their range.
#pragma once

#include <algorithm>
#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>
#include <system_error>

namespace base {

class Words {
public:
    explicit Words(std::string_view line) : rest_(line) { skip(); }
    [[nodiscard]] bool done() const { return rest_.empty(); }

    /// The next word, up to a space; empty at the end.
    std::string_view next() {
        const std::string_view word = rest_.substr(0, rest_.find(' '));
        rest_.remove_prefix(word.size());
        skip();
        return word;
    }

    /// The next word as a number; empty when it is none of this type (a sign, a letter, too large) or at the end.
    template <std::unsigned_integral Number>
    std::optional<Number> number(int base = 10) {
        const std::string_view word = next();
        Number value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
        return error == std::errc{} && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
    }

private:
    void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }
    std::string_view rest_;
};

}  // namespace base
