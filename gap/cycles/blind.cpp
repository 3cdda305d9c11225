#include "gap/cycles/blind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "base/failure.hpp"
#include "gap/cycles/diagnose.hpp"
#include "gap/cycles/evidence.hpp"
#include "qemu/emulate/silicon_loops.hpp"

namespace gap::cycles {
namespace {

// The same numbers everywhere: of the engine's bits, not by the library's distributions.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t count) {
        return std::min(count - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(count))));
    }

private:
    std::mt19937_64 engine_;
};

void add_switch(Secret& secret, Draw& draw, const std::vector<std::string>& switches) {
    secret.without.push_back(switches[draw.below(switches.size())]);
    secret.effects.push_back(secret.without.back());
}

// Sizes that the rows can show: these calls take some hundred cycles.
void add_cost(Secret& secret, Draw& draw) {
    switch (draw.below(4)) {
        case 0:
            secret.overhead = std::round(draw.between(15.0, 60.0));
            secret.effects.emplace_back("call_overhead");
            break;
        case 1:
            secret.maintenance = std::round(draw.between(40.0, 200.0));
            secret.effects.emplace_back("cache_maintenance");
            break;
        case 2:
            secret.ratio = draw.below(2) == 0 ? draw.between(0.7, 0.92) : draw.between(1.08, 1.5);
            secret.effects.emplace_back("clock_ratio");
            break;
        default:
            secret.contention = draw.between(0.1, 0.4);
            secret.effects.emplace_back("bus_contention");
    }
}

// Where rules of a set act: those of the floating-point unit, whose stores are late for the next load of a bank; and
// those of branches and what is fetched behind them. Likewise the mechanisms that no core has: a line that another
// replacement keeps is read from no memory behind its cache.
const std::map<std::string, std::vector<std::string>> touched_by{
    {"barred", {"fpu_latency", "load_bank_conflict"}},
    {"chain", {"fpu_latency", "load_bank_conflict"}},
    {"unfolded", {"branch_mispredict", "fetch_alignment", "single_issue"}},
    {"history_predictor", {"branch_mispredict"}},
    {"random_replacement", {"dcache_misses", "icache_misses", "flash_wait_states"}},
    {"serial_fpu", {"fpu_latency", "load_bank_conflict"}},
};

std::vector<std::string> effects_of(const std::vector<Step>& steps) {
    std::vector<std::string> named;
    for (const Step& step : steps) {
        named.push_back(step.effect);
    }
    return named;
}

bool is_right_of_other_rules(const Explanation& found, const Secret& secret) {
    std::vector<std::string> named = effects_of(found.steps);
    const std::vector<std::string>& touched = touched_by.at(secret.other_rules());
    std::erase_if(named, [&](const std::string& effect) {
        return std::find(touched.begin(), touched.end(), effect) != touched.end();
    });
    if (secret.effects.empty()) {
        return found.outcome != Outcome::attributed || named.empty();
    }
    const auto is_the_cost = [&](const std::vector<std::string>& all) { return all == secret.effects; };
    if (found.outcome == Outcome::ambiguous) {
        return std::any_of(found.alternatives.begin(), found.alternatives.end(), [&](const Step& other) {
            std::vector<std::string> together = named;
            together.push_back(other.effect);
            return is_the_cost(together);
        });
    }
    return found.outcome == Outcome::attributed && is_the_cost(named);
}

}  // namespace

std::vector<std::string> switches_that_show(const std::string& core, const Predict& predict) {
    constexpr double shows = 0.03;
    std::vector<qemu::CoreVariant> variants{{core}};
    for (const std::string_view name : timing::effect_names) {
        variants.push_back({core, "", {std::string(name)}});
    }
    const auto predicted = predict(variants);
    std::vector<std::string> found;
    for (std::size_t v = 1; v < variants.size(); ++v) {
        double difference = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < predicted[v].size(); ++i) {
            difference += std::fabs(predicted[v][i].nominal - predicted[0][i].nominal);
            sum += predicted[v][i].nominal;
        }
        if (difference > shows * sum) {
            found.push_back(variants[v].without.front());
        }
    }
    return found;
}

std::vector<Secret> draw_secrets(std::size_t cases, std::uint64_t seed, const std::vector<std::string>& switches) {
    Draw draw(seed);
    std::vector<Secret> secrets;
    while (secrets.size() < cases) {
        const double kind = draw.between(0.0, 1.0);
        Secret secret;
        if (kind < 0.25) {
            secret.kind = "nothing";
        } else if (kind < 0.40) {
            secret.kind = "two";
            add_switch(secret, draw, switches);
            add_cost(secret, draw);
        } else if (kind < 0.55) {
            secret.kind = "unlisted";
            secret.sawtooth = draw.between(0.15, 0.4);
        } else if (kind < 0.775) {
            secret.kind = "switch";
            add_switch(secret, draw, switches);
        } else {
            secret.kind = "cost";
            add_cost(secret, draw);
        }
        std::sort(secret.effects.begin(), secret.effects.end());
        secrets.push_back(std::move(secret));
    }
    return secrets;
}

bool has_place(const std::string& rules) { return touched_by.contains(rules); }

std::vector<std::string> other_rules_of(const std::string& core, const std::filesystem::path& cores) {
    const Question question = question_about({}, {core}, cores);
    // A core that does not pay for all effects is judged by others, and has no rules of its own there.
    const auto own = question.fitting.find(core);
    std::vector<std::string> rules = own == question.fitting.end() ? std::vector<std::string>{} : own->second;
    // The nominal rules are everywhere.
    std::erase_if(rules, [](const std::string& set) { return !has_place(set); });
    if (rules.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: expected a core file with rival rules of a Cortex-M7", core));
    }
    for (const std::string& mechanism : timing::mechanism_names()) {
        rules.push_back(mechanism);
    }
    return rules;
}

std::string core_with(const std::string& core, const std::string& mechanism) {
    return fmt::format("base = \"{}\"\nmechanisms = [\"{}\"]\n", core, mechanism);
}

std::vector<Secret> draw_other_rules(std::size_t cases, std::uint64_t seed, const std::vector<std::string>& rules) {
    const std::vector<std::string> mechanisms = timing::mechanism_names();
    Draw draw(seed);
    std::vector<Secret> secrets;
    while (secrets.size() < cases) {
        Secret secret{.kind = "rules"};
        const std::string& other = rules[draw.below(rules.size())];
        const bool is_mechanism = std::ranges::find(mechanisms, other) != mechanisms.end();
        (is_mechanism ? secret.mechanism : secret.set) = other;
        if (draw.below(2) == 0) {
            secret.kind = "rules and cost";
            add_cost(secret, draw);
        }
        secrets.push_back(std::move(secret));
    }
    return secrets;
}

std::string name_of_case(std::size_t number) { return fmt::format("case-{:03}", number); }

std::string seal(const std::vector<Secret>& secrets) {
    nlohmann::ordered_json truths = nlohmann::ordered_json::array();
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        const Secret& secret = secrets[c];
        truths.push_back({{"case", name_of_case(c + 1)},
                          {"kind", secret.kind},
                          {"effects", secret.effects},
                          {"rules", secret.other_rules().empty() ? "nominal" : secret.other_rules()},
                          {"ratio", secret.ratio},
                          {"overhead", secret.overhead},
                          {"maintenance", secret.maintenance},
                          {"contention", secret.contention},
                          {"sawtooth", secret.sawtooth}});
    }
    return truths.dump(2) + "\n";
}

std::vector<qemu::MeasuredCycles> blind_rows(bool beyond_caches) {
    std::vector<qemu::MeasuredCycles> rows;
    for (const char* kernel : {"shift_fir_q31", "shift_firfma_f32", "ring_plain_q31", "ring_plain_f32",
                               "mirror_multi_f32", "mirror_smlald_q15"}) {
        for (const bool on_bus : {false, true}) {
            for (const std::uint32_t taps : {10U, 20U, 40U, 64U, 100U, 128U, 600U, 1000U}) {
                const bool is_long = taps > 128;
                if (is_long && (!beyond_caches || !on_bus || qemu::find_loop(kernel) != nullptr)) {
                    continue;  // a loop of published measurements has no more taps than they
                }
                rows.push_back({kernel, on_bus ? "flash_cached" : "itcm", on_bus ? "axi" : "dtcm", on_bus, taps, 0.0,
                                static_cast<unsigned>(rows.size() + 2)});
            }
        }
    }
    return rows;
}

void measure(std::vector<qemu::MeasuredCycles>& rows, const std::vector<qemu::PredictedCycles>& predicted,
             const Secret& secret, std::uint64_t seed) {
    Draw draw(seed);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        double call = predicted[i].nominal - predicted[i].beside;
        call *= on_bus(rows[i]) ? 1.0 + secret.contention : 1.0;
        call *= rows[i].taps % 3 == 1 ? 1.0 + secret.sawtooth : 1.0;
        const double beside = predicted[i].beside + secret.overhead + (rows[i].maintenance ? secret.maintenance : 0.0);
        const double counter = static_cast<double>(draw.below(3)) - 1.0;
        rows[i].cycles = std::max(1.0, std::round(secret.ratio * (call + beside)) + counter);
    }
}

bool names(const Explanation& found, const Secret& secret) {
    if (secret.kind == "nothing") {
        return found.outcome == Outcome::no_gap;
    }
    if (secret.kind == "unlisted") {
        return found.outcome == Outcome::unknown;
    }
    if (!secret.other_rules().empty()) {
        return is_right_of_other_rules(found, secret);
    }
    std::vector<std::string> named = effects_of(found.steps);
    if (found.outcome == Outcome::ambiguous) {
        // What cannot be told apart: one of the alternatives beside the steps.
        return std::any_of(found.alternatives.begin(), found.alternatives.end(), [&](const Step& other) {
            std::vector<std::string> together = named;
            together.push_back(other.effect);
            std::sort(together.begin(), together.end());
            return together == secret.effects;
        });
    }
    std::sort(named.begin(), named.end());
    return found.outcome == Outcome::attributed && named == secret.effects;
}

}  // namespace gap::cycles
