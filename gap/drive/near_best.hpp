// Candidates close to the best ones that were found: with one of its effects exchanged, left out, or beside what the
// readings show.
#pragma once

#include <vector>

#include "gap/drive/fit.hpp"
#include "gap/drive/search.hpp"

namespace gap {

/// Enough to see which candidates are worth being fitted to the end.
inline constexpr Effort quick{3, 1, 6};

struct Neighbourhood {
    const Search& of;
    const Found& found;
    const Whitener* fits_by;
};

/// Whether it is a special case of one of them, or one of them is its.
[[nodiscard]] bool nested(const std::vector<const Effect*>& mine, const Effect& other);

/// The best of a size without one of its effects: what the last one brought about was perhaps only a better start, and
/// made one of the others superfluous.
[[nodiscard]] std::vector<Candidate> narrowed(const Neighbourhood& near, std::size_t size);

/// The best of a size with special cases in place of what covers them: of each lead few are fitted to the end, and the
/// wider one, which follows more, comes first.
[[nodiscard]] std::vector<Candidate> simplified(const Neighbourhood& near, std::size_t size);

/// The best of a size with another variant of one of its effects, where training does not tell the two apart.
[[nodiscard]] std::vector<Candidate> variants(const Neighbourhood& near, std::size_t size);

/// Of the best of a size each effect exchanged for each that acts at its place, from where the best one stands: what
/// looks alike is not to lose because it began further away.
[[nodiscard]] std::vector<Candidate> rivals(const Neighbourhood& near, std::size_t size);

/// That readings are multiples of a coarse step is seen, not guessed: it is asked for beside the best single and the
/// best pair, whatever squares it has at the start, since a sum of squares has a jump wherever a reading takes the next
/// step.
[[nodiscard]] std::vector<Candidate> with_steps(const Neighbourhood& near);

/// Jitter moves no reading, so it changes no other effect's fit: it is asked for once, beside the best single and the
/// best pair.
[[nodiscard]] std::vector<Candidate> with_jitter(const Neighbourhood& near);

}  // namespace gap
