// Which of the descriptions that were found causes are looked for beside.
#pragma once

#include <vector>

#include "gap/drive/base/find.hpp"

namespace gap {

/// The base that does best by itself, the best ones of fewer and of more numbers, and the best that integrates where it
/// does not, or the other way round: beside an effect a simpler one may do as well, and what seems an effect may be a
/// lag that a richer one has. \param found  the best first \return into it
[[nodiscard]] std::vector<const Described*> worth_asking(const std::vector<Described>& found);

/// Null: none was found.
[[nodiscard]] const Described* with_one_lag_more(const std::vector<Described>& found, const Described& than);

/// Of a spring's or a weight's plant, whose mass may be too small to tell its lag from the records: the best of two
/// lags, whole or fractional, whose output is no speed. A fractional one that has been asked has bent to what pulls, as
/// a whole one cannot: then the whole one. Null: there is none.
[[nodiscard]] const Described* with_a_place(const std::vector<Described>& found,
                                            const std::vector<const Described*>& asked);

/// The one of fewest numbers that integrates as often: a richer one has bent to what an effect does, so that the effect
/// beside it explains less. It may be the same one. \param of  one of them
[[nodiscard]] const Described* simplest_like(const std::vector<Described>& found, const Described& of);

}  // namespace gap
