#include "cli/diagnose_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "base/sha256.hpp"
#include "cli/board.hpp"
#include "cli/drive_files.hpp"
#include "gap/cycles/blind.hpp"
#include "gap/cycles/explain.hpp"
#include "gap/cycles/verdict.hpp"
#include "qemu/emulate/firmware.hpp"
#include "qemu/emulate/silicon.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path measured;
    std::string core = "m7-ideal";
    std::filesystem::path json;
    std::size_t blind = 0;
    std::uint64_t seed = 1;
    std::filesystem::path out;
};

std::vector<std::string> names_of(const timing::Effects& effects) {
    std::vector<std::string> names;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        if (effects[e]) {
            names.emplace_back(timing::effect_names[e]);
        }
    }
    return names;
}

// Counts that differ need no core: another program was measured.
std::optional<std::string> other_program(const std::vector<qemu::MeasuredCycles>& rows,
                                         const std::vector<qemu::PredictedCycles>& predicted) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto ours = static_cast<double>(predicted[i].instructions);
        if (rows[i].instructions && std::fabs(*rows[i].instructions - ours) > 0.5) {
            return fmt::format("{} at {} taps: {} instructions a call were measured, this build has {}", rows[i].kernel,
                               rows[i].taps, *rows[i].instructions, ours);
        }
    }
    return std::nullopt;
}

// The micro-loops whose cycles a turn differ between the rule sets that fit: what a board would decide with.
std::string loops_that_part(const qemu::SiliconProgram& program, const std::string& core,
                            const std::vector<std::string>& sets) {
    std::vector<qemu::MeasuredCycles> rows;
    for (const char* loop : {
#define GLSUM_LOOP(name, most) #name,
#include "targets/shared/silicon_loops.def"
#undef GLSUM_LOOP
         }) {
        if (std::string_view(loop).starts_with("rival_")) {
            rows.push_back({loop, "itcm", "dtcm", false, 100, 1.0, 0});
            rows.push_back({loop, "itcm", "dtcm", false, 200, 1.0, 0});
        }
    }
    std::vector<qemu::CoreVariant> variants;
    for (const std::string& set : sets) {
        variants.push_back({core, set});
    }
    const auto predicted = qemu::predict(program, "rival loops", rows, variants);
    std::string text;
    for (std::size_t i = 0; i < rows.size(); i += 2) {
        std::string turns;
        double least = 1e300;
        double most = 0.0;
        for (std::size_t s = 0; s < sets.size(); ++s) {
            const double turn = (predicted[s][i + 1].nominal - predicted[s][i].nominal) / 100.0;
            least = std::min(least, turn);
            most = std::max(most, turn);
            turns += fmt::format("{}{} {:.2f}", turns.empty() ? "" : ", ", sets[s], turn);
        }
        if (most > 1.1 * least) {
            text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", rows[i].kernel, turns);
        }
    }
    return "run these loops on the board with targets/nucleo-f746zg; cycles a turn under each rule set: " + text;
}

// What is asked of rows, and how a core that may explain them is predicted.
gap::cycles::Question question_of(const std::vector<qemu::MeasuredCycles>& rows, const std::string& core,
                                  const std::filesystem::path& cores) {
    const timing::CoreFile base = timing::read_core(cores, core);
    gap::cycles::Question question;
    question.rows = rows;
    question.base = core;
    question.base_off = names_of(base.off);
    question.references = question.base_off.empty() ? std::vector<std::string>{core}
                                                    : std::vector<std::string>{"stm32h747-dtcm", "stm32f746-itcm"};
    for (const std::string& name : question.references) {
        for (const timing::RuleSet& set : timing::read_core(cores, name).sets) {
            question.sets[name].push_back(set.name);
            if (set.fits) {
                question.fitting[name].push_back(set.name);
            }
        }
    }
    return question;
}

qemu::SiliconProgram built_program() {
    const qemu::Board board = built_board();
    return {board.measure_elf.parent_path() / "silicon.elf", board.plugin, board.cores, board.emulator};
}

std::string percent(std::size_t part, std::size_t whole) {
    if (whole == 0) {
        return "-";
    }
    using Binomial = boost::math::binomial_distribution<>;
    const auto n = static_cast<double>(whole);
    const auto k = static_cast<double>(part);
    return fmt::format("{} of {}, {:.0f} % [{:.0f}, {:.0f}]", part, whole, 100.0 * k / n,
                       100.0 * Binomial::find_lower_bound_on_p(n, k, 0.025),
                       100.0 * Binomial::find_upper_bound_on_p(n, k, 0.025));
}

// Effects without which these rows differ by more than what is taken for no gap.
std::vector<std::string> switches_that_show(const qemu::SiliconProgram& program, const std::string& core,
                                            const std::vector<qemu::MeasuredCycles>& rows) {
    constexpr double shows = 0.03;
    std::vector<qemu::CoreVariant> variants{{core}};
    for (const std::string_view name : timing::effect_names) {
        variants.push_back({core, "", {std::string(name)}});
    }
    const auto predicted = qemu::predict(program, "blind", rows, variants);
    std::vector<std::string> found;
    for (std::size_t v = 1; v < variants.size(); ++v) {
        double difference = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            difference += std::fabs(predicted[v][i].nominal - predicted[0][i].nominal);
            sum += predicted[v][i].nominal;
        }
        if (difference > shows * sum) {
            found.push_back(variants[v].without.front());
        }
    }
    return found;
}

// The truth is written, and its hash told, before the first diagnosis; each diagnosis reads its rows from their file.
void run_blind(const Options& options) {
    const qemu::SiliconProgram program = built_program();
    const std::string core = options.core == "m7-ideal" ? default_core : options.core;
    const std::vector<qemu::MeasuredCycles> rows = gap::cycles::blind_rows();
    const auto secrets =
        gap::cycles::draw_secrets(options.blind, options.seed, switches_that_show(program, core, rows));
    std::filesystem::create_directories(options.out);
    nlohmann::ordered_json truths = nlohmann::ordered_json::array();
    std::vector<std::string> names;
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        const gap::cycles::Secret& secret = secrets[c];
        std::vector<qemu::MeasuredCycles> measured = rows;
        gap::cycles::measure(measured, qemu::predict(program, "blind", rows, {{core, "", secret.without}}).front(),
                             secret, options.seed + 1 + c);
        names.push_back(fmt::format("case-{:03}", c + 1));
        std::string csv = "kernel,code,data,maintenance,taps,cycles\n";
        for (const qemu::MeasuredCycles& row : measured) {
            csv += fmt::format("{},{},{},{},{},{}\n", row.kernel, row.code, row.data, row.maintenance ? 1 : 0, row.taps,
                               row.cycles);
        }
        put(csv, options.out / (names.back() + ".csv"));
        truths.push_back({{"case", names.back()},
                          {"kind", secret.kind},
                          {"effects", secret.effects},
                          {"ratio", secret.ratio},
                          {"overhead", secret.overhead},
                          {"maintenance", secret.maintenance},
                          {"contention", secret.contention},
                          {"sawtooth", secret.sawtooth}});
    }
    put(truths.dump(2) + "\n", options.out / "truth.json");
    fmt::print("{} cases of {}, sealed: sha256 {}\n\n  {:<10} {:<10} {:<44} {}\n", secrets.size(), core,
               base::sha256_of(options.out / "truth.json"), "case", "kind", "was done", "was found");
    std::map<std::string, std::pair<std::size_t, std::size_t>> right;  // of each kind, of how many
    for (std::size_t c = 0; c < secrets.size(); ++c) {
        const std::filesystem::path file = options.out / (names[c] + ".csv");
        const auto measured = read_measured_cycles(file);
        const gap::cycles::Explanation found = gap::cycles::explain(
            question_of(measured, core, program.cores_folder),
            [&](const auto& variants) { return qemu::predict(program, file, measured, variants); });
        put(gap::to_json(gap::cycles::verdict_of(found, core)), options.out / (names[c] + ".json"));
        std::vector<std::string> named;
        for (const gap::cycles::Step& step : found.steps) {
            named.push_back(step.effect);
        }
        const bool good = gap::cycles::names(found, secrets[c]);
        auto& [hits, all] = right[secrets[c].kind];
        hits += good ? 1 : 0;
        ++all;
        fmt::print("  {:<10} {:<10} {:<44} {}: {}{}\n", names[c], secrets[c].kind,
                   fmt::format("{}", fmt::join(secrets[c].effects, " ")), name_of(found.outcome), fmt::join(named, " "),
                   good ? "" : "   WRONG");
    }
    fmt::print("\n");
    for (const auto& [kind, counts] : right) {
        fmt::print("  {:<10} {}\n", kind, percent(counts.first, counts.second));
    }
}

void run(const Options& options) {
    if (options.blind > 0) {
        run_blind(options);
        return;
    }
    const std::vector<qemu::MeasuredCycles> rows = read_measured_cycles(options.measured);
    const qemu::SiliconProgram program = built_program();
    const auto predict = [&](const std::vector<qemu::CoreVariant>& variants) {
        return qemu::predict(program, options.measured, rows, variants);
    };
    const gap::cycles::Question question = question_of(rows, options.core, program.cores_folder);
    gap::cycles::Explanation found;
    const auto first = predict({{options.core}}).front();
    if (const auto other = other_program(rows, first)) {
        std::vector<double> measured, predicted;
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            measured.push_back(rows[i].cycles);
            predicted.push_back(first[i].nominal);
            all.push_back(i);
        }
        found.outcome = gap::Outcome::attributed;
        found.base_gap = found.after_gap = gap::cycles::gap_of(measured, predicted, all);
        found.steps.push_back({"different_binary", {}, {}, found.base_gap, found.base_gap, 0.99});
        found.notes.push_back(*other);
        found.next_experiment = "measure the ELF that is predicted: the core is judged once the instructions are equal";
    } else {
        found = gap::cycles::explain(question, predict);
        if (found.outcome == gap::Outcome::ambiguous && found.next_experiment.empty()) {
            found.next_experiment = loops_that_part(program, found.reference, question.fitting.at(found.reference));
        }
    }
    fmt::print("{}: {} rows\n{}", options.measured.filename().string(), rows.size(),
               gap::to_text(gap::cycles::verdict_of(found, options.core)));
    if (!options.json.empty()) {
        put(gap::to_json(gap::cycles::verdict_of(found, options.core)), options.json);
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
    command.add_option("--core", options->core, "The prediction that is judged, a core file").capture_default_str();
    command.add_option("--json", options->json, "The verdict, schema glsum-gap-1");
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
        if (options->blind > 0 && (options->out.empty() || !options->measured.empty() || !options->json.empty())) {
            throw Failure(Exit::bad_input, "--blind: expected --out FOLDER, and neither --measured nor --json");
        }
        run(*options);
    });
}

}  // namespace cli
