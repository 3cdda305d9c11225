// Apart from those who ask: these headers take several times as long to compile as what they are used for.
#include "drive/quantiles.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace drive {

double students_t_quantile(double freedom, double probability) {
    return boost::math::quantile(boost::math::students_t(freedom), probability);
}

double fisher_f_quantile(double numerator_freedom, double denominator_freedom, double probability) {
    return boost::math::quantile(boost::math::fisher_f(numerator_freedom, denominator_freedom), probability);
}

}  // namespace drive
