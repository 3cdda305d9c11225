// Generated models: what is chosen, what its steps are, and that a header has the library's bits.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/steppers/model/model_choice.hpp"
#include "bench/steppers/model/model_header.hpp"
#include "bench/steppers/model/report.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/response.hpp"
#include "tests/generate/board_here.hpp"

namespace {

using generate::ModelSpec;

// Model (12) without its dead time but for three samples.
drive::Model niopdt(double delay_s = 0.003) {
    drive::Model model;
    model.denominator = {{0.18234, 1.9909}, {0.65536, 0.98319}, {0.9992, 0.0}};
    model.delay_s = delay_s;
    return model;
}

ModelSpec two_and_eight() {
    ModelSpec spec{niopdt(), 0.001};
    spec.memory = {18, 8};
    return spec;
}

// Held to the exact response by itself. 5.4e-4 is what the sampling leaves of (12) at 1 ms.
TEST(ModelChoice, KeepsItsErrorWithTheFewestMultiplications) {
    const drive::Model model = niopdt();
    const generate::ModelChoice choice = generate::choose_model(model, 0.001, 1e-3, 10'000);
    EXPECT_EQ(choice.spec.writing, drive::Writing::delta);
    EXPECT_FALSE(choice.spec.compensated);
    EXPECT_NEAR(choice.scheme, 5.3e-4, 2e-5);
    EXPECT_GT(choice.loop_gain, 0.0);
    EXPECT_LT(choice.loop_gain, 1.0);
    generate::SteppedModel stepped(choice.spec);
    std::vector<double> times;
    for (int k = 0; k <= 10'000; ++k) {
        times.push_back(0.001 * k);
    }
    const auto exact = drive::respond(model, std::vector<drive::Change>{{0.0, 1.0}}, times);
    double largest = 0.0;
    double peak = 0.0;
    for (const double one : exact) {
        largest = std::max(largest, std::fabs(static_cast<double>(stepped.step(1.0F)) - one));
        peak = std::max(peak, std::fabs(one));
    }
    EXPECT_NEAR(largest / peak, choice.errors.step, 1e-9);
    EXPECT_LE(choice.errors.step, 1e-3);
    EXPECT_LE(choice.errors.random, 1e-3);
    // A mode fewer does not keep it.
    const generate::ModelJudge judge(model, 0.001, 10'000);
    ModelSpec fewer = choice.spec;
    fewer.memory = {choice.spec.memory.taps - 2, choice.spec.memory.modes - 1};
    const generate::ModelErrors errors = judge.errors_of(fewer);
    EXPECT_GT(std::max(errors.step, errors.random), 1e-3);
}

// Below what the sampling errs at first order, it takes the second.
TEST(ModelChoice, TakesTheSecondOrderWhereTheFirstErrsMore) {
    const generate::ModelChoice choice = generate::choose_model(niopdt(), 0.001, 1e-4, 10'000);
    EXPECT_EQ(choice.spec.writing, drive::Writing::bdf2);
    EXPECT_LT(choice.scheme, 2e-5);
    EXPECT_LE(choice.errors.step, 1e-4);
    EXPECT_LE(choice.errors.random, 1e-4);
}

// Backward differences: y_k = K (1 - (1 + h/T)^-n), n samples behind the dead time.
TEST(SteppedModel, OfFirstOrderIsTheClosedForm) {
    const drive::Model model = drive::make_fopdt(2.0, 0.25, 0.01);
    const generate::ModelChoice choice = generate::choose_model(model, 0.001, 3e-3, 5000);
    EXPECT_EQ(choice.spec.memory.modes, 0U);
    EXPECT_LE(choice.spec.memory.taps, 2U);
    EXPECT_EQ(choice.loop_gain, 0.0);
    generate::SteppedModel stepped(choice.spec);
    for (int k = 0; k < 3000; ++k) {
        const double expected = k < 11 ? 0.0 : 2.0 * (1.0 - std::pow(1.0 + 0.001 / 0.25, -(k - 10)));
        EXPECT_NEAR(stepped.step(1.0F), expected, 2e-5) << k;
    }
}

TEST(ModelChoice, AnIntegratorIsNotForgotten) {
    drive::Model model;
    model.denominator = {{1.0, 1.5}, {0.5, 0.5}};
    const generate::ModelChoice choice = generate::choose_model(model, 0.001, 1e-2, 20'000);
    EXPECT_LE(choice.errors.step, 1e-2);
}

TEST(ModelChoice, RefusesWhatCannotBeStepped) {
    const auto status_of = [](const drive::Model& model, double max_error) -> std::optional<glsum::Exit> {
        try {
            (void)generate::choose_model(model, 0.001, max_error, 2000);
            return std::nullopt;
        } catch (const glsum::Failure& failure) {
            return failure.status();
        }
    };
    drive::Model unstable = niopdt();
    unstable.denominator[2].coefficient = -1.0;
    EXPECT_EQ(status_of(unstable, 1e-3), glsum::Exit::bad_input);
    drive::Model lead = niopdt();
    lead.numerator = {{1.0, 0.5}, {1.0, 0.0}};
    EXPECT_EQ(status_of(lead, 1e-3), glsum::Exit::bad_input);
    EXPECT_EQ(status_of(niopdt(), 1e-9), glsum::Exit::check_failed);
}

TEST(ModelHeader, HasTheLibrarysBitsAndNoOthers) {
    for (const auto& [writing, compensated] :
         {std::pair(drive::Writing::delta, false), std::pair(drive::Writing::delta, true),
          std::pair(drive::Writing::bdf2, true)}) {
        ModelSpec spec = two_and_eight();
        spec.writing = writing;
        spec.compensated = compensated;
        spec.memory = writing == drive::Writing::bdf2 ? drive::Memory{27, 11} : spec.memory;
        const std::string text = generate::make_model_header(spec, "own", "none", {});
        EXPECT_TRUE(generate::check_bits_here(generate::written(spec, "own", text)).good());
    }
    const ModelSpec spec = two_and_eight();
    const std::string text = generate::make_model_header(spec, "own", "none", {"", "a line with */ in it"});
    EXPECT_NE(text.find("\n *\n * a line with * / in it\n"), std::string::npos);
    const auto first_wrong = [&](const std::string& what, const std::string& with) {
        std::string other = text;
        const std::size_t at = other.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        other.replace(at, what.size(), with);
        return generate::check_bits_here(generate::written(spec, "own", other)).first_wrong;
    };
    EXPECT_EQ(first_wrong("#define OWN_F32_WAITING 4U", "#define OWN_F32_WAITING 3U"), 4U);
    EXPECT_EQ(first_wrong("S->newest = sum;", "S->newest = 0.5F * sum;"), 6U);
    EXPECT_EQ(first_wrong("? 0U : 1U;\n}\n\n#endif /* OWN_F32_H */", "? 1U : 0U;\n}\n\n#endif /* OWN_F32_H */"),
              generate::self_check_failed);
}

// 2 + 8: nine coefficients and two words a mode less the first tap; states, y, its increment, four waiting inputs.
TEST(ModelOnTarget, BitsCyclesAndBytes) {
    const auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    const ModelSpec spec = two_and_eight();
    const ModelSpec first{drive::make_fopdt(2.0, 0.25, 0.0), 0.001};
    const auto all = generate::check_on_target(
        {generate::written(spec, "own", generate::make_model_header(spec, "own", "none", {})),
         generate::written(first, "first", generate::make_model_header(first, "first", "none", {}))},
        *board, bench::timing_request(TEST_CORES, {"stm32f746-itcm"}));
    ASSERT_EQ(all.size(), 2U);
    EXPECT_TRUE(all[0].bits.good());
    EXPECT_TRUE(all[1].bits.good());
    EXPECT_EQ(all[0].cost.table_bytes, 4U * 2 * 8);
    EXPECT_EQ(all[0].cost.state_bytes, 4U * (8 + 2 + 4 + 1));
    EXPECT_EQ(all[1].cost.table_bytes, 0U);
    EXPECT_EQ(all[1].cost.state_bytes, 4U * (2 + 1 + 1));
    EXPECT_GT(all[0].cost.cycles, 3.0 * all[1].cost.cycles);
}

TEST(ModelReport, SaysErrorsAndCost) {
    generate::ModelChoice choice{two_and_eight(), {5.671e-4, 7.05e-4}, 5.29e-4, 0.0132};
    std::string text;
    for (const std::string& line : generate::to_lines(choice)) {
        text += line + "\n";
    }
    EXPECT_EQ(text,
              "modesdelta_plain_f32 with 2+8: as parts of the largest output,\n"
              "0.000568 from the exact response to a unit step over 60 s (the sampling alone: 0.000529);\n"
              "0.000705 from the same scheme in double with full memory, for an input that jumps at random.\n"
              "What its modes leave of the past is fed back with a loop gain of at most 0.0132: stable as the exact "
              "scheme is.\n");
    generate::ModelReport report{"m.json", "m.h", choice, 1e-3};
    report.checked = {{"there", 5000, 0}};
    report.core = "some-core";
    report.cost = {87.0, 80.0, 94.0, 99.0, 464, 64, 4048};
    const auto json = nlohmann::json::parse(generate::to_json(report));
    EXPECT_EQ(json["schema"], "glsum-model-1");
    EXPECT_EQ(json["kernel"], "modesdelta_plain_f32");
    EXPECT_EQ(json["taps"], "2+8");
    EXPECT_EQ(json["step_error"], 5.671e-4);
    EXPECT_EQ(json["random_error"], 7.05e-4);
    EXPECT_EQ(json["sampling_error"], 5.29e-4);
    EXPECT_EQ(json["loop_gain"], 0.0132);
    EXPECT_EQ(json["checked"][0]["good"], true);
    EXPECT_EQ(json["cost"]["model_cycles_high"], 94.0);
    EXPECT_EQ(json["cost"]["state_bytes"], 4048);
    EXPECT_EQ(json["core"], "some-core");
    choice.spec.memory = {3};
    EXPECT_EQ(generate::to_lines(choice).size(), 3U);
}

}  // namespace
