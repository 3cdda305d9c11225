// The lines of a CSV text that hold something, one after the other.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drive {

/// Without blanks, tabs and carriage returns at its ends; what is left is a part of the text, also where it is empty.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The text behind a byte order mark of UTF-8. \throws glsum::Failure (bad input) for one of UTF-16. \param name  of
/// the file
[[nodiscard]] std::string_view behind_byte_order_mark(std::string_view text, const std::string& name);

class CsvLines {
public:
    /// \param name  of the file; outlives this, as the text does
    CsvLines(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    /// The next line that is neither empty nor a comment, without its end of either kind.
    /// \throws glsum::Failure (bad input): longer than `LogLimits::line`
    bool next(std::string_view& line);
    /// Of the line that `next` gave, from 1.
    [[nodiscard]] std::size_t number() const { return number_; }

private:
    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

}  // namespace drive
