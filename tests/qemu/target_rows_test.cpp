// Rows of the emulated target, from a board that is pretended: it answers with hashes that are looked up by the rows of
// its plan, and with logs made by hand.
#include "bench/target/target_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <map>

#include "bench/sweep/signals.hpp"
#include "bench/target/target_plan.hpp"
#include "base/scratch.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using test::calls;
using test::ring;

// Two orders of a window of three taps share their counts.
class TargetRows : public testing::Test {
protected:
    void SetUp() override {
        sweep_.kernels = {"ring_plain_f32"};
        sweep_.orders = {0.5, 1.2};
        sweep_.lengths = {{3}};
        sweep_.signals = {"noise", "step"};
        sweep_.cores = {"m7-ideal", "count", "stm32h747-dtcm"};
        sweep_.samples = 60;
        sweep_.seed = 7;
        sweep_.jobs = 2;
        test::program().write(folder_.file("measure.elf"));
        std::ofstream(folder_.file("log"))
            << test::check_calls() << calls(ring, 1, "100 10 5 7") << calls(ring, 3, "500 90 90 90")
            << calls(ring, 16, "50 20 10 4") << calls(ring, 16, "70 24 10 6") << calls(ring, 1, "999 999 999 999")
            << "reached 1024 1024 1030 1280 64\nreached 1088 1088\nend\n";
        write_times("");
        std::ofstream(folder_.file("emulate"))
            << "#!/bin/sh\nof() { echo \"$GLSUM_QEMU_PLUGIN\" | tr , '\\n' | sed -n \"s/^$1=//p\"; }\ncd '"
            << folder_.file("").string()
            << "'\nfor last; do :; done\nmore=\nif [ -n \"$(of out)\" ]; then cp log \"$(of out)\"; more=' 12 34 56'; "
               "fi\nif [ -n \"$(of timing)\" ]; then cp times \"$(of times)\"; fi\nn=0\ntail -n +2 \"$last\" | while "
               "read -r row; do\nhash=$(sed -n \"s/^$row = //p\" answers)\ncase $hash in\n'') echo \"no $row\" >&2; "
               "exit "
               "1 ;;\n!*) echo \"row $n ${hash#!}\" ;;\n*) echo \"row $n 0 $hash$more\" ;;\nesac\nn=$((n + 1))\ndone\n"
               "echo \"end $(($(wc -l <\"$last\") - 1))\"\n";
        std::filesystem::permissions(folder_.file("emulate"), std::filesystem::perms::owner_all);
        signals_ = {bench::make_signal("noise", 60, 7), bench::make_signal("step", 60, 7),
                    bench::make_signal("noise", 60, 8)};
        // Counted at the first order, on the signal behind the sweep's last: the row's calls and the one behind.
        count_ = {"ring_plain_f32", 0.5, 3, 2, 1 + 3 + 32};
        answer(count_, host_hash(count_, 1));
        // Replayed on one signal each, the next from row to row, until every signal was met.
        for (const auto& [order, signal] : {std::pair(0.5, 0U), std::pair(1.2, 1U)}) {
            const qemu::PlannedRow replay{"ring_plain_f32", order, 3, signal, 60};
            answer(replay, host_hash(replay, 0));
        }
    }
    void write_times(const std::string& unknown) const {
        std::string losses;
        for (std::size_t e = 0; e < timing::effect_count; ++e) {
            losses += fmt::format(" {}", 2 * e);
        }
        // Of a turn that is no longer than 64 each call is timed, and two before it: of 37 steps in 54 half cycles
        // each.
        const auto core = [&](int half_cycles, int low, int high) {
            return fmt::format(" core 3 {} {} {}{} 7", half_cycles, low, high, losses);
        };
        std::ofstream(folder_.file("times")) << "calls 1 1024 100" << core(240, 200, 300) << core(480, 400, 600)
                                             << "\ncalls 34 1024 60" << core(54, 46, 62) << core(108, 92, 124) << '\n'
                                             << unknown << "end\n";
    }
    [[nodiscard]] std::string host_hash(qemu::PlannedRow row, std::size_t more) const {
        row.calls += more;
        return fmt::format("{:x}", qemu::replay_here(row, signals_).hash);
    }
    void answer(const qemu::PlannedRow& row, const std::string& said) {
        answers_[fmt::format("{} {:016x} {} {} {} 0 1 0", row.kernel, std::bit_cast<std::uint64_t>(row.order), row.taps,
                             row.signal, row.calls)] = said;
    }
    std::vector<bench::Json> rows() {
        std::ofstream file(folder_.file("answers"));
        for (const auto& [row, said] : answers_) {
            file << row << " = " << said << '\n';
        }
        file.close();
        const qemu::Board board{folder_.file("measure.elf"),
                                folder_.file("measure.elf"),
                                "x.so",
                                {folder_.file("emulate"), std::chrono::seconds(20)},
                                TEST_CORES};
        const auto pieces = bench::measure_on_target(sweep_, board, {0});
        EXPECT_EQ(pieces.size(), 1U);
        return pieces.at(0);
    }

    base::Scratch folder_;
    bench::Sweep sweep_;
    qemu::Signals signals_;
    qemu::PlannedRow count_;
    std::map<std::string, std::string> answers_;
};

TEST_F(TargetRows, SayWhatWasCountedAndModelled) {
    const auto all = rows();
    ASSERT_EQ(all.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        const bench::Json& row = all[i];
        const bool modelled = i % 3 != 1;
        const double times = i % 3 == 2 ? 2.0 : 1.0;
        EXPECT_EQ(row.at("name"),
                  fmt::format("gl/ring_plain_f32/order:{}/taps:3/m7:{}", i < 3 ? "0.5" : "1.2", sweep_.cores[i % 3]));
        EXPECT_EQ(row.at("label"),
                  modelled ? "modelled cycles; counted at order 0.5" : "instructions only; counted at order 0.5");
        EXPECT_EQ(row.at("iterations"), 32);  // steady calls
        EXPECT_FALSE(row.contains("error_occurred")) << row;
        EXPECT_EQ(row.at("instructions_per_sample"), 60.0);
        EXPECT_EQ(row.at("counted_at_order"), 0.5);
        EXPECT_EQ(row.at("loads_per_sample"), 22.0);
        EXPECT_EQ(row.at("stores_per_sample"), 10.0);
        EXPECT_EQ(row.at("branches_per_sample"), 5.0);
        EXPECT_EQ(row.at("first_instructions"), 100);
        EXPECT_EQ(row.at("worst_instructions"), 70);
        EXPECT_EQ(row.at("code_bytes"), 0x20 + 0x10);
        EXPECT_EQ(row.at("stack_bytes"), 12);
        EXPECT_EQ(row.at("state_bytes"), 34);
        EXPECT_EQ(row.at("coefficient_bytes"), 56);
        if (modelled) {
            EXPECT_EQ(row.at("model_cycles_per_sample"), times * 27.0);
            EXPECT_EQ(row.at("model_cycles_low"), times * 23.0);
            EXPECT_EQ(row.at("model_cycles_high"), times * 31.0);
            EXPECT_EQ(row.at("first_model_cycles"), times * 120.0);
            EXPECT_EQ(row.at("worst_model_cycles"), times * 27.0);
            // In ns, at 216 MHz and at 400 MHz.
            EXPECT_NEAR(row.at("cpu_time").get<double>(), times > 1.0 ? 54.0 / 0.4 : 27.0 / 0.216, 1e-9);
            EXPECT_EQ(row.at("real_time"), row.at("cpu_time"));
            EXPECT_EQ(row.at("latency_model_cycles"), times * 27.0);
            for (std::size_t e = 0; e < timing::effect_count; ++e) {
                EXPECT_EQ(row.at(fmt::format("stall_{}", timing::effect_names[e])), static_cast<double>(e));
            }
            EXPECT_EQ(row.at("stall_double_precision_in_software"), 3.5);
        } else {
            EXPECT_EQ(row.at("cpu_time"), 0.0);
            EXPECT_FALSE(row.contains("model_cycles_per_sample"));
        }
    }
}

TEST_F(TargetRows, WhoseOutputsDifferAreMarked) {
    const auto wrong = [](const bench::Json& row) {
        return row.contains("error_message") ? row.at("error_message").get<std::string>() : std::string();
    };
    const std::string differ = "the target's outputs differ from the host's";
    answer({"ring_plain_f32", 1.2, 3, 1, 60}, "abc");
    auto all = rows();
    EXPECT_EQ(wrong(all[0]), "");
    EXPECT_EQ(wrong(all[1]), "");
    EXPECT_EQ(wrong(all[2]), "");
    EXPECT_EQ(wrong(all[3]), differ);
    EXPECT_EQ(wrong(all[5]), differ);
    // A count stands for both orders.
    answer({"ring_plain_f32", 1.2, 3, 1, 60}, host_hash({"ring_plain_f32", 1.2, 3, 1, 60}, 0));
    answer(count_, "abc");
    all = rows();
    for (const bench::Json& row : all) {
        EXPECT_EQ(wrong(row), differ);
    }
    // So does a refusal; with a hash that the host has, too.
    answer(count_, host_hash(count_, 1));
    answer({"ring_plain_f32", 0.5, 3, 0, 60}, "!3");
    all = rows();
    EXPECT_EQ(wrong(all[0]), differ);
    EXPECT_EQ(wrong(all[3]), "");
}

TEST_F(TargetRows, SayWhatTheModelDoesNotKnow) {
    write_times("unknown 600 9\nunknown 43690 1\n");
    const auto all = rows();
    EXPECT_FALSE(all[1].contains("error_occurred"));
    EXPECT_EQ(all[0].at("error_message"), "the timing model does not know 2 encodings, the first at 0x00000258");
}

}  // namespace
