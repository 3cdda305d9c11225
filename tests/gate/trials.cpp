// gate_trials: what the gate does in many made trials on real recordings. On demand; see tests/README.md.
//   gate_trials bootstrap LONG.json THRESHOLDS.toml  a recording of some thousand repetitions: runs of 200 are drawn
//   from it
//     in blocks of consecutive repetitions, 200 pairs, as they are and with one kernel a tenth slower
//   gate_trials plant RUN.json THRESHOLDS.toml       every value that a rule of the exact layers judges, one after the
//   other:
//     one instruction, byte or cycle more, or 1 % less accurate
#include <fmt/format.h>

#include <cstring>
#include <map>
#include <random>

#include "base/failure.hpp"
#include "bench/gate/gate.hpp"
#include "bench/gate/row_table.hpp"

namespace {

using namespace bench::gate;
using bench::Json;
using bench::Results;

constexpr std::size_t repetitions = 200;
constexpr std::size_t block = 10;
constexpr int trials = 200;

// A run drawn from a long one: of all rows the same repetitions, block by block, so that what came together stays
// together.
Results draw(const Results& recording, const RowTable& table, std::mt19937_64& generator, const std::string& slower) {
    Results run;
    run.context = recording.context;
    std::size_t length = repetitions;
    for (const std::string& name : table.names()) {
        if (kind_of(name) == Kind::host) {
            length = table.find(name)->repetitions.size();
        }
    }
    std::vector<std::size_t> drawn;
    while (drawn.size() < repetitions) {
        const std::size_t begin = generator() % (length - block + 1);
        for (std::size_t i = 0; i < block; ++i) {
            drawn.push_back(begin + i);
        }
    }
    for (const std::string& name : table.names()) {
        if (kind_of(name) != Kind::host) {
            continue;
        }
        for (std::size_t i = 0; i < repetitions; ++i) {
            Json row = *table.find(name)->repetitions[drawn[i]];
            row["repetition_index"] = i;
            if (name == slower) {
                row["cpu_time"] = 1.1 * row["cpu_time"].get<double>();
            }
            run.rows.push_back(std::move(row));
        }
    }
    return run;
}

int bootstrap(const Results& recording, const Rules& rules) {
    const RowTable table(recording);
    std::vector<std::string> kernels;
    for (const std::string& name : table.names()) {
        if (kind_of(name) == Kind::host && name.find("/peer_") == std::string::npos) {
            kernels.push_back(name);
        }
    }
    std::mt19937_64 generator(1);
    int alarms = 0;
    int caught = 0;
    for (int i = 0; i < trials; ++i) {
        const Results baseline = draw(recording, table, generator, "");
        alarms += judge(baseline, draw(recording, table, generator, ""), rules).status == glsum::Exit::good ? 0 : 1;
        const std::string& slower = kernels[static_cast<std::size_t>(i) % kernels.size()];
        const Verdict verdict = judge(baseline, draw(recording, table, generator, slower), rules);
        for (const Finding& finding : verdict.findings) {
            caught += finding.level == Level::fail && finding.row == slower ? 1 : 0;
        }
    }
    fmt::print("{} of {} gates of unchanged code raise an alarm; {} of {} find the kernel that is a tenth slower\n",
               alarms, trials, caught, trials);
    return alarms <= trials / 100 && caught >= trials * 95 / 100 ? 0 : 1;
}

int plant(Results run, const Rules& rules) {
    const RowTable table(run);
    // The rows of one kernel, order and length at a time: a file of thousands need not be judged thousands of times.
    std::map<std::string, Results> parts;
    for (const std::string& name : table.names()) {
        Results& part = parts[subject_of(name)];
        part.context = run.context;
        part.rows.push_back(table.find(name)->first());
    }
    std::size_t planted = 0;
    std::size_t missed = 0;
    for (const auto& [subject, baseline] : parts) {
        for (std::size_t r = 0; r < baseline.rows.size(); ++r) {
            const auto name = baseline.rows[r]["name"].get<std::string>();
            for (const auto& [counter, value] : baseline.rows[r].items()) {
                const bool judged = std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) {
                    return rule.layer != Layer::host_time && rule.fails && rule.wants_counter(counter) &&
                           rule.wants_row(name);
                });
                if (!judged || !is_counter(counter, value)) {
                    continue;
                }
                const double worse = better_of(rules, name, counter) == Better::higher ? -1.0 : 1.0;
                const double then = value.get<double>();
                Results current = baseline;
                current.rows[r][counter] =
                    counter.find("error") != std::string::npos && then > 0.0 ? 1.01 * then : then + worse;
                const Verdict verdict = judge(baseline, current, rules);
                ++planted;
                if (verdict.with(Level::fail) != 1 || verdict.findings.front().row != name ||
                    verdict.findings.front().counter != counter) {
                    ++missed;
                    fmt::print("missed: {} {}\n", name, counter);
                }
            }
        }
    }
    fmt::print("{} regressions planted one at a time, {} missed\n", planted, missed);
    return planted > 0 && missed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 4 || (std::strcmp(argv[1], "bootstrap") != 0 && std::strcmp(argv[1], "plant") != 0)) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 "expected bootstrap or plant, a result file, a thresholds file");
        }
        const Results results = bench::read_results(argv[2]);
        const Rules rules = read_rules(argv[3]);
        return std::strcmp(argv[1], "plant") == 0 ? plant(results, rules) : bootstrap(results, rules);
    } catch (const glsum::Failure& failure) {
        fmt::print(stderr, "gate_trials: {}\n", failure.what());
        return static_cast<int>(failure.status());
    }
}
