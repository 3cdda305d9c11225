#include "cli/diagnose_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/board.hpp"
#include "cli/drive_files.hpp"
#include "gap/cycles/explain.hpp"
#include "gap/cycles/verdict.hpp"
#include "qemu/failure.hpp"
#include "qemu/firmware.hpp"
#include "qemu/silicon.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path measured;
    std::string core = "m7-ideal";
    std::filesystem::path json;
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
#include "targets/firmware/silicon_loops.def"
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

void run(const Options& options) {
    const std::vector<qemu::MeasuredCycles> rows = qemu::read_measured_cycles(options.measured);
    const qemu::Board board = built_board();
    const qemu::SiliconProgram program{board.measure_elf.parent_path() / "silicon.elf", board.plugin, board.cores,
                                       board.emulator};
    const auto predict = [&](const std::vector<qemu::CoreVariant>& variants) {
        return qemu::predict(program, options.measured, rows, variants);
    };
    const timing::CoreFile base = timing::read_core(board.cores, options.core);
    gap::cycles::Question question;
    question.rows = rows;
    question.base = options.core;
    question.base_off = names_of(base.off);
    question.references = question.base_off.empty() ? std::vector<std::string>{options.core}
                                                    : std::vector<std::string>{"stm32h747-dtcm", "stm32f746-itcm"};
    for (const std::string& name : question.references) {
        for (const timing::RuleSet& set : timing::read_core(board.cores, name).sets) {
            question.sets[name].push_back(set.name);
            if (set.fits) {
                question.fitting[name].push_back(set.name);
            }
        }
    }
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
        found.verdict = "attributed";
        found.base_gap = found.after_gap = gap::cycles::gap_of(measured, predicted, all);
        found.steps.push_back({"different_binary", {}, {}, found.base_gap, found.base_gap, 0.99});
        found.notes.push_back(*other);
        found.next_experiment = "measure the ELF that is predicted: the core is judged once the instructions are equal";
    } else {
        found = gap::cycles::explain(question, predict);
        if (found.verdict == "ambiguous" && found.next_experiment.empty()) {
            found.next_experiment = loops_that_part(program, found.reference, question.fitting.at(found.reference));
        }
    }
    fmt::print("{}: {} rows\n{}", options.measured.filename().string(), rows.size(),
               gap::cycles::to_text(found, options.core));
    if (!options.json.empty()) {
        put(gap::cycles::to_json(found), options.json);
    }
}

}  // namespace

void add_diagnose_cycles(CLI::App& diagnose) {
    auto options = std::make_shared<Options>();
    CLI::App* command = diagnose.add_subcommand("cycles", "Predicted cycles against measured ones");
    command->footer(
        "Example: glsum diagnose cycles --measured results/silicon/h747_per_sample_fir.csv --json verdict.json");
    command
        ->add_option("--measured", options->measured,
                     "CSV: kernel,code,data,maintenance,taps,cycles, and instructions if they were counted")
        ->required();
    command->add_option("--core", options->core, "The prediction that is judged, a core file")->capture_default_str();
    command->add_option("--json", options->json, "The verdict, schema glsum-gap-1");
    command->callback([options] { run(*options); });
}

}  // namespace cli
