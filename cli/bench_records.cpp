// glsum bench records: sums over whole records with full memory.
#include <fmt/format.h>

#include <memory>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/studies/records.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/rising.hpp"

namespace cli {
namespace {

struct Options {
    std::vector<std::string> records{"100000", "1000000"};  ///< numbers of samples, in any order
    bench::Records wanted;
    std::filesystem::path out = results_folder() / "records.json";
};

void run(Options options) {
    options.wanted.samples = to_rising(options.records, {"--records", "samples", 1000, 10'000'000});
    base::check_writable(options.out);
    const bench::Study study = bench::measure_records(options.wanted);
    fmt::print("{}", study.text);
    bench::write_results(options.out, study.context, study.rows);
    fmt::print("\n{} rows in {}\n", study.rows.size(), options.out.string());
    if (study.wrong > 0) {
        throw glsum::Failure(glsum::Exit::check_failed, fmt::format("{} rows are wrong; they are marked", study.wrong));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "bench --records N,N is the same command.\n"
        "Example: glsum bench records 100000,1000000 --orders 0.5 --out my.json");
    command.add_option("samples,--records", options->records, "Lengths of the records, 1000 to 10000000")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--orders", options->wanted.orders, "Orders v in (-2, 2]")
        .within(-2, 2)
        .delimiter(',')
        .capture_default_str();
    command.add_option("--signals", options->wanted.signals, "Records: step, ramp, sine1, sine5, sine50, noise, drive")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--repetitions", options->wanted.repetitions, "Interleaved turns, whose median is taken")
        .between(1, 10000)
        .capture_default_str();
    command.add_option("--out", options->out, "Result file (default: results/records.json)");
    command.callback([options] {
        check_orders(options->wanted.orders);
        check_signals(options->wanted.signals);
        run(*options);
    });
}

}  // namespace cli
