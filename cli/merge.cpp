// glsum merge: the shards of a sweep into one result file.
#include "bench/rows/merge.hpp"

#include <memory>

#include "base/build_info.hpp"
#include "base/files.hpp"
#include "cli/command.hpp"
#include "cli/finish_run.hpp"

namespace cli {
namespace {

struct Options {
    std::vector<std::filesystem::path> shards;
    bool allow_mixed_hosts = false;
    unsigned jobs = 1;
    std::filesystem::path out = std::filesystem::path(build_info::source_folder) / "results" / "latest.json";
    std::string table;
};

void run(const Options& options) {
    base::check_writable(options.out);
    std::vector<bench::NamedResults> shards;
    for (const auto& path : options.shards) {
        shards.push_back({path.string(), bench::read_results(path)});
    }
    finish_run(options.out, bench::merge(std::move(shards), options.allow_mixed_hosts), options.jobs, options.table);
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "All shards of bench --shard I/N, each once, in any order.\n"
        "Example: glsum merge shard-1.json shard-2.json shard-3.json --out whole.json");
    command.add_option("shards", options->shards, "Result files of bench --shard").required();
    command.add_flag("--allow-mixed-hosts", options->allow_mixed_hosts,
                     "Shards may come from different CPUs; the context then says mixed_hosts");
    command.add_option("--jobs", options->jobs, "Threads at once, for the bound that the picture draws")
        .between(1, 1024);
    command.add_option("--out", options->out, "Result file; .csv, .svg and .png are written beside it");
    add_table_option(command, options->table);
    command.callback([options] { run(*options); });
}

}  // namespace cli
