// glsum bench models: whole models stepped in real time, on this machine and on the emulated Cortex-M7. Writes rows
// `drive/<model>/<kernel>/taps:<L>/<target>`.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/progress.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/rows/results.hpp"
#include "bench/run/context.hpp"
#include "bench/target/target_rows.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "drive/realtime.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "qemu/emulate/model_run.hpp"

namespace cli {
namespace {

using bench::Json;
using glsum::Exit;
using glsum::Failure;

struct Options {
    std::vector<std::string> kernels{"*"};  ///< globs
    std::vector<std::string> taps;          ///< numbers, full, or 2+7 of kernels with modes; empty: the usual ones
    std::vector<std::string> targets{"host", "m7"};
    std::vector<std::string> cores{default_core};  ///< of the timing model; the first is what the table shows
    bool quick = false;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    std::filesystem::path out = results_folder() / "drive.json";
};

constexpr double step_s = 0.001;
constexpr double period_cycles = 216e6 * step_s;   // an STM32F746 at 1 kHz
constexpr std::size_t response_steps = 5000;       // 5 s behind the dead time
constexpr std::size_t long_steps = 60'000;         // the same, where a step costs the same however long it goes on
constexpr std::size_t emulated_double_taps = 600;  // longer ones take minutes in software

struct Case {
    std::string model;
    std::string name;  ///< with the writing
    std::string kernel;
    drive::Writing writing;
    bool full;
    drive::RealtimeModel design;
    std::size_t steps;
    const std::vector<double>* exact;
    double error_max = 0.0;
    double error_rms = 0.0;
    double final_output = 0.0;
    std::uint32_t saturations = 0;
    double host_ns = 0.0;
    std::size_t macs = 0;
    std::optional<qemu::MeasuredRow> counted = {};
    bool same_bits = true;
    std::string fault = {};

    [[nodiscard]] std::string length() const { return full ? "full" : design.memory().text(); }
    [[nodiscard]] bool in_double() const { return kernel.ends_with("f64"); }
    [[nodiscard]] bool runs_on_target() const { return !in_double() || design.memory().taps <= emulated_double_taps; }
};

const std::vector<double> ones{1.0};

template <class Work>
double best_seconds(int runs, Work work) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < runs; ++i) {
        const std::clock_t start = std::clock();  // of the processor: others on the machine do not count
        work();
        best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

void run_here(Case& one) {
    const qemu::PlannedModel planned{one.kernel, &one.design.design(), ones, one.steps};
    qemu::SteppedModel stepped;
    const double seconds = best_seconds(3, [&] { stepped = qemu::step_model_here(planned); });
    if (stepped.status != glsum::Status::ok) {
        one.fault = bench::to_text(stepped.status);
        return;
    }
    one.host_ns = 1e9 * seconds / static_cast<double>(one.steps + 1);
    one.saturations = stepped.saturations;
    one.macs = stepped.multiplications;
    one.final_output = stepped.output[one.steps];
    double largest = 0.0;
    double square = 0.0;
    double peak = 0.0;
    for (std::size_t k = 0; k <= one.steps; ++k) {
        const double error = stepped.output[k] - (*one.exact)[k];
        largest = std::max(largest, std::fabs(error));
        square += error * error;
        peak = std::max(peak, std::fabs((*one.exact)[k]));
    }
    one.error_max = largest / peak;
    one.error_rms = std::sqrt(square / static_cast<double>(one.steps + 1)) / peak;
}

// \param core  which of the counted row's modelled cores; counts alone without
Json to_row(const Case& one, const std::string& target, std::optional<std::size_t> core = {}, double clock_hz = 1.0) {
    Json row = bench::make_row(fmt::format("drive/{}/{}/taps:{}/{}", one.model, one.name, one.length(), target),
                               one.steps + 1);
    row["error_max"] = one.error_max;
    row["error_rms"] = one.error_rms;
    row["final_output"] = one.final_output;
    if (one.design.memory().modes == 0) {
        row["effective_taps"] = one.design.memory().taps;
    }
    row["macs_per_sample"] = one.macs;
    row["horizon_samples"] = one.design.memory().modes == 0 ? one.design.memory().taps : one.steps;
    if (!one.fault.empty()) {
        bench::mark_error(row, one.fault);
        return row;
    }
    if (one.kernel.find("_q") != std::string::npos) {
        row["saturations"] = one.saturations;
    }
    if (target == "host") {
        row["real_time"] = row["cpu_time"] = row["ns_per_sample"] = one.host_ns;
        return row;
    }
    const qemu::MeasuredRow& counted = *one.counted;
    row["label"] = std::string(core ? "modelled cycles" : "instructions only") +
                   (one.in_double() ? "; double precision in software, where the count depends on the data" : "");
    row["instructions_per_sample"] = counted.instructions;
    row["loads_per_sample"] = counted.loads;
    row["stores_per_sample"] = counted.stores;
    row["branches_per_sample"] = counted.branches;
    row["first_instructions"] = counted.first.instructions;
    row["worst_instructions"] = counted.worst_instructions;
    row["instructions_share_of_period"] = static_cast<double>(counted.worst_instructions) / period_cycles;
    if (core) {
        const qemu::ModelledCall& modelled = counted.cores.at(*core);
        bench::add_modelled(row, modelled, clock_hz);
        row["share_of_period"] = modelled.worst_cycles / (clock_hz * step_s);
    }
    row["code_bytes"] = counted.code_bytes;
    row["stack_bytes"] = counted.stack_bytes;
    row["state_bytes"] = counted.state_bytes;
    row["coefficient_bytes"] = counted.coefficient_bytes;
    if (core && !counted.unknown_encodings.empty()) {
        bench::mark_error(row, fmt::format("the timing model does not know {} encodings, the first at {:#010x}",
                                           counted.unknown_encodings.size(), counted.unknown_encodings.front()));
    }
    if (!one.same_bits) {
        bench::mark_error(row, "the target's outputs differ from the host's");
    }
    return row;
}

std::string to_table(const std::vector<Case>& cases, const std::string& model) {
    std::string text = fmt::format("\n{}\n  {:<28} {:>6} {:>5} {:>5} {:>10} {:>10} {:>10} {:>17} {:>8} {:>8}  {}\n",
                                   model, "kernel", "taps", "MACs", "for s", "error max", "at the end", "M7 instr.",
                                   "model cycles", "period", "bytes", "host ns");
    for (const Case& one : cases) {
        if (one.model != model) {
            continue;
        }
        text += fmt::format("  {:<28} {:>6} ", one.name, one.length());
        if (!one.fault.empty()) {
            text += one.fault + "\n";
            continue;
        }
        text += fmt::format("{:>5} {:>5.0f} {:>10.2e} {:>10.5f} ", one.macs, static_cast<double>(one.steps) * step_s,
                            one.error_max, one.final_output);
        if (one.counted) {
            const auto worst = static_cast<double>(one.counted->worst_instructions);
            const auto& cores = one.counted->cores;
            text += fmt::format("{:>10.1f} {:>17} {:>7.2f}% {:>8}  ", one.counted->instructions,
                                cores.empty()                   ? "-"
                                : cores[0].low == cores[0].high ? fmt::format("{:.0f}", cores[0].cycles)
                                                                : fmt::format("{:.0f} ({:.0f}-{:.0f})", cores[0].cycles,
                                                                              cores[0].low, cores[0].high),
                                100.0 * (cores.empty() ? worst : cores[0].worst_cycles) / period_cycles,
                                one.counted->state_bytes + one.counted->coefficient_bytes);
        } else {
            text += fmt::format("{:>10} {:>17} {:>8} {:>8}  ", "-", "-", "-", "-");
        }
        text += fmt::format("{:.1f}{}{}\n", one.host_ns,
                            one.saturations > 0 ? fmt::format("  {} saturations", one.saturations) : "",
                            one.same_bits ? "" : "  NOT THE HOST'S BITS");
    }
    return text;
}

// Whether what is left of the past never ends.
bool has_tail(const drive::Model& model) {
    return std::any_of(model.denominator.begin(), model.denominator.end(),
                       [](const drive::Term& term) { return term.order != std::floor(term.order); });
}

// The longest memory that a period leaves, if every cycle took an instruction, and what bytes 320 KB leave.
std::string deadline_table(const std::vector<Case>& cases) {
    std::string text = fmt::format(
        "\nThe longest memory at 1 kHz, 216 000 cycles a step, by the line through two counted lengths\n  {:<10} "
        "{:<28} "
        "{:>16} {:>14} {:>16} {:>16}\n",
        "model", "kernel", "instr. a tap", "bytes a tap", "1 a cycle", "in 320 KB");
    std::map<std::pair<std::string, std::string>, std::vector<const Case*>> counted;
    for (const Case& one : cases) {
        if (one.counted && one.fault.empty() && one.design.memory().modes == 0) {
            counted[{one.model, one.name}].push_back(&one);
        }
    }
    for (const auto& [key, list] : counted) {
        const auto [shortest, longest] = std::minmax_element(
            list.begin(), list.end(),
            [](const Case* a, const Case* b) { return a->design.memory().taps < b->design.memory().taps; });
        const auto taps = [](const Case* one) { return static_cast<double>(one->design.memory().taps); };
        const auto cost = [](const Case* one) { return static_cast<double>(one->counted->worst_instructions); };
        const auto bytes = [](const Case* one) {
            return static_cast<double>(one->counted->state_bytes + one->counted->coefficient_bytes);
        };
        if (taps(*longest) < taps(*shortest) + 32.0) {
            continue;  // whole orders: the memory ends by itself
        }
        const double span = taps(*longest) - taps(*shortest);
        text += fmt::format(
            "  {:<10} {:<28} {:>16.2f} {:>14.1f} {:>16} {:>16}\n", key.first, key.second,
            (cost(*longest) - cost(*shortest)) / span, (bytes(*longest) - bytes(*shortest)) / span,
            drive::largest_taps(taps(*shortest), cost(*shortest), taps(*longest), cost(*longest), period_cycles),
            drive::largest_taps(taps(*shortest), bytes(*shortest), taps(*longest), bytes(*longest), 320.0 * 1024.0));
    }
    return text +
           "  Instructions are not cycles: waits make the length shorter, a second instruction in a cycle longer.\n";
}

// Full memory of long records, by blocks.
std::string time_long_records(const drive::Model& model, const std::string& name, std::vector<Json>& rows) {
    std::string text = "\nFull memory on this machine, one merged table in double, by blocks\n";
    std::vector<double> seconds;
    for (const std::size_t samples : {response_steps, std::size_t{100'000}, std::size_t{1'000'000}}) {
        const std::vector<double> input(samples + 1, 1.0);
        drive::Scheme scheme{.step_s = step_s, .increments = true};
        seconds.push_back(
            best_seconds(samples > 500'000 ? 2 : 3, [&] { (void)drive::simulate(model, scheme, input); }));
        text += fmt::format("  {:>8} samples {:>10.4f} s {:>10.1f} ns a sample\n", samples, seconds.back(),
                            1e9 * seconds.back() / static_cast<double>(samples));
        Json row = bench::make_row(fmt::format("drive/{}/blockdelta_fft_f64/taps:{}/host", name, samples), samples);
        row["real_time"] = row["cpu_time"] = row["ns_per_sample"] = 1e9 * seconds.back() / static_cast<double>(samples);
        rows.push_back(row);
    }
    return text + fmt::format("  t(10^6)/t(10^5) = {:.1f}\n", seconds[2] / seconds[1]);
}

// What a kernel is asked for: nothing is full memory.
using Lengths = std::vector<std::optional<drive::Memory>>;

Lengths asked_lengths(const Options& options) {
    Lengths lengths;
    for (const std::string& word : options.taps) {
        const auto length = bench::parse_length(word, response_steps + 1);
        if (!length || length->taps > response_steps + 1) {
            throw Failure(Exit::bad_input, fmt::format("--taps: expected numbers of 1 to {}, full, or of kernels with "
                                                       "modes 2+7, found {}",
                                                       response_steps, word));
        }
        lengths.push_back(length->full ? std::nullopt
                                       : std::optional(drive::Memory{length->taps, length->modes.value_or(0)}));
    }
    return lengths;
}

// Of those asked for, a kernel's own; the usual ones where none were.
Lengths lengths_of(const Options& options, const Lengths& asked, bool with_modes, drive::Writing writing) {
    Lengths lengths;
    std::copy_if(asked.begin(), asked.end(), std::back_inserter(lengths),
                 [&](const auto& length) { return (length && length->modes > 0) == with_modes; });
    if (!asked.empty()) {
        return lengths;
    }
    const auto modes = [](std::size_t near_taps, std::size_t count) {
        return drive::Memory{near_taps + 2 * count, count};
    };
    if (with_modes) {
        return writing == drive::Writing::bdf2 ? Lengths{modes(5, 9), modes(5, 11)}
                                               : Lengths{modes(2, 5), modes(2, 7), modes(2, 9)};
    }
    if (options.quick || writing == drive::Writing::bdf2) {
        return {drive::Memory{100}, drive::Memory{600}};
    }
    return {drive::Memory{50}, drive::Memory{100}, drive::Memory{200}, drive::Memory{600}, std::nullopt};
}

void run(const Options& options) {
    const auto wants = [&](const char* target) {
        return std::find(options.targets.begin(), options.targets.end(), target) != options.targets.end();
    };
    std::optional<qemu::Board> board;
    if (wants("m7")) {
        board = built_board();
        (void)qemu::model_elf(*board);
    }
    const timing::TimingRequest timing = bench::timing_request(cores_folder(), options.cores);
    const std::vector<double> clocks = bench::clocks_of(timing);
    const Lengths asked = asked_lengths(options);
    std::map<std::string, drive::Model> models;
    std::map<std::string, std::vector<double>> exact;
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        const auto path =
            std::filesystem::path(build_info::source_folder) / "drive" / "models" / (std::string(name) + ".json");
        models[name] = read_model(path);
        const std::size_t steps =
            long_steps + static_cast<std::size_t>(std::ceil(models[name].delay_s / step_s - 1e-9));
        std::vector<double> times;
        for (std::size_t k = 0; k <= steps; ++k) {
            times.push_back(static_cast<double>(k) * step_s);
        }
        exact[name] = drive::respond(models[name], std::vector<drive::Change>{{0.0, 1.0}}, times);
    }

    std::vector<Case> cases;
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        for (const drive::Writing writing :
             {drive::Writing::delta, drive::Writing::bdf2, drive::Writing::merged, drive::Writing::apart}) {
            glsum::ModelKernels::for_each([&]<class K>() {
                const std::string kernel(K::name());
                const std::string written = drive::realtime_name(kernel, writing);
                const bool wanted =
                    std::any_of(options.kernels.begin(), options.kernels.end(), [&](const std::string& glob) {
                        return fnmatch(glob.c_str(), kernel.c_str(), 0) == 0 ||
                               fnmatch(glob.c_str(), written.c_str(), 0) == 0;
                    });
                constexpr bool with_modes = std::is_same_v<typename K::HistoryPart, glsum::Modes>;
                const bool increments = writing == drive::Writing::delta || writing == drive::Writing::bdf2;
                if (!wanted || (with_modes && (!increments || !has_tail(models[name])))) {
                    return;
                }
                for (const auto& length : lengths_of(options, asked, with_modes, writing)) {
                    const std::size_t steps = exact[name].size() - 1 - (with_modes ? 0 : long_steps - response_steps);
                    std::optional<drive::RealtimeModel> made;
                    try {
                        made.emplace(models[name], writing, length.value_or(drive::Memory{response_steps + 1}), step_s,
                                     long_steps);
                    } catch (const Failure& refused) {
                        fmt::print(stderr, "left out: {} {}: {}\n", name, written, refused.what());
                        continue;
                    }
                    drive::RealtimeModel& design = *made;
                    // Whole orders end their memory by themselves, however long it might be.
                    const bool known = !cases.empty() && cases.back().model == name && cases.back().name == written &&
                                       cases.back().design.memory().text() == design.memory().text();
                    if (!known) {
                        const bool full = !length && design.memory().taps == response_steps + 1;
                        cases.push_back({name, written, kernel, writing, full, std::move(design), steps, &exact[name]});
                    }
                }
            });
        }
    }
    if (cases.empty()) {
        std::vector<std::string> names;
        glsum::ModelKernels::for_each([&]<class K>() { names.emplace_back(K::name()); });
        throw Failure(
            Exit::bad_input,
            fmt::format(
                "--kernels, --taps: nothing that can be stepped; models are stepped with {}, each also as {} and "
                "{}; found {}",
                fmt::join(names, ", "), drive::realtime_name("ring_...", drive::Writing::delta),
                drive::realtime_name("ring_...", drive::Writing::apart), fmt::join(options.kernels, ", ")));
    }
    {
        base::Progress progress("models here", cases.size());
        for (Case& one : cases) {
            run_here(one);
            progress.advance();
        }
    }
    if (board) {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            if (cases[i].fault.empty() && cases[i].runs_on_target()) {
                chosen.push_back(i);
            }
        }
        base::Progress progress("models on the emulated Cortex-M7", chosen.size());
        // As many at once as the firmware has room for.
        constexpr std::size_t at_once = 20;
        for (std::size_t first = 0; first < chosen.size(); first += at_once) {
            std::vector<qemu::PlannedModel> plan;
            for (std::size_t i = first; i < std::min(first + at_once, chosen.size()); ++i) {
                const Case& one = cases[chosen[i]];
                plan.push_back({one.kernel, &one.design.design(), ones, one.steps});
            }
            const auto counted = qemu::step_models(
                *board, plan, [&] { progress.advance(); }, timing);
            for (std::size_t i = 0; i < counted.size(); ++i) {
                Case& one = cases[chosen[first + i]];
                one.counted = counted[i];
                one.same_bits =
                    counted[i].status == glsum::Status::ok && counted[i].hash == qemu::step_model_here(plan[i]).hash;
            }
        }
    }

    std::vector<Json> rows;
    std::size_t wrong = 0;
    for (const Case& one : cases) {
        if (wants("host")) {
            rows.push_back(to_row(one, "host"));
        }
        if (one.counted) {
            rows.push_back(to_row(one, "m7:count"));
            for (std::size_t c = 0; c < options.cores.size(); ++c) {
                rows.push_back(to_row(one, "m7:" + options.cores[c], c, clocks[c]));
            }
        }
        wrong += one.fault.empty() && one.same_bits ? 0 : 1;
    }
    std::string text = fmt::format(
        "Models stepped at 1 kHz, a unit step, for so many seconds; errors relative to the largest exact output.\n"
        "ringdelta: one table on increments; ringbdf2: the same of second order in h; ring: the textbook's, one table; "
        "ringapart:\n"
        "the textbook's, one for each order; modes: 2+7 near taps and modes, full memory.\n");
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        text += to_table(cases, name);
    }
    text += fmt::format(
        "\n  M7: instructions a step on the emulated core, dead time and factors included; model cycles: "
        "what the timing\n"
        "  model gives it on {}, with the band over its rule sets. period: the worst step's {} over\n"
        "  216 000, the cycles of a step on an STM32F746. Every row that ran there computed the host's "
        "bits over the\n"
        "  whole record.\n",
        options.cores.empty() ? "no core" : options.cores[0], options.cores.empty() ? "instructions" : "cycles");
    if (board) {
        text += deadline_table(cases);
    }
    if (wants("host") && !options.quick) {
        text += time_long_records(models["niopdt"], "niopdt", rows);
    }
    fmt::print("{}", text);
    bench::Sweep sweep;
    sweep.targets = options.targets;
    sweep.samples = response_steps;
    sweep.jobs = options.jobs;
    sweep.kernels = options.kernels;
    sweep.orders = {0.0};  // a sweep names where software double is counted; models have orders of their own
    std::optional<qemu::Board> stepped_on = board;
    if (board) {
        stepped_on->measure_elf = qemu::model_elf(*board);
    }
    Json context = bench::make_context(Json(), sweep, board ? &*stepped_on : nullptr);
    for (const char* of_sums : {"target_count_order", "weights", "first_weights"}) {
        context.erase(of_sums);
    }
    context["sweep"]["orders"] = Json::array();
    bench::write_results(options.out, context, rows);
    fmt::print("\n{} rows in {}\n", rows.size(), options.out.string());
    if (wrong > 0) {
        throw Failure(Exit::check_failed, fmt::format("{} rows are wrong or impossible; they are marked", wrong));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "bench --drive is the same command.\n"
        "Example: glsum bench models --kernels 'modes*,*delta_*f32' --taps 2+7,5+11,600,full");
    command.add_flag("--drive").hidden();
    command.add_flag("--quick", options->quick, "Fewer lengths, and no records of an hour");
    command.add_option("--kernels", options->kernels, "Globs of kernel names").delimiter(',').capture_default_str();
    command.add_option("--taps", options->taps, "Lengths: numbers, full, or 2+7: two near taps and seven modes")
        .delimiter(',');
    command.add_option("--targets", options->targets, "host, m7 or both").delimiter(',').capture_default_str();
    command.add_option("--core", options->cores, "Cores of the timing model, files of qemu/cores")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--jobs", options->jobs, "Threads and emulators at once").between(1, 1024);
    command.add_option("--out", options->out, "Result file (default: results/drive.json)");
    command.callback([options] {
        check_targets(options->targets);
        std::erase(options->cores, bench::count_only);
        run(*options);
    });
}

}  // namespace cli
