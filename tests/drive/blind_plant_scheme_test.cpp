// The blind cases' linear plant node by node: what acts on it is its input's mean over the step around each node, and
// it is stepped by the second backward difference that its page states, written out here for a first order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "drive/stand/blind/plant.hpp"

namespace {

namespace blind = stand::blind;
using blind::Held;
using blind::Plant;
using blind::Unlisted;
using stand::Stand;

constexpr double h = 1.0 / 1024.0;  // so that nodes are where they should be to the last bit

std::vector<double> nodes(std::size_t count) {
    std::vector<double> at_s;
    for (std::size_t k = 0; k < count; ++k) {
        at_s.push_back(static_cast<double>(k) * h);
    }
    return at_s;
}

using Change = std::function<void(Stand&)>;

std::vector<double> readings(const Plant& plant, const Held& held, const Unlisted& unlisted, const Change& change,
                             std::size_t count) {
    Stand effects = blind::no_effects();
    change(effects);
    return blind::respond(plant, effects, unlisted, held, nodes(count), h);
}

// y = gain u / coefficient: what is read is the input's mean.
const Plant still{.gain = 3.0, .terms = {{2.0, 0.0}}, .delay_s = 0.0, .full_input = 1.0, .full_output = 1.5};

std::vector<double> means(const Held& held, const Change& change, std::size_t count = 900) {
    auto found = readings(still, held, {}, change, count);
    for (double& value : found) {
        value *= 2.0 / 3.0;
    }
    return found;
}

// What a function's integral says of its mean around a node; before 0 there is nothing.
double mean_of(const std::function<double(double)>& integral, std::size_t k) {
    const double t = static_cast<double>(k) * h;
    return (integral(t + 0.5 * h) - integral(std::max(0.0, t - 0.5 * h))) / h;
}

TEST(BlindPlantInput, IsTheMeanAroundEachNode) {
    // Two commands within a step, behind a delay of a third of one.
    const Held held{{0.0, 100.25 * h, 100.5 * h, 300.0 * h}, {0.5, 1.0, 0.25, 0.25}};
    const double late = h / 3.0;
    const auto found = means(held, [&](Stand& s) { s.extra_delay_s = late; });
    const auto integral = [&](double t) {
        const auto since = [t](double from) { return std::max(0.0, t - from); };
        return 0.5 * since(late) + 0.5 * since(100.25 * h + late) - 0.75 * since(100.5 * h + late);
    };
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], mean_of(integral, k), 1e-12) << k;
    }
}

TEST(BlindPlantInput, RampsAsItsSlopeAllows) {
    // Up to 0.5 in 256 steps, down by 0.3 in 153.6, cut short by a command upward.
    const double per_s = 2.0;
    const Held held{{0.0, 400.0 * h, 500.0 * h}, {0.5, 0.2, 1.0}};
    const auto found = means(held, [&](Stand& s) { s.rate_per_s = per_s; });
    const auto ramp = [&](double t, double from, double until) {  // the integral of what has been climbed since
        const double climbing = std::clamp(t - from, 0.0, until - from);
        return per_s * (0.5 * climbing * climbing + (until - from) * std::max(0.0, t - until));
    };
    const double low = 0.5 - 100.0 * h * per_s;
    const auto integral = [&](double t) {
        return ramp(t, 0.0, 256.0 * h) - ramp(t, 400.0 * h, 500.0 * h) +
               ramp(t, 500.0 * h, 500.0 * h + (1.0 - low) / per_s);
    };
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], mean_of(integral, k), 1e-12) << k;
    }
}

TEST(BlindPlantInput, LagsByItsExponential) {
    const double tau_s = 0.05;
    const auto found = means({{0.0, 400.0 * h}, {0.8, 0.3}}, [&](Stand& s) { s.motor_tau_s = tau_s; });
    const auto lagged = [&](double t) { return t > 0.0 ? t + tau_s * std::expm1(-t / tau_s) : 0.0; };
    const auto integral = [&](double t) { return 0.8 * lagged(t) - 0.5 * lagged(t - 400.0 * h); };
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], mean_of(integral, k), 1e-12) << k;
    }
}

// The share that the load takes, what the charge has taken until the end of the step, and the drift at its middle.
TEST(BlindPlantInput, WeakensByLoadChargeAndTime) {
    const double u = 0.8;
    const auto found = means({{0.0}, {u}}, [](Stand& s) {
        s.battery_resistance = 0.25;
        s.sag_per_unit_s = 0.5;
        s.drift_per_s = 0.375;
    });
    for (std::size_t k = 1; k < found.size(); ++k) {
        const double t = static_cast<double>(k) * h;
        EXPECT_NEAR(found[k], u * (1.0 + 0.375 * t) * (1.0 - 0.5 * u * (t + 0.5 * h)) * (1.0 - 0.25 * u), 1e-12) << k;
    }
    // Of the first node half a step is there.
    EXPECT_NEAR(found[0], 0.5 * u * (1.0 + 0.375 * 0.25 * h) * (1.0 - 0.5 * u * 0.5 * h) * (1.0 - 0.25 * u), 1e-12);
}

// Of each command what gets through: only such as differ from the one before are asked again, from the first on.
TEST(BlindPlantInput, IsWhatEachCommandLeaves) {
    const auto last_of = [&](const std::vector<double>& commands, const Unlisted& unlisted, const Change& change) {
        Held held;
        for (std::size_t i = 0; i < commands.size(); ++i) {
            held.time_s.push_back(100.0 * h * static_cast<double>(i));
            held.input.push_back(commands[i]);
        }
        return readings(still, held, unlisted, change, 800).back() * 2.0 / 3.0;
    };
    const Change none = [](Stand&) {};
    EXPECT_NEAR(last_of({0.5}, {.input_step = 0.2}, none), 0.6, 1e-12);  // half a step is rounded up
    EXPECT_NEAR(last_of({0.49}, {.input_step = 0.2}, none), 0.4, 1e-12);
    EXPECT_NEAR(last_of({0.5, 0.4, 0.4}, {.falling_gain = 0.25}, none), 0.3, 1e-12);
    EXPECT_NEAR(last_of({0.5, 0.4, 0.45}, {.falling_gain = 0.25}, none), 0.45, 1e-12);
    EXPECT_NEAR(last_of({0.5, 0.45}, {.hysteresis = 0.2}, none), 0.4, 1e-12);  // within the play nothing moves
    EXPECT_NEAR(last_of({0.5, 0.45, 0.1}, {.hysteresis = 0.2}, none), 0.2, 1e-12);
    EXPECT_NEAR(last_of({0.7}, {}, [](Stand& s) { s.input_limit = 0.6; }), 0.6, 1e-12);
    EXPECT_NEAR(last_of({0.7}, {}, [](Stand& s) { s.dead_zone = 0.3; }), 0.4, 1e-12);
    EXPECT_NEAR(last_of({0.7}, {}, [](Stand& s) { s.threshold = 0.71; }), 0.0, 1e-12);
    // More delay at rest: of none at the full input and above, of all of it at 0 and below.
    const auto begins = [&](double u) {
        const auto found = readings(still, {{0.0}, {u}}, {.delay_at_rest_s = 400.0 * h}, none, 800);
        return std::find_if(found.begin(), found.end(), [](double z) { return z != 0.0; }) - found.begin();
    };
    EXPECT_EQ(begins(0.25), 300);
    EXPECT_EQ(begins(1.5), 0);
    EXPECT_EQ(begins(0.5), 200);
}

// a (1.5 y - 2 y1 + 0.5 y2) / h + b y = gain u - forces, and forces of what is known of the nodes before.
struct Recursion {
    double a = 0.5;
    double b = 1.25;
    double gain = 2.0;
    std::vector<double> y;

    [[nodiscard]] double before(std::size_t by) const { return y.size() >= by ? y[y.size() - by] : 0.0; }
    [[nodiscard]] double next() const { return 2.0 * before(1) - before(2); }
    [[nodiscard]] double speed() const { return (2.5 * before(1) - 4.0 * before(2) + 1.5 * before(3)) / h; }
    void step(double drive) { y.push_back((drive + a * (2.0 * before(1) - 0.5 * before(2)) / h) / (1.5 * a / h + b)); }
};

// Of a step that is held, half of it at the first node.
double held_step(std::size_t k) { return k == 0 ? 0.4 : 0.8; }

void expect_recursion(
    const Unlisted& unlisted, const Change& change, const std::function<double(const Recursion&, std::size_t)>& force,
    const std::function<double(const Recursion&)>& factor = [](const Recursion&) { return 1.0; }) {
    const Plant plant{.gain = 2.0, .terms = {{0.5, 1.0}, {1.25, 0.0}}, .full_input = 1.0, .full_output = 1.6};
    const auto found = readings(plant, {{0.0}, {0.8}}, unlisted, change, 1500);
    Recursion by_hand;
    for (std::size_t k = 0; k < found.size(); ++k) {
        by_hand.step(by_hand.gain * held_step(k) * factor(by_hand) - force(by_hand, k));
        ASSERT_NEAR(found[k], by_hand.y[k], 1e-12) << k;
    }
}

TEST(BlindPlantScheme, IsTheSecondBackwardDifference) {
    const Change none = [](Stand&) {};
    expect_recursion({}, none, [](const Recursion&, std::size_t) { return 0.0; });
    expect_recursion(
        {}, [](Stand& s) { s.time_scale = 1.0; }, [](const Recursion&, std::size_t) { return 0.0; });
    expect_recursion(
        {}, [](Stand& s) { s.drag = 0.03125; },
        [](const Recursion& r, std::size_t) { return 0.03125 * r.speed() * std::fabs(r.speed()); });
    expect_recursion({.cogging_force = 0.25, .cogging_per_unit = 7.0}, none,
                     [](const Recursion& r, std::size_t) { return 0.25 * std::sin(7.0 * r.next()); });
    expect_recursion({.hum_force = 0.25, .hum_hz = 3.0}, none, [](const Recursion&, std::size_t k) {
        return 0.25 * std::sin(2.0 * std::numbers::pi * 3.0 * static_cast<double>(k) * h);
    });
    expect_recursion({.stiffening = 0.5}, none,
                     [](const Recursion& r, std::size_t) { return 0.5 * r.next() * r.next() * r.next(); });
    expect_recursion({.damping_growth = 0.125}, none,
                     [](const Recursion& r, std::size_t k) { return 0.125 * static_cast<double>(k) * h * r.speed(); });
    expect_recursion(
        {}, [](Stand& s) { s.sine_per_unit = 0.5; },
        [](const Recursion& r, std::size_t) { return 1.25 * (std::sin(0.5 * r.next()) / 0.5 - r.next()); });
    expect_recursion(
        {.near_gain = 0.5}, none, [](const Recursion&, std::size_t) { return 0.0; },
        [](const Recursion& r) { return 1.0 + 0.5 * std::exp(-3.0 * r.next() / 1.6); });
    // From its first node on, and at its last no more.
    expect_recursion(
        {},
        [](Stand& s) {
            s.disturbance_size = -0.5;
            s.disturbance_from_s = 300.0 * h;
            s.disturbance_to_s = 700.0 * h;
        },
        [](const Recursion&, std::size_t k) { return k >= 300 && k < 700 ? -0.5 : 0.0; });
}

// Dahl's: towards the limit of its side by what was moved over 0.4 % of the full output.
TEST(BlindPlantScheme, BendsItsFrictionBeforeItSlips) {
    double force = 0.0;
    expect_recursion(
        {},
        [](Stand& s) {
            s.friction = 0.125;
            s.friction_up = 0.25;
            s.friction_down = 0.0625;
            s.disturbance_size = 1.0;  // drives it down again
            s.disturbance_from_s = 0.5;
            s.disturbance_to_s = 2.0;
        },
        [&](const Recursion& r, std::size_t k) {
            const double by = r.before(1) - r.before(2);
            const double limit = by > 0.0 ? 0.375 : -0.1875;
            force = by == 0.0 ? force : limit + (force - limit) * std::exp(-std::fabs(by) / (0.004 * 1.6));
            return force + (k >= 512 ? 1.0 : 0.0);
        });
}

// An order that ends does so: (1 - z)^2 (2 - z) for the second, and of half an order each weight follows from the one
// before.
TEST(BlindPlantScheme, WeighsThePastByItsOrders) {
    const Plant plant{
        .gain = 1.0, .terms = {{0.04, 2.0}, {0.25, 0.5}, {1.0, 0.0}}, .full_input = 1.0, .full_output = 1.0};
    const auto found = readings(
        plant, {{0.0}, {0.8}}, {}, [](Stand& s) { s.time_scale = 2.0; }, 300);
    std::vector<double> half{1.0};
    for (std::size_t j = 1; j < 300; ++j) {
        half.push_back(half.back() * (1.0 - 1.5 / static_cast<double>(j)));
    }
    const double whole[] = {2.0, -5.0, 4.0, -1.0};
    std::vector<double> y;
    for (std::size_t k = 0; k < 300; ++k) {
        const auto weight = [&](std::size_t j) {
            return 0.04 * 4.0 / (h * h) * (j < 4 ? whole[j] : 0.0) +
                   0.25 * std::sqrt(2.0 / h) * (1.25 * half[j] - (j > 0 ? 0.25 * half[j - 1] : 0.0));
        };
        double rest = held_step(k);
        for (std::size_t j = 1; j <= k; ++j) {
            rest -= weight(j) * y[k - j];
        }
        y.push_back(rest / (weight(0) + 1.0));
        ASSERT_NEAR(found[k], y[k], 1e-10) << k;
    }
    EXPECT_EQ(blind::static_output({.gain = 3.0, .terms = {{1.0, 1.0}, {4.0, 0.0}}}, 2.0), 1.5);
}

// What is read of the way: lost where it is driven hard, from the first node on; behind lags, bent, and by play.
TEST(BlindPlantScheme, IsReadThroughEachOfItsStages) {
    const Plant plant{.gain = 2.0, .terms = {{0.5, 1.0}, {1.25, 0.0}}, .full_input = 0.5, .full_output = 1.6};
    const Change none = [](Stand&) {};
    const auto way = readings(plant, {{0.0}, {0.8}}, {}, none, 1000);
    const auto through = [&](const Unlisted& unlisted, const Change& change) {
        return readings(plant, {{0.0}, {0.8}}, unlisted, change, 1000);
    };
    const auto slipped = through({.slip_per_unit = 0.3}, none);
    const auto played = through({}, [](Stand& s) { s.backlash_rad = 0.2; });
    const auto lagged = through({}, [](Stand& s) { s.sensor_tau_s = 0.25; });
    const auto bent = through({}, [](Stand& s) {
        s.output_curvature = 0.4;
        s.output_reference = 2.0;
    });
    double lost = 0.0;
    double slow = 0.0;
    for (std::size_t k = 0; k < way.size(); ++k) {
        const double before = k > 0 ? way[k - 1] : 0.0;
        lost += 0.3 * std::fabs(2.0 * held_step(k) - 1.25 * way[k]) / (2.0 * 0.5) * (way[k] - before);
        EXPECT_NEAR(slipped[k], way[k] - lost, 1e-12) << k;
        EXPECT_NEAR(played[k], std::max(0.0, way[k] - 0.1), 1e-12) << k;
        const double mean = 0.5 * (before + way[k]);
        slow = mean + (slow - mean) * std::exp(-h / 0.25);
        EXPECT_NEAR(lagged[k], slow, 1e-12) << k;
        EXPECT_NEAR(bent[k], way[k] * (0.6 + 0.4 * way[k] / 2.0), 1e-12) << k;
    }
    // A reading between two nodes is on the line between them; the record may go on behind the last command.
    Stand effects = blind::no_effects();
    const auto between = blind::respond(plant, effects, {}, {{0.0}, {0.8}}, std::vector{500.25 * h, -1.0}, h);
    EXPECT_NEAR(between[0], 0.75 * way[500] + 0.25 * way[501], 1e-12);
    EXPECT_EQ(between[1], way[0]);
}

// The mode is solved exactly for its mean input: at rest at the input's share, in the middle of each step.
TEST(BlindPlantScheme, SwingsExactlyOnItsMeanInput) {
    const Plant plant{.gain = 2.0, .terms = {{0.5, 1.0}, {1.25, 0.0}}, .full_input = 0.5, .full_output = 1.6};
    const auto swung = readings(
        plant, {{0.0}, {0.8}}, {},
        [](Stand& s) {
            s.resonance_share = 0.25;
            s.resonance_hz = 3.0;
            s.resonance_damping = 0.125;
        },
        600);
    const auto way = readings(
        plant, {{0.0}, {0.8}}, {}, [](Stand&) {}, 600);
    const double w = 6.0 * std::numbers::pi;
    const double turn = w * std::sqrt(1.0 - 0.125 * 0.125);
    const auto response = [&](double t) {
        return t > 0.0 ? 1.0 - std::exp(-0.125 * w * t) * (std::cos(turn * t) + 0.125 * w / turn * std::sin(turn * t))
                       : 0.0;
    };
    const double rest = 0.25 * 2.0 * 0.8 / 1.25;
    // The first node has half of the input for a whole step.
    const auto at_end = [&](double steps) { return rest * 0.5 * (response(steps * h) + response((steps - 1.0) * h)); };
    for (std::size_t k = 0; k < way.size(); ++k) {
        const double steps = static_cast<double>(k);
        EXPECT_NEAR(swung[k] - way[k], 0.5 * (at_end(steps) + at_end(steps + 1.0)), 1e-12) << k;
    }
}

// A stop holds as long as the plant leans on it; what runs away does so at a million times the full output.
TEST(BlindPlantScheme, LeansOnItsStopOrRunsAway) {
    const Plant plant{.gain = 2.0, .terms = {{0.5, 1.0}, {1.25, 0.0}}, .full_input = 1.0, .full_output = 1.6};
    const auto found = readings(
        plant, {{0.0, 600.0 * h}, {0.8, 0.2}}, {}, [](Stand& s) { s.upper_stop_rad = 0.5; }, 900);
    Recursion by_hand;
    bool leans = false;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const double u = k < 600 ? held_step(k) : k == 600 ? 0.5 : 0.2;
        by_hand.step(2.0 * u);
        leans = by_hand.y.back() > 0.5 || (leans && 2.0 * u > 1.25 * 0.5);
        by_hand.y.back() = leans ? 0.5 : by_hand.y.back();
        ASSERT_NEAR(found[k], by_hand.y[k], 1e-12) << k;
    }
}

}  // namespace
