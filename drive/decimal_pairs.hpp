// Decimal commas in a file whose fields are apart by commas too, and not quoted.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drive/csv_dialect.hpp"

namespace drive {

/// Of the fields of one line, in twos: `0`, `5`, `1`, `2` are `0,5` and `1,2`. \param fields  an even number
[[nodiscard]] std::vector<Field> joined_pairs(const std::vector<Field>& fields);

/// For a message: how a line with more than `expected` fields would read with decimal commas. Empty if it cannot.
[[nodiscard]] std::string as_decimal_commas(const std::vector<Field>& fields, std::size_t expected);

/// Of a log without a header, whose number of columns nothing tells: a field such as 05 is no number that a logger
/// writes, but what stands behind a comma; unless others have decimal points.
class CommaDoubt {
public:
    /// A line, as long as the lines' fields are not quoted.
    void see(const std::vector<Field>& fields, std::size_t line);
    /// \throws glsum::Failure (bad input) naming file and line, with both readings and the option that decides
    void refuse_if_any(const std::string& file) const;

private:
    bool settled_ = false;  ///< by a decimal point
    std::size_t line_ = 0;  ///< that raised it; 0: none
    std::string field_;
    std::string shown_;
    std::size_t fields_ = 0;
};

}  // namespace drive
