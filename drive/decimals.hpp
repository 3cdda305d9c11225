// Numbers with a decimal point or a decimal comma: which of them a file writes, its first fraction shows, and the rest
// is held to it. Thousands are never grouped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drive {

/// Whether the text is one number, with a point or a comma in it, also one that is not finite.
[[nodiscard]] bool looks_like_number(std::string_view text);

class Decimals {
public:
    /// \param file  for messages; outlives this
    /// \param mark  point or comma; empty: as the file shows
    /// \throws glsum::Failure (bad input) for other words
    Decimals(const std::string& file, const std::string& mark);

    /// \throws glsum::Failure (bad input) naming file, line and column: no finite number, or the other mark
    double number(std::string_view field, std::size_t line, std::string_view column);

    /// Whether a fraction was seen behind a comma.
    [[nodiscard]] bool has_commas() const { return mark_ == ',' && line_ != 0; }

private:
    const std::string& file_;
    char mark_ = 0;         ///< 0: not yet known
    std::size_t line_ = 0;  ///< that showed it; 0: none yet
    std::string example_;
};

}  // namespace drive
