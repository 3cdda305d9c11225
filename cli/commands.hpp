// The subcommands: each adds itself to the command line and returns what runs it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cli {

/// Words that a command hands on unread: Google Benchmark's own flags.
using PassedOn = std::vector<std::string>;

/// `bench`. \param passed_on  filled before the command runs
void add_bench(CLI::App& app, const PassedOn& passed_on);

/// `merge`: the shards of a sweep into one file.
void add_merge(CLI::App& app);

/// `report`: a page, pictures and tables of result files.
void add_report(CLI::App& app);

/// `choose`: the cheapest kernel within a budget.
void add_choose(CLI::App& app);

/// `generate`: that kernel as a C header. \param command_line  as it was typed, for the record
void add_generate(CLI::App& app, const std::string& command_line);

/// `gate`: a run against a baseline.
void add_gate(CLI::App& app);

/// `compare`: two runs side by side.
void add_compare(CLI::App& app);
void add_diagnose(CLI::App& app);

/// `time`: the modelled cycles of a function of any program.
void add_time(CLI::App& app);

/// `silicon`: what the timing model says of measured rows.
void add_silicon(CLI::App& app);

void add_simulate(CLI::App& app);
void add_identify(CLI::App& app);
void add_stability(CLI::App& app);
void add_indices(CLI::App& app);
void add_paper(CLI::App& app);
void add_resample(CLI::App& app);
void add_stand(CLI::App& app);

}  // namespace cli
