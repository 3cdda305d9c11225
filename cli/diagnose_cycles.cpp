#include "cli/diagnose_cycles.hpp"

#include <fmt/format.h>

#include <memory>

#include "base/failure.hpp"
#include "base/sha256.hpp"
#include "cli/board.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "gap/cycles/blind.hpp"
#include "gap/cycles/diagnose.hpp"
#include "gap/cycles/tally.hpp"
#include "gap/cycles/verdict.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path measured;
    std::string core = "m7-ideal";
    Output json;
    std::size_t blind = 0;
    std::uint64_t seed = 1;
    std::filesystem::path out;
};

// The truth is written, and its hash told, before the first diagnosis; each diagnosis reads its rows from their file.
void run_blind(const Options& options) {
    const qemu::SiliconProgram program = built_silicon();
    const std::string core = options.core == "m7-ideal" ? default_core : options.core;
    const std::vector<qemu::MeasuredCycles> rows = gap::cycles::blind_rows();
    const auto predict = [&](const auto& variants) { return qemu::predict(program, "blind", rows, variants); };
    const auto secrets =
        gap::cycles::draw_secrets(options.blind, options.seed, gap::cycles::switches_that_show(core, predict));
    std::filesystem::create_directories(options.out);
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        std::vector<qemu::MeasuredCycles> measured = rows;
        gap::cycles::measure(measured, predict(std::vector<qemu::CoreVariant>{{core, "", secrets[c].without}}).front(),
                             secrets[c], options.seed + 1 + c);
        put(qemu::to_csv(measured), options.out / (gap::cycles::name_of_case(c + 1) + ".csv"));
    }
    const std::filesystem::path truth = options.out / "truth.json";
    put(gap::cycles::seal(secrets), truth);
    fmt::print("{} cases of {}, sealed: sha256 {}\n\n  {:<10} {:<10} {:<44} {}\n", secrets.size(), core,
               base::sha256_of(truth), "case", "kind", "was done", "was found");
    gap::cycles::Tally tally;
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        const gap::cycles::Secret& secret = secrets[c];
        const std::string name = gap::cycles::name_of_case(c + 1);
        const std::filesystem::path file = options.out / (name + ".csv");
        const gap::cycles::Question question =
            gap::cycles::question_about(read_measured_cycles(file), core, program.cores_folder);
        const gap::cycles::Explanation found = gap::cycles::explain(
            question, [&](const auto& variants) { return qemu::predict(program, file, question.rows, variants); });
        put(gap::to_json(gap::cycles::verdict_of(found, core)), options.out / (name + ".json"));
        std::vector<std::string> named;
        for (const gap::cycles::Step& step : found.steps) {
            named.push_back(step.effect);
        }
        const bool good = gap::cycles::names(found, secret);
        tally.count(secret.kind, good);
        fmt::print("  {:<10} {:<10} {:<44} {}: {}{}\n", name, secret.kind,
                   fmt::format("{}", fmt::join(secret.effects, " ")), name_of(found.outcome), fmt::join(named, " "),
                   good ? "" : "   WRONG");
    }
    fmt::print("\n{}", tally.to_text());
}

void run(const Options& options) {
    if (options.blind > 0) {
        run_blind(options);
        return;
    }
    const std::vector<qemu::MeasuredCycles> rows = read_measured_cycles(options.measured);
    const qemu::SiliconProgram program = built_silicon();
    const gap::cycles::Explanation found =
        gap::cycles::diagnose(gap::cycles::question_about(rows, options.core, program.cores_folder),
                              [&](const auto& asked, const auto& variants) {
                                  return qemu::predict(program, options.measured, asked, variants);
                              });
    const gap::Verdict verdict = gap::cycles::verdict_of(found, options.core);
    fmt::print("{}: {} rows\n{}", options.measured.filename().string(), rows.size(), gap::to_text(verdict));
    if (options.json.wanted()) {
        options.json.write(gap::to_json(verdict));
    }
}

}  // namespace

void add_diagnose_cycles(Command& diagnose) {
    auto options = std::make_shared<Options>();
    Command command = diagnose.add_subcommand("cycles", "Predicted cycles against measured ones");
    command.footer(
        "Example: glsum diagnose cycles --measured results/silicon/h747_per_sample_fir.csv --json verdict.json");
    command.add_option("--measured", options->measured,
                       "CSV: kernel,code,data,maintenance,taps,cycles, and instructions if they were counted");
    command.add_option("--core", options->core, "The prediction that is judged: a core file, by name or path")
        .capture_default_str();
    options->json.add_to(command, "--json", "The verdict, schema glsum-gap-1");
    Option blind = command.add_option(
        "--blind", options->blind,
        "Instead: so many measurements of cores with secret switches and costs, sealed and diagnosed from their files");
    blind.between(1, 10000);
    command.add_option("--seed", options->seed, "Of --blind").at_least(0).capture_default_str();
    command.add_option("--out", options->out, "The folder of --blind");
    command.callback([options] {
        if (options->blind == 0 && options->measured.empty()) {
            throw Failure(Exit::bad_input, "expected --measured FILE or --blind N --out FOLDER");
        }
        if (options->blind > 0 && (options->out.empty() || !options->measured.empty() || options->json.wanted())) {
            throw Failure(Exit::bad_input, "--blind: expected --out FOLDER, and neither --measured nor --json");
        }
        run(*options);
    });
}

}  // namespace cli
