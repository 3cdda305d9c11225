#include "gap/cycles/tally.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>

namespace gap::cycles {

void Tally::count(const std::string& kind, bool named) {
    Counts& counts = of_[kind];
    counts.named += named ? 1 : 0;
    ++counts.all;
}

std::string Tally::to_text() const {
    using Binomial = boost::math::binomial_distribution<>;
    std::string text;
    for (const auto& [kind, counts] : of_) {
        const auto n = static_cast<double>(counts.all);
        const auto k = static_cast<double>(counts.named);
        text += fmt::format("  {:<14} {} of {}, {:.0f} % [{:.0f}, {:.0f}]\n", kind, counts.named, counts.all,
                            100.0 * k / n, 100.0 * Binomial::find_lower_bound_on_p(n, k, 0.025),
                            100.0 * Binomial::find_upper_bound_on_p(n, k, 0.025));
    }
    return text;
}

}  // namespace gap::cycles
