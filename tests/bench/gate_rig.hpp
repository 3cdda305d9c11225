// Rules, a small run of two kernels, and changes to it, for the tests of the gate.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "bench/gate/gate.hpp"

namespace test {

using namespace bench::gate;
using bench::Json;
using bench::Results;

inline const Rules& rules() {
    static const Rules rules = parse_rules(R"(
[[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "error_max"
better = "lower"
relative = 0.001
level = "fail"
reason = "exact"
[[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "effective_taps"
better = "higher"
absolute = 0
level = "warn"
reason = "memory"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = ["instructions_per_sample", "*_bytes"]
better = "lower"
absolute = 0
level = "fail"
reason = "exact"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = "loads_per_sample"
better = "lower"
relative = 0.5
level = "fail"
reason = "far too many"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = "loads_per_sample"
better = "lower"
relative = 0.1
level = "warn"
reason = "many"
[[rule]]
layer = "model_cycles"
rows = "gl/*/m7:*"
counters = "model_cycles_per_sample"
better = "lower"
absolute = 0
level = "fail"
reason = "exact"
[[rule]]
layer = "host_time"
rows = "gl/*/host"
counters = "cpu_time"
better = "lower"
relative = 0.05
anchor = "peer_std_f32"
level = "fail"
reason = "ratio"
)",
                                           "rules");
    return rules;
}

constexpr char accuracy_row[] = "gl/a/order:0.5/taps:50/accuracy/signal:step";
constexpr char count_row[] = "gl/a/order:0.5/taps:50/m7:count";
constexpr char model_row[] = "gl/a/order:0.5/taps:50/m7:stm32f746-itcm";
constexpr char time_row[] = "gl/a/order:0.5/taps:50/host";

inline Results run() {
    Results run;
    run.context = {{"compiler", "GNU 12.2.0"},
                   {"flags", "-O3"},
                   {"contraction", "off"},
                   {"n_samples", 1000},
                   {"seed", 2020},
                   {"target_compiler", "GNU 12.2.1"},
                   {"core_file", "f746"},
                   {"core_file_sha256", "1"},
                   {"cpu", "one"},
                   {"commit", "c0ffee"}};
    for (const std::string kernel : {"a", "b"}) {
        const std::string line = "gl/" + kernel + "/order:0.5/taps:50/";
        Json accuracy = bench::make_row(line + "accuracy/signal:step", 1000);
        accuracy["error_max"] = 1e-5;
        accuracy["effective_taps"] = 50;
        Json count = bench::make_row(line + "m7:count", 32);
        count["instructions_per_sample"] = 315;
        count["loads_per_sample"] = 100;
        count["code_bytes"] = 400;
        Json model = bench::make_row(line + "m7:stm32f746-itcm", 32);
        model["model_cycles_per_sample"] = 500.25;
        for (const Json& row : {accuracy, count, model}) {
            run.rows.push_back(row);
        }
    }
    for (const auto& [kernel, ns] : {std::pair("a", 100.0), std::pair("b", 50.0), std::pair("peer_std_f32", 20.0)}) {
        for (int i = 0; i < 40; ++i) {
            Json time = bench::make_row(std::string("gl/") + kernel + "/order:0.5/taps:50/host", 1000);
            time["repetition_index"] = i;
            time["cpu_time"] = ns * (1.0 + 0.0001 * (i * 17 % 40));
            run.rows.push_back(time);
        }
    }
    return run;
}

inline void change(Results& results, const std::string& name, const std::function<void(Json&)>& how) {
    bool found = false;
    for (Json& row : results.rows) {
        if (row["name"] == name) {
            how(row);
            found = true;
        }
    }
    ASSERT_TRUE(found) << name;
}

inline void scale(Results& results, const std::string& name, const std::string& counter, double factor) {
    change(results, name, [&](Json& row) { row[counter] = row[counter].get<double>() * factor; });
}

inline void drop(Results& results, const std::function<bool(const std::string&)>& which) {
    std::erase_if(results.rows, [&](const Json& row) { return which(row["name"].get<std::string>()); });
}

inline const Finding* find(const Verdict& verdict, Level level) {
    for (const Finding& finding : verdict.findings) {
        if (finding.level == level) {
            return &finding;
        }
    }
    return nullptr;
}

}  // namespace test
