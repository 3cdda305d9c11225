#include "bench/choose/side_by_side.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/choose/report.hpp"
#include "bench/target/target_rows.hpp"

namespace choose {

std::vector<OnMachine> side_by_side(const std::vector<Answer>& answers, const std::vector<qemu::Board>& boards) {
    std::vector<Case> cases;
    for (const Answer& answer : answers) {
        if (const auto& chosen = answer.choice.chosen) {
            const Case of{chosen->kernel, chosen->taps};
            if (std::find(cases.begin(), cases.end(), of) == cases.end()) {
                cases.push_back(of);
            }
        }
    }
    std::vector<OnMachine> rows;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const Question& question = answers[i].question;
        const auto& [order, step_s, signals, samples, seed] = question.conditions;
        OnTarget costs(boards[i], question.counted_order(), samples, seed, question.jobs, question.core);
        const std::vector<Cost> found = costs.costs(cases);
        const double clock_hz = bench::clocks_of(bench::timing_request(boards[i].cores, {question.core})).front();
        for (std::size_t c = 0; c < cases.size(); ++c) {
            const auto& [kernel, taps] = cases[c];
            const auto& chosen = answers[i].choice.chosen;
            rows.push_back({boards[i].machine, question.core, clock_hz, kernel, taps,
                            question.counted_order().length(kernel, taps, samples).text(), found[c],
                            chosen && chosen->kernel == kernel && chosen->taps == taps});
        }
    }
    return rows;
}

std::string to_table(const std::vector<OnMachine>& rows, const std::vector<Answer>& answers) {
    const double step_s = answers.front().question.conditions.step_s;
    std::string text = fmt::format("\n  {:<10} {:<20} {:<25} {:>8} {:>10} {:>10} {:>10} {:>8} {:>8}\n", "core",
                                   "core file", "kernel", "taps", "cycles", "at most", "us", "bytes", "of time");
    for (const OnMachine& row : rows) {
        text +=
            fmt::format("  {:<10} {:<20} {:<25} {:>8} {:>10.1f} {:>10.1f} {:>10.2f} {:>8.0f} {:>7.2f}%{}\n",
                        row.machine->name, row.core, row.kernel, row.length, row.cost.value, row.cost.limited,
                        row.microseconds(), row.cost.bytes, 100.0 * row.share(step_s), row.chosen ? "  chosen" : "");
    }
    for (const Answer& answer : answers) {
        if (!answer.choice.chosen) {
            text += fmt::format("  {}: {}\n", machine_of(answer.question.target)->name, nearest_miss(answer));
        }
    }
    return text +
           fmt::format(
               "\n  us: a sample at the clock of the core file; of time: the upper end of the band, as a share of "
               "the {:g} s\n  from sample to sample. What was chosen for one core is shown on the other, too.\n",
               step_s);
}

bench::Json to_json(const std::vector<OnMachine>& rows, const std::vector<Answer>& answers) {
    bench::Json json{{"schema", "glsum-choices-1"}};
    const double step_s = answers.front().question.conditions.step_s;
    for (const Answer& answer : answers) {
        json["choices"].push_back(to_json(answer));
    }
    json["side_by_side"] = bench::Json::array();
    for (const OnMachine& row : rows) {
        json["side_by_side"].push_back({{"target", row.machine->word},
                                        {"core", row.core},
                                        {"clock_hz", row.clock_hz},
                                        {"kernel", row.kernel},
                                        {"taps", row.length},
                                        {"model_cycles_per_sample", row.cost.value},
                                        {"model_cycles_high", row.cost.limited},
                                        {"microseconds", row.microseconds()},
                                        {"bytes", row.cost.bytes},
                                        {"share", row.share(step_s)},
                                        {"chosen", row.chosen}});
    }
    return json;
}

}  // namespace choose
