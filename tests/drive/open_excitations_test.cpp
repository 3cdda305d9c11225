// What the plant of a blind case without a model is given, draw by draw: a published seed keeps its cases. The plant
// here writes down what it is asked, and answers nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "drive/stand/blind/logger.hpp"
#include "drive/stand/blind/profile.hpp"
#include "drive/stand/blind/series.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using blind::digits;
using blind::EffectSize;
using stand::Chance;

struct Asked {
    std::vector<blind::Fault> faults;
    blind::Held held;
    std::uint64_t seed;
};
std::vector<Asked> asked;  // of the first plant that was drawn
int drawn = 0;
bool remembers = false;

struct Enough {};

struct Writing : blind::Rig {
    blind::Parameters draw(const std::string&, EffectSize, bool, Chance&) const override { return {{"own", 1.0}}; }
    std::vector<double> read(std::span<const blind::Fault> faults, const blind::Held& held, const std::vector<double>&,
                             std::uint64_t seed) const override {
        asked.push_back({std::vector<blind::Fault>(faults.begin(), faults.end()), held, seed});
        return std::vector<double>(held.input.size(), 0.0);
    }
};

constexpr double interval_s = 0.4;
constexpr double until_s = 40.0;
constexpr double tau_s = 1.5;
constexpr double full_input = 5.0;

std::unique_ptr<blind::Rig> draw_writing(const std::vector<std::string>&, Chance&) {
    if (++drawn > 1) {
        throw Enough{};
    }
    auto rig = std::make_unique<Writing>();
    rig->clock = {.interval_s = interval_s, .spread_s = 0.0, .until_s = until_s};
    rig->tau_s = tau_s;
    rig->full_input = full_input;
    rig->remembers = remembers;
    return rig;
}

const blind::Family family{"writing",   {"listed", "load_disturbance", "missed_counts"}, {"other"}, {}, {"bend"},
                           draw_writing};

constexpr std::uint64_t set_seed = 3;
std::uint64_t own_of(std::size_t number) { return set_seed * 1000003U + number; }

void ask(Class kind, const char* effect, std::size_t number) {
    asked.clear();
    drawn = 0;
    EXPECT_THROW((void)blind::make_open_case({&family, {kind, {effect}, {EffectSize::large}, false}}, set_seed, number),
                 Enough);
}

// Five to eight levels that rise, behind a rest.
blind::Held rising(double length_s, double high, Chance& same) {
    const double stairs = 5.0 + static_cast<double>(same.below(4));
    const double rest_s = same.between(0.01, 0.04) * length_s;
    blind::Held held;
    const int last = static_cast<int>(std::floor(length_s / interval_s + 0.5));
    for (int k = 0; k <= last; ++k) {
        const double t = k * interval_s;
        const double stair = std::floor((t - rest_s) / (length_s - rest_s) * stairs) + 1.0;
        held.time_s.push_back(t);
        held.input.push_back(t < rest_s ? 0.0 : high * std::min(stair, stairs) / stairs);
    }
    return held;
}

// A log that starts later does so where the input has been still for half a time constant, to a twentieth of the full
// one. It looks from three to twenty hundredths of the record on, and up to three tenths; else it starts with the
// record.
std::size_t start_of_log(const blind::Held& held, Chance& same) {
    const auto count = static_cast<double>(held.input.size());
    const int still = static_cast<int>(std::ceil(0.5 * tau_s / interval_s));
    const int last = static_cast<int>(0.3 * count);
    for (int k = static_cast<int>(same.between(0.03, 0.2) * count) + still; k < last; ++k) {
        const auto [low, high] = std::minmax_element(held.input.begin() + (k - still), held.input.begin() + (k + 1));
        if (*high - *low <= 0.05 * full_input) {
            return static_cast<std::size_t>(k);
        }
    }
    return 0;
}

struct Given {
    std::string kind;
    blind::Held held;
    std::size_t from = 0;  // the log's first sample
};

Given excited(const std::string& kind, double high, bool lifts, Chance& same) {
    const double length_s = until_s * (same.happens(0.5) ? 1.0 : 0.75);
    const double pace_s = tau_s * same.scaled(0.7, 2.5);
    const blind::Clock clock{.interval_s = interval_s, .spread_s = 0.0, .until_s = length_s};
    Given given{kind, {}};
    given.held = kind == "rising" ? rising(length_s, high, same) : blind::make_profile(kind, clock, high, pace_s, same);
    const double low = lifts && same.happens(0.4) ? same.between(0.1, 0.4) * high : 0.0;
    for (double& u : given.held.input) {
        u = digits(low + (high - low) * u / high);
    }
    // Never of a single step, nor of what remembers its past.
    if (!remembers && kind != "step" && same.happens(0.5)) {
        given.from = start_of_log(given.held, same);
    }
    return given;
}

struct Expected {
    std::vector<Given> train;
    std::vector<Given> validate;
    std::size_t event = 0;  // the record of training that has it
};

Expected expected_of(std::uint64_t own, bool one_level, bool event) {
    Chance same(own, 103);
    const auto some = [&] { return digits(full_input * same.between(0.6, 1.0)); };
    const double level = some();
    std::vector<std::string> used;
    const auto is_used = [&](const std::string& kind) {
        return std::find(used.begin(), used.end(), kind) != used.end();
    };
    const auto any = [&] { return blind::profile_kinds()[same.below(7)]; };
    // No kind twice; no single step in training, and none beside on and off, which has its level.
    const auto kind_of = [&](bool train) -> std::string {
        if (one_level) {
            return train ? "on_off" : same.happens(0.5) ? "step" : "on_off";
        }
        for (;;) {
            const std::string kind = train && same.happens(0.12) ? "rising" : any();
            const bool refused = train ? kind == "step" : (kind == "step" || kind == "on_off") && is_used("on_off");
            if (!refused && !is_used(kind)) {
                used.push_back(kind);
                return kind;
            }
        }
    };
    const auto next = [&](bool train) {
        const std::string kind = kind_of(train);
        const double high = one_level ? level : some();
        return excited(kind, high, !one_level, same);
    };
    Expected expected;
    const int trained = event || same.happens(0.35) ? 2 : 1;
    for (int i = 0; i < trained; ++i) {
        expected.train.push_back(next(true));
    }
    const int judged = same.happens(0.2) ? 2 : 1;
    for (int i = 0; i < judged; ++i) {
        expected.validate.push_back(next(false));
    }
    expected.event = same.below(static_cast<std::size_t>(trained));
    return expected;
}

// Each record once without faults and once with them, those of training first.
void expect_asked(const Expected& expected, std::uint64_t own) {
    const std::size_t trained = expected.train.size();
    const std::size_t all = trained + expected.validate.size();
    ASSERT_EQ(asked.size(), 2 * all) << own;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::size_t which = i % all;
        const bool train = which < trained;
        const blind::Held& held = (train ? expected.train[which] : expected.validate[which - trained]).held;
        EXPECT_EQ(asked[i].seed, train ? own + which : own + 100U + which - trained);
        ASSERT_EQ(asked[i].held.time_s.size(), held.time_s.size()) << own << ' ' << i;
        for (std::size_t k = 0; k < held.time_s.size(); ++k) {
            ASSERT_NEAR(asked[i].held.time_s[k], held.time_s[k], 1e-9) << own << ' ' << i;
            ASSERT_NEAR(asked[i].held.input[k], held.input[k], 1e-9) << own << ' ' << i << ' ' << k;
        }
    }
}

TEST(OpenExcitations, AreAnotherKindAndLevelInEachRecord) {
    for (const bool with_memory : {false, true}) {
        remembers = with_memory;
        for (std::size_t number = 1; number <= 40; ++number) {
            ask(Class::single, "listed", number);
            expect_asked(expected_of(own_of(number), false, false), own_of(number));
        }
    }
}

TEST(OpenExcitations, OfWhatBendsUnderOneLevelAreAtOne) {
    remembers = false;
    for (std::size_t number = 1; number <= 40; ++number) {
        ask(Class::taken_up, "bend", number);
        expect_asked(expected_of(own_of(number), true, false), own_of(number));
        for (std::size_t i = 0; i < asked.size(); ++i) {
            ASSERT_EQ(asked[i].faults.size(), i < asked.size() / 2 ? 0U : 1U);
        }
    }
}

// An event is in one of two records of training and in the first of validation, each time with a place of its own.
TEST(OpenExcitations, AnEventHasItsPlaceInOneRecordOfTraining) {
    remembers = true;
    for (const char* effect : {"load_disturbance", "missed_counts"}) {
        for (std::size_t number = 1; number <= 20; ++number) {
            const std::uint64_t own = own_of(number);
            ask(Class::single, effect, number);
            const Expected expected = expected_of(own, false, true);
            expect_asked(expected, own);
            ASSERT_EQ(expected.train.size(), 2U);
            const std::size_t all = 2 + expected.validate.size();
            ASSERT_EQ(asked.size(), 2 * all);
            for (std::size_t i = 0; i < 2 * all; ++i) {
                const std::size_t which = i % all;
                const bool has_it = i >= all && (which == expected.event || which == 2);
                ASSERT_EQ(asked[i].faults.size(), has_it ? 1U : 0U) << number << ' ' << i;
                if (has_it) {
                    Chance same(own + (which < 2 ? 7919U * which : 0U), which < 2 ? 201U : 202U);
                    blind::Fault placed{effect, {{"own", 1.0}}};
                    blind::place_event(placed, 0.0, asked[i].held.time_s.back(), same);
                    EXPECT_EQ(asked[i].faults.front().effect, effect);
                    EXPECT_EQ(asked[i].faults.front().parameters, placed.parameters) << number << ' ' << i;
                }
            }
        }
    }
}

// Twice the input of the sample before, and noise.
std::vector<double> echo(const blind::Held& held, const std::vector<double>& noise) {
    std::vector<double> readings;
    for (std::size_t k = 0; k < held.input.size(); ++k) {
        readings.push_back((k > 0 ? 2.0 * held.input[k - 1] : 0.0) + (noise.empty() ? 0.0 : noise[k]));
    }
    return readings;
}

struct Echoing : blind::Rig {
    blind::Parameters draw(const std::string&, EffectSize, bool, Chance&) const override { return {}; }
    std::vector<double> read(std::span<const blind::Fault>, const blind::Held& held, const std::vector<double>& noise,
                             std::uint64_t) const override {
        return echo(held, noise);
    }
};

std::unique_ptr<blind::Rig> draw_echoing(const std::vector<std::string>&, Chance&) {
    auto rig = std::make_unique<Echoing>();
    rig->clock = {.interval_s = interval_s, .spread_s = 0.0, .until_s = until_s};
    rig->tau_s = tau_s;
    rig->full_input = full_input;
    rig->input = "input";
    rig->output = "y";
    return rig;
}

// Noise of a thousandth to a two-hundredth of the deviation in training; a logger with habits of its own.
TEST(OpenExcitations, AreLoggedAsTheLoggerIsDrawn) {
    remembers = false;
    const blind::Family echoing{"echoing", {"listed"}, {"other"}, {}, {}, draw_echoing};
    for (std::size_t number = 1; number <= 6; ++number) {
        const std::uint64_t own = own_of(number);
        const Expected expected = expected_of(own, false, false);
        std::vector<double> logged;
        for (const Given& given : expected.train) {
            const auto readings = echo(given.held, {});
            logged.insert(logged.end(), readings.begin() + static_cast<std::ptrdiff_t>(given.from), readings.end());
        }
        Chance faults(own, 102);
        Chance noises(own, 104);
        Chance loggers(own, 105);
        const double deviation = digits(blind::deviation_of(logged) * faults.scaled(0.001, 0.005));
        const bool coloured = faults.happens(0.5);
        const double memory = coloured ? faults.between(0.8, 0.95) : 0.0;
        blind::Logger logger{.input = "input", .output = "y"};
        logger.stamp_step_s = interval_s / loggers.scaled(20.0, 2000.0);
        logger.output_step = deviation * loggers.scaled(0.02, 0.5);
        logger.input_jump = 0.01 * full_input;
        logger.repeated_share = loggers.happens(0.25) ? loggers.between(0.002, 0.01) : 0.0;
        logger.missing_share = loggers.happens(0.3) ? loggers.between(0.002, 0.02) : 0.0;
        logger.own_clock = loggers.happens(0.7);

        const blind::OpenCase made = blind::make_open_case({&echoing, {}}, set_seed, number);
        EXPECT_EQ(made.truth.noise, deviation);
        EXPECT_EQ(made.truth.coloured, coloured);
        ASSERT_EQ(made.records.size(), expected.train.size() + expected.validate.size());
        std::size_t record = 0;
        for (const auto& [name, some, kinds] : {std::tuple("train", &expected.train, &made.truth.train),
                                                std::tuple("validate", &expected.validate, &made.truth.validate)}) {
            ASSERT_EQ(kinds->size(), some->size());
            for (std::size_t i = 0; i < some->size(); ++i, ++record) {
                const Given& given = (*some)[i];
                EXPECT_EQ((*kinds)[i], given.kind);
                const std::string number_of = some->size() > 1 ? "-" + std::to_string(i + 1) : "";
                EXPECT_EQ(made.records[record].first, name + number_of + ".csv");
                const auto noise = blind::make_noise(given.held.time_s.size(), deviation, memory, noises);
                EXPECT_EQ(made.records[record].second,
                          blind::write_log(logger, given.held, echo(given.held, noise), given.from, loggers));
            }
        }
    }
}

}  // namespace
