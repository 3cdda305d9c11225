// The table of counters: its lookups, and that everybody lives from it.
#include "bench/rows/counters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bench/gate/compare.hpp"
#include "bench/gate/rules.hpp"
#include "bench/report/difference.hpp"
#include "bench/report/page.hpp"
#include "bench/rows/csv.hpp"
#include "bench/studies/equal_cost.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/sweep.hpp"

namespace {

using bench::Counter;
using bench::CounterFacts;
using bench::Json;

TEST(Counters, AreFoundByTheirNamesAndAFamilyByItsBeginning) {
    std::set<std::string_view> names;
    for (const CounterFacts& facts : bench::counter_table()) {
        EXPECT_TRUE(names.insert(facts.name).second) << facts.name << " is there twice";
        EXPECT_EQ(bench::find_counter(facts.name), &facts);
        EXPECT_FALSE(facts.meaning.empty()) << facts.name;
        EXPECT_EQ(facts.title.empty(), facts.shown != bench::Shown::drawn) << facts.name;
    }
    EXPECT_EQ(bench::name_of(Counter::error_max), "error_max");
    EXPECT_EQ(bench::name_of(Counter::cpu_time), "cpu_time");  // behind the family
    EXPECT_EQ(bench::member_of(bench::CounterFamily::stall, "load_use"), "stall_load_use");
    const CounterFacts* stall = bench::find_counter("stall_a_cause_of_tomorrow");
    ASSERT_NE(stall, nullptr);
    EXPECT_EQ(stall, &bench::facts_of(bench::CounterFamily::stall));
    for (const char* unknown :
         {"", "error", "error_maximum", "state_byte", "state_bytes_", "stall", "zzz", "Error_max"}) {
        EXPECT_EQ(bench::find_counter(unknown), nullptr) << unknown;
        EXPECT_TRUE(bench::is_measured(unknown)) << "a number of another program is compared";
    }
    EXPECT_FALSE(bench::is_measured("real_time"));
    EXPECT_FALSE(bench::is_measured("threads"));
    EXPECT_TRUE(bench::is_measured("stall_load_use"));
}

// Of Google Benchmark's own fields a time is judged as the host's, and the others by nobody.
TEST(Counters, OfBookkeepingOnlyTimesAreJudged) {
    for (const CounterFacts& facts : bench::counter_table()) {
        if (facts.role != bench::Role::counter) {
            const bool is_time = facts.name == "real_time" || facts.name == "cpu_time";
            EXPECT_EQ(facts.role == bench::Role::time, is_time) << facts.name;
            EXPECT_EQ(facts.better, is_time ? bench::Better::lower : bench::Better::neither) << facts.name;
            EXPECT_EQ(facts.layer, is_time ? bench::CounterLayer::host_time : bench::CounterLayer::none) << facts.name;
        }
    }
    // A family's members begin as it does; a name that sorts before all of them is none.
    EXPECT_EQ(bench::find_counter("stall_"), &bench::facts_of(bench::CounterFamily::stall));
    EXPECT_EQ(bench::find_counter("a"), nullptr);
}

// A row with every counter of the table, and one of the family.
Json row_of_all(double value) {
    Json row = bench::make_row("gl/a_b_c/order:0.5/taps:50/accuracy/signal:step", 1);
    for (const CounterFacts& facts : bench::counter_table()) {
        if (facts.role == bench::Role::counter) {
            row[facts.is_family ? bench::member_of(bench::CounterFamily::stall, "x") : std::string(facts.name)] = value;
        }
    }
    return row;
}

std::string in_a_row(const CounterFacts& facts) { return std::string(facts.name) + (facts.is_family ? "x" : ""); }

TEST(Counters, WhatIsInTheTableIsShownEverywhere) {
    bench::report::Input input{"a.json", {}, {}};
    input.results.rows = {row_of_all(1.0)};
    bench::report::Input other{"b.json", {}, {}};
    other.results.rows = {row_of_all(2.0)};
    const std::string page = bench::report::make_page(input, nullptr);
    const auto begin = page.find("id=\"data\">") + 10;
    const Json data = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    const Json& columns = data.at("files")[0].at("tables")[0].at("numbers");
    std::set<std::string> said;
    for (const Json& counter : data.at("counters")) {
        said.insert(counter.at("name").get<std::string>());
    }
    const std::string csv = "," + bench::to_csv(input.results.rows);
    const auto rules = bench::gate::read_rules(TEST_PROJECT "/results/thresholds.toml");
    const auto compared = bench::gate::compare(input.results, other.results, rules, {"*"}, {"*"});
    const auto differences = bench::report::differences(input.results.rows, other.results.rows);
    for (const CounterFacts& facts : bench::counter_table()) {
        const std::string name = in_a_row(facts);
        const bool is_counter = facts.role == bench::Role::counter;
        EXPECT_EQ(columns.contains(name), facts.shown != bench::Shown::nowhere) << name;
        EXPECT_EQ(said.contains(std::string(facts.name)), facts.shown != bench::Shown::nowhere) << name;
        EXPECT_TRUE(!is_counter || facts.shown != bench::Shown::nowhere) << name;
        EXPECT_EQ(csv.substr(0, csv.find('\n')).find("," + name) != std::string::npos, facts.role != bench::Role::index)
            << name;
        EXPECT_EQ(std::ranges::count(compared.pairs, name, &bench::gate::Pair::counter), is_counter ? 1 : 0) << name;
        EXPECT_EQ(std::ranges::count(differences, name, &bench::report::Difference::counter), is_counter ? 1 : 0)
            << name;
    }
}

// What the gate is told in words of its thresholds is what the table says.
TEST(Counters, OurThresholdsAgreeWithTheTable) {
    std::size_t spoken_of = 0;
    for (const auto& rule : bench::gate::read_rules(TEST_PROJECT "/results/thresholds.toml")) {
        for (const CounterFacts& facts : bench::counter_table()) {
            if (rule.wants_counter(std::string(facts.name))) {
                ++spoken_of;
                EXPECT_EQ(bench::gate::name_of(rule.layer), bench::name_of(facts.layer)) << facts.name;
                EXPECT_EQ(bench::name_of(rule.better), bench::name_of(facts.better)) << facts.name;
            }
        }
        for (const std::string& name : rule.counters) {
            EXPECT_NE(bench::find_counter(name), nullptr) << name;
        }
    }
    EXPECT_GT(spoken_of, 20U);
}

// Every number of rows that are really made is in the table.
void expect_known(const std::vector<Json>& rows) {
    std::set<std::string> unknown;
    for (const Json& row : rows) {
        for (const auto& [field, value] : row.items()) {
            if (value.is_number() && bench::find_counter(field) == nullptr) {
                unknown.insert(field);
            }
        }
    }
    EXPECT_THAT(unknown, testing::IsEmpty());
    EXPECT_FALSE(rows.empty());
}

TEST(Counters, OfEveryRowThatIsMadeHereAreInTheTable) {
    bench::Sweep sweep;
    sweep.kernels = {"ring_plain_q31", "modes_plain_f32"};
    sweep.orders = {0.5};
    sweep.lengths = {{50}};
    sweep.signals = {"step"};
    sweep.samples = 200;
    expect_known(bench::measure_accuracy(sweep, {0}).at(0));
    bench::EqualCost wanted;
    wanted.costs = {16};
    wanted.orders = {0.5};
    wanted.signals = {"step"};
    wanted.samples = 100;
    expect_known(bench::measure_equal_cost(wanted));
}

}  // namespace
