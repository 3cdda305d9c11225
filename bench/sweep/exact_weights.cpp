#include "bench/sweep/exact_weights.hpp"

#include "reference/bdf.hpp"
#include "reference/sums.hpp"

namespace bench {

reference::Real first_weight(Discretisation discretisation, const reference::Real& order) {
    return names_weights(discretisation) ? reference::bdf_first_weight(steps_of(discretisation), order)
                                         : reference::Real(1);
}

double rounded_first_weight(Discretisation discretisation, double order) {
    return static_cast<double>(first_weight(discretisation, order));
}

reference::Real lag_steps(Discretisation discretisation, const reference::Real& order) {
    return discretisation == Discretisation::shifted ? reference::Real(order / 2) : reference::Real(0);
}

std::vector<reference::Real> exact_weights(Discretisation discretisation, const reference::Real& order,
                                           std::size_t count) {
    return names_weights(discretisation) ? reference::bdf_weights(steps_of(discretisation), order, count)
                                         : reference::weights(order, count);
}

}  // namespace bench
