// A score is published with its seed, and can be held against another only where that seed still makes the same cases.
// Whoever changes what a seed makes changes published_seeds.txt with it, and the scores of docs/measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "drive/log.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/without_model.hpp"
#include "drive/stand/experiment.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using Numbers = std::vector<std::pair<std::string, double>>;

// Each sample weighs otherwise, so that neither a sample nor a pair of them can change unseen.
double checksum(const std::vector<double>& values) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += values[i] * (1.0 + 0.5 * std::sin(static_cast<double>(i)));
    }
    return sum;
}

void add_record(Numbers& numbers, const std::string& name, const std::string& csv) {
    const drive::Log log = drive::parse_log(csv, name);
    numbers.emplace_back(name + ".samples", static_cast<double>(log.output.size()));
    numbers.emplace_back(name + ".time_s", checksum(log.time_s));
    numbers.emplace_back(name + ".input", checksum(log.input));
    numbers.emplace_back(name + ".output", checksum(log.output));
}

template <class Truth>
void add_truth(Numbers& numbers, const Truth& truth) {
    for (const blind::Parameters& parameters : truth.parameters) {
        numbers.insert(numbers.end(), parameters.begin(), parameters.end());
    }
    numbers.emplace_back("noise", truth.noise);
    numbers.emplace_back("gap_base", truth.gap_base);
    numbers.emplace_back("noise_floor", truth.noise_floor);
    numbers.emplace_back("from_s", truth.from_s);
    numbers.emplace_back("to_s", truth.to_s);
}

Numbers numbers_of(const blind::Case& made) {
    Numbers numbers;
    add_truth(numbers, made.truth);
    numbers.emplace_back("train_deviation", made.truth.train_deviation);
    numbers.emplace_back("validate_deviation", made.truth.validate_deviation);
    add_record(numbers, "train", made.train);
    add_record(numbers, "validate", made.validate);
    return numbers;
}

Numbers numbers_of(const blind::OpenCase& made) {
    Numbers numbers;
    add_truth(numbers, made.truth);
    numbers.emplace_back("left_in_training", made.truth.left_in_training);
    numbers.emplace_back("left_on_validation", made.truth.left_on_validation);
    for (const auto& [name, csv] : made.records) {
        add_record(numbers, name, csv);
    }
    return numbers;
}

std::string words_of(const Numbers& numbers) {
    std::string text;
    for (const auto& [name, value] : numbers) {
        text += fmt::format(" {}={:.9g}", name, value);
    }
    return text;
}

// A case's line: its name, then its numbers.
std::map<std::string, std::string> published() {
    std::ifstream in(TEST_PUBLISHED_SEEDS);
    std::map<std::string, std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (const std::size_t colon = line.find(':'); !line.starts_with('#') && colon != std::string::npos) {
            lines[line.substr(0, colon)] = line.substr(colon + 1);
        }
    }
    return lines;
}

// To the sixth digit: libraries of mathematics differ in the last ones.
void expect_published(const std::string& name, const Numbers& numbers) {
    static const std::map<std::string, std::string> lines = published();
    const auto found = lines.find(name);
    bool same = found != lines.end();
    if (same) {
        std::istringstream words(found->second);
        std::string word;
        for (const auto& [one, value] : numbers) {
            same = same && words >> word && word.starts_with(one + "=");
            const double expected = same ? std::stod(word.substr(one.size() + 1)) : 0.0;
            same = same && std::fabs(value - expected) <= 1e-6 * std::fabs(expected);
        }
        same = same && !(words >> word);
    }
    EXPECT_TRUE(same) << "of " << name << " expected:" << (found != lines.end() ? found->second : " no line")
                      << "\nfound:\n"
                      << name << ':' << words_of(numbers);
}

TEST(PublishedSeeds, OfASimulationMakeTheirCases) {
    std::size_t number = 0;
    const auto hold = [&](const std::string& name, const blind::Plan& plan) {
        expect_published(name, numbers_of(blind::make_case(plan, 7, ++number)));
    };
    for (const auto& [effects, kind] :
         {std::pair(&blind::listed_effects(), Class::single), std::pair(&blind::unlisted_effects(), Class::unlisted)}) {
        for (const std::string& effect : *effects) {
            hold(effect, {kind, {effect}, {static_cast<blind::EffectSize>(number % 3)}, false});
        }
    }
    for (const char* effect : {"gain_error", "input_curve", "supply_sag"}) {
        hold(fmt::format("{} at one level", effect), {Class::same, {effect}, {blind::EffectSize::clear}, false});
    }
    hold("none", {});
    hold("none, on a new profile", {Class::none, {}, {}, true});
}

class PublishedOpenSeeds : public testing::TestWithParam<const blind::Family*> {};

TEST_P(PublishedOpenSeeds, MakeTheirCases) {
    const blind::Family& family = *GetParam();
    std::size_t number = 0;
    const auto hold = [&](Class kind, const std::vector<std::string>& effects) {
        for (const std::string& effect : effects) {
            ++number;
            const auto size = static_cast<blind::EffectSize>(1 + number % 2);
            const auto made = blind::make_open_case({&family, {kind, {effect}, {size}, false}}, 7, number);
            expect_published(fmt::format("{} {}", family.domain, effect), numbers_of(made));
        }
    };
    hold(Class::single, family.listed);
    hold(Class::unlisted, family.unlisted);
    hold(Class::taken_up, family.taken_up);
    const blind::OpenPlan none{&family, {Class::none, {}, {}, true}};
    expect_published(fmt::format("{} none", family.domain), numbers_of(blind::make_open_case(none, 7, ++number)));
}

INSTANTIATE_TEST_SUITE_P(, PublishedOpenSeeds, testing::ValuesIn(blind::families()),
                         [](const auto& info) { return std::string(info.param->domain); });

TEST(PublishedSeeds, OfTheStandMakeTheirSeries) {
    for (const char* name : {"step", "pulse", "staircase", "ramp", "chirp", "prbs", "release"}) {
        stand::Experiment experiment;
        experiment.name = name;
        Numbers numbers;
        const auto records = stand::run_series({}, experiment, 7);
        for (std::size_t i = 0; i < records.size(); ++i) {
            add_record(numbers, fmt::format("series-{}", i + 1), stand::to_csv(records[i], false));
        }
        expect_published(fmt::format("stand {}", name), numbers);
    }
}

}  // namespace
