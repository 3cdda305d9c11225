// Errors and costs that another run has measured are taken as they are.
#include <gtest/gtest.h>

#include "bench/choose/earlier.hpp"
#include "bench/choose/question.hpp"

namespace {

using choose::MeasuredErrors;
using choose::Question;

constexpr std::size_t samples = 150;

choose::Conditions conditions() { return {0.5, 1e-3, {"step", "sine50", "noise"}, samples, 2020}; }

bench::Json row(const std::string& name, std::initializer_list<std::pair<const char*, double>> fields) {
    bench::Json made = bench::make_row(name, 1);
    for (const auto& [field, value] : fields) {
        made[field] = value;
    }
    return made;
}

TEST(Earlier, ErrorsAreThoseOfTheOrderAndOfNothingElse) {
    choose::Earlier earlier;
    earlier.errors = true;
    earlier.rows = {
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.5}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:sine50", {{"error_max", 0.25}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:noise", {{"error_max", 0.125}}),
        row("gl/ring_plain_f32/order:0.9/taps:5/accuracy/signal:step", {{"error_max", 0.75}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step/amplitude:0.0625", {{"error_max", 0.875}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/host", {{"error_max", 0.875}}),
        row("gl/ring_plain_f32/order:0.5/taps:500/accuracy/signal:step", {{"error_max", 0.875}}),
        row("gl/modes_plain_f32/order:0.5/taps:9+1/accuracy/signal:step", {{"error_max", 0.875}})};
    bench::Json wrong = row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.875}});
    bench::mark_error(wrong, "wrong");
    earlier.rows.push_back(wrong);
    bench::Json mean = row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.875}});
    mean["run_type"] = "aggregate";
    earlier.rows.push_back(mean);
    Question question;
    question.conditions = conditions();
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    choose::remember(earlier, question, errors);
    EXPECT_EQ(errors.error("ring_plain_f32", 5).error, 0.5);
    EXPECT_EQ(errors.measured(), 0U);
    earlier.errors = false;
    MeasuredErrors fresh(0.5, choose::make_records(conditions(), 1));
    choose::remember(earlier, question, fresh);
    EXPECT_NE(fresh.error("ring_plain_f32", 5).error, 0.5);
    EXPECT_EQ(fresh.remembered(), 0U);
}

// No board is needed for costs that another run of the same firmware has.
TEST(Earlier, CostsOfTheTargetAreItsCyclesBandAndBytes) {
    choose::Earlier earlier;
    earlier.on_target = true;
    bench::Json of_double = row("gl/shift_plain_f64/order:0.5/taps:5/m7:m7-ideal", {{"model_cycles_per_sample", 900.0},
                                                                                    {"model_cycles_high", 950.0},
                                                                                    {"instructions_per_sample", 1800.0},
                                                                                    {"state_bytes", 40.0},
                                                                                    {"coefficient_bytes", 32.0}});
    of_double["counted_at_order"] = 0.5;
    bench::Json elsewhere = of_double;
    elsewhere["name"] = "gl/shift_plain_f64/order:0.5/taps:6/m7:m7-ideal";
    elsewhere["counted_at_order"] = 0.9;
    earlier.rows = {
        row("gl/ring_plain_f32/order:0.5/taps:5/m7:m7-ideal", {{"model_cycles_per_sample", 30.0},
                                                               {"model_cycles_high", 33.0},
                                                               {"instructions_per_sample", 61.0},
                                                               {"state_bytes", 28.0},
                                                               {"coefficient_bytes", 16.0}}),
        row("gl/ring_plain_f32/order:0.5/taps:7/m7:m7-ideal",
            {{"model_cycles_per_sample", 30.0}, {"instructions_per_sample", 61.0}}),
        row("gl/ring_plain_f32/order:0.5/taps:7/m7:another-core",
            {{"model_cycles_per_sample", 70.0}, {"model_cycles_high", 73.0}, {"instructions_per_sample", 81.0}}),
        of_double, elsewhere};
    Question question;
    question.conditions = conditions();
    qemu::Board board;
    board.cores = TEST_CORES;
    const auto taken = [&](const std::string& core) {
        question.core = core;
        choose::OnTarget costs(board, 0.5, samples, 2020, 1, core);
        choose::remember(earlier, question, costs);
        const std::vector<choose::Cost> found = costs.costs({{"ring_plain_f32", 5}, {"shift_plain_f64", 5}});
        EXPECT_EQ(costs.remembered(), 2U);
        EXPECT_EQ(costs.measured(), 0U);
        EXPECT_EQ(costs.costs({{"ring_plain_f32", 5}}).front().value, found[0].value);
        EXPECT_EQ(costs.remembered(), 2U);
        // Software double's other order is not taken, nor a row without its band: both would have to be measured.
        EXPECT_ANY_THROW((void)costs.costs({{"shift_plain_f64", 6}}));
        return found;
    };
    const auto modelled = taken("m7-ideal");
    EXPECT_EQ(modelled[0].value, 30.0);
    EXPECT_EQ(modelled[0].limited, 33.0);
    EXPECT_EQ(modelled[0].bytes, 44.0);
    EXPECT_EQ(modelled[0].noise, 0.0);
    EXPECT_EQ(modelled[1].value, 900.0);
    EXPECT_EQ(modelled[1].limited, 950.0);
    const auto counted = taken("");
    EXPECT_EQ(counted[0].value, 61.0);
    EXPECT_EQ(counted[0].limited, 61.0);
    EXPECT_EQ(counted[1].bytes, 72.0);
    choose::OnTarget cycles(board, 0.5, samples, 2020, 1, "m7-ideal");
    EXPECT_EQ(cycles.unit(), "model cycles");
    EXPECT_EQ(cycles.limited_unit(), "model cycles, upper end of the band");
    EXPECT_TRUE(cycles.exact());
    EXPECT_TRUE(cycles.costly("shift_plain_f64"));
    EXPECT_FALSE(cycles.costly("shift_plain_f32"));
    question.core = "m7-ideal";
    choose::remember(earlier, question, cycles);
    EXPECT_ANY_THROW((void)cycles.costs({{"ring_plain_f32", 7}}));
    choose::OnTarget counts(board, 0.5, samples, 2020, 1);
    EXPECT_EQ(counts.unit(), "instructions");
    EXPECT_EQ(counts.limited_unit(), "instructions");
    earlier.on_target = false;
    choose::remember(earlier, question, counts);
    EXPECT_ANY_THROW((void)counts.costs({{"ring_plain_f32", 5}}));
}

// Of nine repetitions the median, half of what the middle half spans, and the cycles' median, whatever their order.
TEST(HostTimes, AreTheMedianOfTheirRepetitions) {
    const std::string name = "gl/ring_plain_f32/order:0.5/taps:50/host";
    std::vector<bench::Json> rows;
    for (const double ns : {50.0, 10.0, 20.0, 40.0, 90.0, 30.0, 60.0, 80.0, 70.0}) {
        rows.push_back(row(name, {{"real_time", ns},
                                  {"cycles_per_sample", 1000.0 - ns},
                                  {"state_bytes", 200.0},
                                  {"coefficient_bytes", 196.0}}));
    }
    bench::Json mean = row(name, {{"real_time", 1e6}, {"cycles_per_sample", 1e6}});
    mean["run_type"] = "aggregate";
    rows.push_back(mean);
    rows.push_back(row("gl/ring_plain_f32/order:0.5/taps:51/host", {{"real_time", 1.0}}));
    for (bench::Json& one : rows) {
        one["run_name"] = one["name"];
    }
    const choose::Cost cost = choose::cost_of_times(rows, name);
    EXPECT_EQ(cost.value, 50.0);
    EXPECT_EQ(cost.noise, 20.0);  // from 30 to 70
    EXPECT_EQ(cost.limited, 950.0);
    EXPECT_EQ(cost.bytes, 396.0);
    EXPECT_EQ(cost.fault, "");
    // Between two values in proportion.
    const choose::Cost two = choose::cost_of_times({rows[0], rows[1]}, name);  // 50 and 10
    EXPECT_EQ(two.value, 30.0);
    EXPECT_EQ(two.noise, 10.0);  // 20 to 40
    EXPECT_EQ(choose::cost_of_times({}, name).fault, "not timed");
    bench::mark_error(rows[3], "wrong answer");
    EXPECT_EQ(choose::cost_of_times({rows[3]}, name).fault, "wrong answer");
    EXPECT_EQ(choose::cost_of_times({rows[0], rows[3]}, name).fault, "wrong answer");
}

}  // namespace
