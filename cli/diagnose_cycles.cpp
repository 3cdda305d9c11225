#include "cli/diagnose_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/sha256.hpp"
#include "cli/board.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "gap/cycles/blind.hpp"
#include "gap/cycles/diagnose.hpp"
#include "gap/cycles/programs.hpp"
#include "gap/cycles/tally.hpp"
#include "gap/cycles/verdict.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path measured;
    std::string core;  ///< empty: as `of_kernels`, or as the rows name it
    Output json;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    unsigned timeout = 120;
    std::size_t blind = 0;
    bool other_rules = false;
    std::uint64_t seed = 1;
    std::filesystem::path out;
};

// What is judged where no core is asked for, of rows of our kernels.
constexpr const char* of_kernels = "m7-ideal";

// The truth is written, and its hash told, before the first diagnosis; each diagnosis reads its rows from their file.
void run_blind(const Options& options) {
    const qemu::SiliconProgram program = built_silicon();
    const std::string core = options.core.empty() || options.core == of_kernels ? default_core : options.core;
    const std::vector<qemu::MeasuredCycles> rows = gap::cycles::blind_rows(options.other_rules);
    const auto predict = [&](const auto& variants) { return qemu::predict(program, "blind", rows, variants); };
    const auto secrets =
        options.other_rules
            ? gap::cycles::draw_other_rules(options.blind, options.seed,
                                            gap::cycles::other_rules_of(core, program.cores_folder))
            : gap::cycles::draw_secrets(options.blind, options.seed, gap::cycles::switches_that_show(core, predict));
    std::filesystem::create_directories(options.out);
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        std::vector<qemu::MeasuredCycles> measured = rows;
        const gap::cycles::Secret& secret = secrets[c];
        qemu::CoreVariant real{core, secret.set, secret.without};
        if (!secret.mechanism.empty()) {
            const std::filesystem::path file = options.out / (secret.mechanism + ".toml");
            put(gap::cycles::core_with(core, secret.mechanism), file);
            real.core = file.string();
        }
        gap::cycles::measure(measured, predict(std::vector{real}).front(), secret, options.seed + 1 + c);
        put(qemu::to_csv(measured), options.out / (gap::cycles::name_of_case(c + 1) + ".csv"));
    }
    const std::filesystem::path truth = options.out / "truth.json";
    put(gap::cycles::seal(secrets), truth);
    fmt::print("{} cases of {}, sealed: sha256 {}\n\n  {:<10} {:<14} {:<44} {}\n", secrets.size(), core,
               base::sha256_of(truth), "case", "kind", "was done", "was found");
    gap::cycles::Tally tally;
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        const gap::cycles::Secret& secret = secrets[c];
        const std::string name = gap::cycles::name_of_case(c + 1);
        const std::filesystem::path file = options.out / (name + ".csv");
        const gap::cycles::Question question =
            gap::cycles::question_about(read_measured_cycles(file), {core}, program.cores_folder);
        const gap::cycles::Explanation found = gap::cycles::explain(
            question, [&](const auto& variants) { return qemu::predict(program, file, question.rows, variants); });
        put(gap::to_json(gap::cycles::verdict_of(found, core)), options.out / (name + ".json"));
        std::vector<std::string> named;
        for (const gap::cycles::Step& step : found.steps) {
            named.push_back(step.effect);
        }
        const bool good = gap::cycles::names(found, secret);
        // Of cycles that other rules made, `unknown` says no more than is known.
        const bool held_back = !good && !secret.other_rules().empty() && found.outcome == gap::Outcome::unknown;
        tally.count(secret.kind, good);
        if (!secret.other_rules().empty()) {
            tally.count("no false name", good || held_back);
        }
        fmt::print("  {:<10} {:<14} {:<44} {}: {}{}\n", name, secret.kind,
                   fmt::format("{}", fmt::join(secret.effects, " ")) +
                       (secret.other_rules().empty() ? "" : " by " + secret.other_rules()),
                   name_of(found.outcome), fmt::join(named, " "),
                   good        ? ""
                   : held_back ? "   held back"
                               : "   WRONG");
    }
    fmt::print("\n{}", tally.to_text());
}

struct Judged {
    gap::cycles::Question question;
    gap::cycles::Explanation found;
};

gap::cycles::PredictRows predict_kernels(const Options& options, const qemu::SiliconProgram& program) {
    return [&options, &program](const auto& asked, const auto& variants) {
        return qemu::predict(program, options.measured, asked, variants);
    };
}

Judged of_our_kernels(const Options& options, const std::string& text) {
    const std::string core = options.core.empty() ? of_kernels : options.core;
    std::vector<qemu::MeasuredCycles> rows = qemu::parse_measured_cycles(text, options.measured.string());
    const qemu::SiliconProgram program = built_silicon();
    Judged judged{gap::cycles::question_about(std::move(rows), {core}, program.cores_folder), {}};
    judged.found = gap::cycles::diagnose(judged.question, predict_kernels(options, program));
    return judged;
}

Judged of_programs(const Options& options, const std::string& text) {
    const std::string name = options.measured.string();
    const qemu::CallsProgram program = calls_program(options.timeout);
    const auto calls = qemu::parse_measured_calls(text, name, options.measured.parent_path());
    const gap::cycles::Programs programs(calls, options.core, program.cores_folder, [&](const auto& variants) {
        return qemu::predict_calls(program, calls, name, variants, options.jobs);
    });
    Judged judged{programs.question(), {}};
    judged.found = gap::cycles::diagnose(judged.question, [&](const auto& asked, const auto& variants) {
        // Loops of ours that part rival rules are asked about, too.
        return asked.front().program.empty() ? predict_kernels(options, built_silicon())(asked, variants)
                                             : programs.predict(variants);
    });
    return judged;
}

void run(const Options& options) {
    if (options.blind > 0) {
        run_blind(options);
        return;
    }
    const std::string text = base::read_file(options.measured, qemu::MeasuredLimits::bytes);
    const Judged judged = qemu::names_programs(text) ? of_programs(options, text) : of_our_kernels(options, text);
    const gap::Verdict verdict = gap::cycles::verdict_of(judged.found, judged.question.base);
    fmt::print("{}: {} rows\n{}", options.measured.filename().string(), judged.question.rows.size(),
               gap::to_text(verdict));
    if (options.json.wanted()) {
        options.json.write(gap::to_json(verdict));
    }
}

}  // namespace

void add_diagnose_cycles(Command& diagnose) {
    auto options = std::make_shared<Options>();
    Command command = diagnose.add_subcommand("cycles", "Predicted cycles against measured ones");
    command.footer(
        "Of any program's functions the CSV has the columns of `glsum silicon --rows`, and the cores that its rows "
        "name "
        "are\njudged unless --core is given.\n"
        "Example: glsum diagnose cycles --measured results/silicon/h747_per_sample_fir.csv --json verdict.json");
    command.add_option("--measured", options->measured,
                       "CSV: kernel,code,data,maintenance,taps,cycles, and instructions if they were counted; or "
                       "elf,function,core,code,data,measured,per");
    command.add_option(
        "--core", options->core,
        "The prediction that is judged: a core file, by name or path; m7-ideal, or what rows of programs name");
    options->json.add_to(command, "--json", "The verdict, schema glsum-gap-1");
    Option blind = command.add_option(
        "--blind", options->blind,
        "Instead: so many measurements of cores with secret switches and costs, sealed and diagnosed from their files");
    blind.between(1, 10000);
    command
        .add_flag("--other-rules", options->other_rules,
                  "Of --blind: cycles that other rules made than those that judge")
        .needs(blind);
    command.add_option("--jobs", options->jobs, "Emulators at once, of programs").between(1, 1024);
    command.add_option("--timeout", options->timeout, "Seconds that a program may stay silent")
        .at_least(1)
        .capture_default_str();
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
