#include "bench/sweep/discretisation.hpp"

#include <algorithm>

#include "bench/sweep/host_line.hpp"
#include "glsum/design/bdf.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

// As the kernel itself says: by what it answers to a design that names weights.
template <class K>
bool refuses_named_weights() {
    const double named[] = {-0.75, -0.25};
    const HostLine<K> line({.order = 0.5, .taps = 3, .weights = named});
    return line.status() == glsum::Status::weights_out_of_range;
}

template <class K>
std::string why_not_named() {
    if (!refuses_named_weights<K>()) {
        return "";
    }
    return glsum::guesses_tail<typename K::HistoryPart> ? "the guessed tail's weights have a closed form for gl alone"
                                                        : "in Horner form and fixed point it takes those of an order alone";
}

}  // namespace

std::string_view to_text(Discretisation discretisation) {
    return discretisation_names.at(static_cast<std::size_t>(discretisation));
}

std::optional<Discretisation> parse_discretisation(std::string_view text) {
    const auto* const found = std::find(discretisation_names.begin(), discretisation_names.end(), text);
    return found == discretisation_names.end()
               ? std::nullopt
               : std::optional(static_cast<Discretisation>(found - discretisation_names.begin()));
}

unsigned steps_of(Discretisation discretisation) {
    switch (discretisation) {
        case Discretisation::gl:
        case Discretisation::shifted:
            return 0;
        case Discretisation::bdf2:
            return 2;
        case Discretisation::bdf3:
            return 3;
        case Discretisation::bdf4:
            return 4;
    }
    return 0;
}

bool names_weights(Discretisation discretisation) { return steps_of(discretisation) > 0; }

std::vector<double> named_weights(Discretisation discretisation, double order, bool of_increments, std::size_t count) {
    const unsigned steps = steps_of(discretisation);
    std::vector<double> weights = of_increments ? glsum::design::bdf_increment_weights(steps, order, count + 1)
                                                : glsum::design::bdf_weights(steps, order, count + 1);
    weights.erase(weights.begin());  // a_0 = 1 is implied
    return weights;
}

std::string why_not_served(const std::string& kernel, Discretisation discretisation) {
    std::string why_not;
    if (names_weights(discretisation)) {
        glsum::Registry::with(kernel, [&]<class K>() {
            if constexpr (requires { typename K::HistoryPart; }) {
                why_not = why_not_named<K>();
            }
        });
    }
    return why_not;
}

}  // namespace bench
