// The exact derivatives against printed values (every digit), identities (30 digits) and the sum that tends to them.
#include "reference/derivatives.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "reference/gamma.hpp"
#include "reference/mittag_leffler.hpp"
#include "reference/sums.hpp"
#include "tests/bench/digits.hpp"

namespace {

using reference::derivative_of_cosine;
using reference::derivative_of_exponential;
using reference::derivative_of_power;
using reference::derivative_of_sine;
using reference::mittag_leffler;
using reference::Real;

TEST(Derivatives, ReproducePrintedValues) {
    using Of = std::function<Real(const Real& v)>;
    const auto power = [](const char* b) -> Of {
        return [b](const Real& v) { return derivative_of_power(Real(b), v, 1); };
    };
    const struct {
        const char* name;
        Of derivative;
        const char* printed[3];  // cut, not rounded
    } table[] = {
        {"sin",
         [](const Real& v) { return derivative_of_sine(1, v, 1); },
         {".874208881768729756", ".846056786724152914", ".630769877632009471"}},
        {"cos",
         [](const Real& v) { return derivative_of_cosine(1, v, 1); },
         {".185432658154830077", "-.10549467602990728", "-.710539057767321365"}},
        {"exp",
         [](const Real& v) { return derivative_of_exponential(1, v, 1); },
         {".130560859697822906", "-.0429681222936374422", "-.328483897527638434"}},
        {"t^2", power("2"), {"1.29476165355725378", "1.5045055561273501", "1.9111581929305051"}},
        {"sqrt", power("0.5"), {".965211387110044441", ".886226925452758014", ".59510578715357767"}},
        {"1", power("0"), {".770383183866565999", ".564189583547756287", ".105113700611177781"}},
    };
    const char* orders[] = {"0.3", "0.5", "0.9"};
    for (const auto& row : table) {
        for (std::size_t i = 0; i < std::size(orders); ++i) {
            digits::expect_printed(row.derivative(Real(orders[i])), row.printed[i], 1.0,
                                   std::string(row.name) + " of order " + orders[i]);
        }
    }
    digits::expect_printed(derivative_of_power(1, Real("0.5"), 1), "1.1283791670955125739", 1.0, "t");
    // From the tests of the Python package differint.
    digits::expect_printed(derivative_of_power(2, Real("0.5"), 1) - derivative_of_power(0, Real("0.5"), 1),
                           "0.94031597258", 1.0, "t^2 - 1");
}

// E_{p/q,b}(z) by functions of whole a: every q-th term of its series makes one of them.
Real fractional_mittag_leffler(unsigned p, unsigned q, const Real& b, const Real& z) {
    Real sum = 0;
    for (unsigned r = 0; r < q; ++r) {
        sum += pow(z, r) * mittag_leffler(p, b + Real(r * p) / q, pow(z, q));
    }
    return sum;
}

TEST(MittagLeffler, ReproducesPrintedValues) {
    const struct {
        unsigned p;
        unsigned q;
        const char* at_minus_one;  // E_a(-1), a = p/q
        const char* relaxation;    // 1 - y = D^a y, y(0) = 0, at t = 1
    } table[] = {
        {1, 2, "0.427583576155807004", ".572416423844192996"},
        {4, 5, "0.386948578618976851", ".613051421381023149"},
        {3, 2, "0.396629365318088084", ".603370634681911916"},
        {9, 5, "0.474224470704456349", ".525775529295543651"},
    };
    for (const auto& row : table) {
        const std::string name = std::to_string(row.p) + "/" + std::to_string(row.q);
        digits::expect_printed(fractional_mittag_leffler(row.p, row.q, 1, -1), row.at_minus_one, 1.0, name);
        digits::expect_printed(fractional_mittag_leffler(row.p, row.q, 1 + Real(row.p) / row.q, -1), row.relaxation,
                               1.0, name + " relaxation");
    }
    // From the tests of the Julia package MittagLeffler: computed in double, so 15 decimals.
    digits::expect_printed(fractional_mittag_leffler(1, 2, Real("0.5"), Real("0.5")), "1.540369828139035", 1.0);
    digits::expect_printed(fractional_mittag_leffler(3, 2, Real("0.5"), Real("0.5")), "1.144846628615524", 1.0);
    digits::expect_printed(fractional_mittag_leffler(1, 8, 1, -1), "0.481952081535048", 1.0);
}

TEST(MittagLeffler, IsElementaryForWholeParameters) {
    for (const char* text : {"0.001", "1", "40", "900"}) {
        const Real x(text);
        digits::expect_thirty(mittag_leffler(1, 1, -x), exp(-x), "exp(-x)");
        digits::expect_thirty(mittag_leffler(1, -1, -x), x * x * exp(-x), "two poles of Gamma");
        digits::expect_thirty(mittag_leffler(2, 1, x * x), cosh(x), "cosh");
        digits::expect_thirty(mittag_leffler(2, 0, -x * x), -x * sin(x), "one pole of Gamma");
    }
    EXPECT_EQ(mittag_leffler(1, 0, 0), 0);
    EXPECT_EQ(mittag_leffler(2, 3, 0), Real(0.5));
}

TEST(MittagLeffler, RefusesWhatItCannotSum) {
    EXPECT_THROW((void)mittag_leffler(0, 1, 1), std::domain_error);
    EXPECT_THROW((void)mittag_leffler(1, 1, Real("1e6")), std::domain_error);
    EXPECT_THROW((void)mittag_leffler(1, 1, std::numeric_limits<Real>::quiet_NaN()), std::domain_error);
    EXPECT_NO_THROW((void)mittag_leffler(2, 1, Real("1e6")));
}

TEST(Gamma, ReciprocalIsZeroAtThePoles) {
    for (int x = -3; x <= 0; ++x) {
        EXPECT_EQ(reference::reciprocal_gamma(x), 0) << x;
    }
    EXPECT_EQ(reference::reciprocal_gamma(4) * 6, 1);
    digits::expect_thirty(reference::reciprocal_gamma(Real(-1.5)),
                          Real(0.75) / sqrt(boost::math::constants::pi<Real>()), "1/Gamma(-1.5)");
}

TEST(Derivatives, OfWholeOrdersAreTheOrdinaryOnes) {
    for (const char* angle_text : {"0.01", "3", "157", "1500", "1571"}) {
        const Real angle(angle_text);
        const Real w = 2 * boost::math::constants::pi<Real>() * 50;
        const Real t = angle / w;
        const Real s = sin(angle);
        const Real c = cos(angle);
        digits::expect_thirty(derivative_of_sine(w, 0, t), s, "D^0 sin");
        digits::expect_thirty(derivative_of_sine(w, 1, t), w * c, "D^1 sin");
        digits::expect_thirty(derivative_of_sine(w, 2, t), -w * w * s, "D^2 sin");
        digits::expect_thirty(derivative_of_sine(w, -1, t), (1 - c) / w, "D^-1 sin");
        digits::expect_thirty(derivative_of_cosine(w, 0, t), c, "D^0 cos");
        digits::expect_thirty(derivative_of_cosine(w, 1, t), -w * s, "D^1 cos");
        digits::expect_thirty(derivative_of_cosine(w, 2, t), -w * w * c, "D^2 cos");
        digits::expect_thirty(derivative_of_cosine(w, -1, t), s / w, "D^-1 cos");
        const Real decay = exp(-angle);
        digits::expect_thirty(derivative_of_exponential(w, 1, t), -w * decay, "D^1 exp");
        digits::expect_thirty(derivative_of_exponential(w, 2, t), w * w * decay, "D^2 exp");
        digits::expect_thirty(derivative_of_exponential(w, -1, t), (1 - decay) / w, "D^-1 exp");
        EXPECT_EQ(derivative_of_power(0, 1, t), 0);
        EXPECT_EQ(derivative_of_power(0, 2, t), 0);
        EXPECT_EQ(derivative_of_power(1, 2, t), 0);
        digits::expect_thirty(derivative_of_power(2, 2, t), 2, "D^2 t^2");
        digits::expect_thirty(derivative_of_power(1, -1, t), t * t / 2, "D^-1 t");
    }
}

// D^1 D^v = D^(1+v), seen as D^v sin' = w D^v cos: one series against another whose terms are not the same.
TEST(Derivatives, OfRealOrderAgreeWithEachOther) {
    for (const char* order : {"-1.9", "-0.5", "0.3", "0.98319"}) {
        const Real v(order);
        for (const char* text : {"0.01", "3", "157", "1500"}) {
            const Real w = 300;
            const Real t = Real(text) / w;
            digits::expect_thirty(derivative_of_sine(w, 1 + v, t), w * derivative_of_cosine(w, v, t), order);
            const Real jump = derivative_of_power(0, v + 1, t);  // of exp(0) = 1 at the start
            digits::expect_thirty(derivative_of_exponential(w, 1 + v, t), jump - w * derivative_of_exponential(w, v, t),
                                  order);
        }
    }
}

TEST(Derivatives, RefuseTimesAndPowersThatHaveNone) {
    EXPECT_THROW((void)derivative_of_power(0, Real("0.5"), 0), std::domain_error);
    EXPECT_THROW((void)derivative_of_power(-1, Real("0.5"), 1), std::domain_error);
    EXPECT_THROW((void)derivative_of_sine(1, Real("0.5"), -1), std::domain_error);
}

// Wide and narrow series side by side: whatever they shared would show.
TEST(Derivatives, AreTheSameInSeveralThreads) {
    const Real v("0.3");
    const Real wide = derivative_of_sine(300, v, 1);
    const Real narrow = derivative_of_sine(3, v, 1);
    std::atomic<int> wrong = 0;
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i) {
            threads.emplace_back([&] {
                for (int repeat = 0; repeat < 100; ++repeat) {
                    wrong += derivative_of_sine(300, v, 1) == wide ? 0 : 1;
                    wrong += derivative_of_sine(3, v, 1) == narrow ? 0 : 1;
                }
            });
        }
    }
    EXPECT_EQ(wrong, 0);
}

// The sum of x at t = 1 in steps of 1 / steps, times h^-v.
Real grunwald_letnikov_at_one(const std::function<double(double)>& x, const Real& v, std::size_t steps) {
    std::vector<double> newest_first(steps + 1);
    for (std::size_t j = 0; j <= steps; ++j) {
        newest_first[j] = x(static_cast<double>(steps - j) / static_cast<double>(steps));
    }
    return reference::sum(reference::weights(v, steps + 1), newest_first) * pow(Real(steps), v);
}

// ((1 - e^(-s h)) / h)^v = s^v (1 - v s h / 2 + ...): the error is -(v/2) h D^(v+1) x to first order. The sum takes a
// start at x(0) for a whole sample where the derivative sees half: h/2 x(0) D^(v+1) 1 more.
TEST(Derivatives, AreTheLimitOfTheSumAtFirstOrder) {
    const struct {
        const char* name;
        std::function<double(double)> x;
        std::function<Real(const Real& v)> derivative;
    } signals[] = {
        {"t", [](double t) { return t; }, [](const Real& v) { return derivative_of_power(1, v, 1); }},
        {"t^2", [](double t) { return t * t; }, [](const Real& v) { return derivative_of_power(2, v, 1); }},
        {"exp(-t)", [](double t) { return std::exp(-t); },
         [](const Real& v) { return derivative_of_exponential(1, v, 1); }},
        {"sin(t)", [](double t) { return std::sin(t); }, [](const Real& v) { return derivative_of_sine(1, v, 1); }},
        {"cos(t)", [](double t) { return std::cos(t); }, [](const Real& v) { return derivative_of_cosine(1, v, 1); }},
    };
    constexpr std::size_t steps = 128;
    for (const auto& signal : signals) {
        for (const char* order : {"0.3", "0.5", "0.9", "1.5", "-0.5", "-1.3"}) {
            const std::string what = std::string(signal.name) + " of order " + order;
            const Real v(order);
            const auto error = [&](std::size_t n) {
                return static_cast<double>(grunwald_letnikov_at_one(signal.x, v, n) - signal.derivative(v));
            };
            const auto leading = static_cast<double>(
                (signal.x(0.0) * derivative_of_power(0, v + 1, 1) - v * signal.derivative(v + 1)) / (2 * steps));
            EXPECT_NEAR(error(steps) / leading, 1.0, 0.03) << what;
            EXPECT_NEAR(error(steps) / error(2 * steps), 2.0, 0.05) << what;
        }
    }
}

}  // namespace
