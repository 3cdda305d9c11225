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

}  // namespace drive
