// A verdict on a drive as one page, offline: what is named with its numbers; measured, base and base with the effect
// over one another, and what was put in; the record to take next; the ranking; where the gap lies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/verdict/curve.hpp"
#include "gap/verdict/verdict.hpp"

namespace gap {

/// What a page has beside the verdict.
struct Drawn {
    std::vector<Curve> curves;            ///< the records that were judged
    std::optional<NextRecord> next = {};  ///< where one was simulated
    std::string command = {};             ///< how it was asked; empty: not told
};

/// HTML with inline SVG; follows the reader's light or dark scheme and fits a phone.
[[nodiscard]] std::string to_html(const Verdict& verdict, const OfDrive& of, const Drawn& what);

}  // namespace gap
