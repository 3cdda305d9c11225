// Which candidates are fitted: none, every effect alone, pairs and triples of those that help.
#pragma once

#include <functional>

#include "gap/drive/question.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {

struct Search {
    const Ground& ground;
    unsigned jobs;
    const std::function<void(const std::string&)>& say;
};

struct Found {
    std::vector<Ranked> ranking;  ///< the best first; `none` is among them
    Whitener whitener;
    [[nodiscard]] bool has_sized(std::size_t size) const;
    /// With so many effects; there is one.
    [[nodiscard]] const Ranked& best_of(std::size_t size) const;
};

[[nodiscard]] Found search(const Search& of);

/// Of one candidate. Real rigs have several causes at once: four beside a form that is fitted. Beside a model that is
/// given more than three are an expansion of something else.
[[nodiscard]] constexpr std::size_t most_effects_beside(const Base& base) { return base.refit ? 4 : 3; }

}  // namespace gap
