#include "bench/studies/models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/glob.hpp"
#include "base/progress.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/studies/model_case.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/model_file.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "qemu/emulate/model_run.hpp"

namespace bench {
namespace {

constexpr std::size_t long_steps = 60'000;  // the same, where a step costs the same however long it goes on

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

void run_here(ModelCase& one) {
    const qemu::PlannedModel planned{one.kernel, &one.design.design(), ones, one.steps};
    qemu::SteppedModel stepped;
    const double seconds = best_seconds(3, [&] { stepped = qemu::step_model_here(planned); });
    if (stepped.status != glsum::Status::ok) {
        one.fault = to_text(stepped.status);
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

// Whether what is left of the past never ends.
bool has_tail(const drive::Model& model) {
    return std::any_of(model.denominator.begin(), model.denominator.end(),
                       [](const drive::Term& term) { return term.order != std::floor(term.order); });
}

// Full memory of long records, by blocks.
std::string time_long_records(const drive::Model& model, const std::string& name,
                              const std::vector<std::size_t>& records, std::vector<Json>& rows) {
    std::string text = "\nFull memory on this machine, one merged table in double, by blocks\n";
    std::vector<double> seconds;
    for (const std::size_t samples : records) {
        const std::vector<double> input(samples + 1, 1.0);
        drive::Scheme scheme{.step_s = model_step_s, .increments = true};
        seconds.push_back(
            best_seconds(samples > 500'000 ? 2 : 3, [&] { (void)drive::simulate(model, scheme, input); }));
        text += fmt::format("  {:>8} samples {:>10.4f} s {:>10.1f} ns a sample\n", samples, seconds.back(),
                            1e9 * seconds.back() / static_cast<double>(samples));
        RowKey key;
        key.kind = RowKind::model;
        key.model = name;
        key.kernel = "blockdelta_fft_f64";
        key.taps = std::to_string(samples);
        key.aspect = RowKey::host;
        Row row(key, samples);
        const double ns = 1e9 * seconds.back() / static_cast<double>(samples);
        row.set_time(ns);
        row.set(Counter::ns_per_sample, ns);
        rows.push_back(std::move(row).take());
    }
    return text + fmt::format("  t({})/t({}) = {:.1f}\n", records.back(), records[records.size() - 2],
                              seconds.back() / seconds[seconds.size() - 2]);
}

// Of those asked for, a kernel's own; the usual ones where none were.
ModelLengths lengths_of(const Models& wanted, bool with_modes, drive::Writing writing) {
    ModelLengths lengths;
    std::copy_if(wanted.lengths.begin(), wanted.lengths.end(), std::back_inserter(lengths),
                 [&](const auto& length) { return (length && length->modes > 0) == with_modes; });
    if (!wanted.lengths.empty()) {
        return lengths;
    }
    const auto modes = [](std::size_t near_taps, std::size_t count) {
        return drive::Memory{near_taps + 2 * count, count};
    };
    if (with_modes) {
        return writing == drive::Writing::bdf2 ? ModelLengths{modes(5, 9), modes(5, 11)}
                                               : ModelLengths{modes(2, 5), modes(2, 7), modes(2, 9)};
    }
    if (wanted.quick || writing == drive::Writing::bdf2) {
        return {drive::Memory{100}, drive::Memory{600}};
    }
    return {drive::Memory{50}, drive::Memory{100}, drive::Memory{200}, drive::Memory{600}, std::nullopt};
}

// What each case takes on an emulated machine: one more in its list of those.
void step_there(std::vector<ModelCase>& cases, const ModelBoard& on) {
    const timing::TimingRequest timing = timing_request(on.board.cores, on.cores);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (cases[i].fault.empty() && cases[i].runs_on_target()) {
            chosen.push_back(i);
        }
    }
    base::Progress progress("models on the " + on.board.name(), chosen.size());
    // As many at once as the firmware has room for.
    constexpr std::size_t at_once = 20;
    for (std::size_t first = 0; first < chosen.size(); first += at_once) {
        std::vector<qemu::PlannedModel> plan;
        for (std::size_t i = first; i < std::min(first + at_once, chosen.size()); ++i) {
            const ModelCase& one = cases[chosen[i]];
            plan.push_back({one.kernel, &one.design.design(), ones, one.steps});
        }
        const auto counted = qemu::step_models(
            on.board, plan, [&] { progress.advance(); }, timing);
        for (std::size_t i = 0; i < counted.size(); ++i) {
            const bool same_bits =
                counted[i].status == glsum::Status::ok && counted[i].hash == qemu::step_model_here(plan[i]).hash;
            cases[chosen[first + i]].counted.push_back({counted[i], same_bits});
        }
    }
}

// A machine's cycles of a step: of the chip that its rows are for where none is asked for.
ModelColumns columns_of(const ModelBoard& on) {
    const base::Machine& machine = *on.board.machine;
    const std::string usual(machine.default_core);
    return {std::string(machine.name.substr(machine.name.rfind('-') + 1)),
            model_step_s * clocks_of(timing_request(on.board.cores, {usual})).front()};
}

void add_target_rows(std::vector<Json>& rows, const ModelCase& one, const std::vector<ModelBoard>& boards,
                     const std::vector<ModelColumns>& columns) {
    for (std::size_t i = 0; i < one.counted.size(); ++i) {
        const base::Machine& machine = *boards[i].board.machine;
        const std::vector<std::string>& cores = boards[i].cores;
        const std::vector<double> clocks = clocks_of(timing_request(boards[i].board.cores, cores));
        rows.push_back(to_target_row(one, one.counted[i], on_target(machine, count_only), {}, 1.0, columns[i].period));
        for (std::size_t c = 0; c < cores.size(); ++c) {
            rows.push_back(
                to_target_row(one, one.counted[i], on_target(machine, cores[c]), c, clocks[c], columns[i].period));
        }
    }
}

// What a machine's columns are, under the tables.
std::string meaning_of(const ModelBoard& on, const ModelColumns& columns) {
    return fmt::format(
        "\n  {}: instructions a step on the emulated core, dead time and factors included; model cycles: "
        "what the timing\n"
        "  model gives it on {}, with the band over its rule sets. period: the worst step's {} over\n"
        "  {}, the cycles of a step on {}. Every row that ran there computed the host's "
        "bits over the\n"
        "  whole record.\n",
        columns.machine, on.cores.empty() ? "no core" : on.cores[0], on.cores.empty() ? "instructions" : "cycles",
        in_thousands(columns.period), on.board.machine->default_core);
}

}  // namespace

Study measure_models(const Models& wanted, const std::function<void(const std::string&)>& say) {
    const auto wants = [&](const char* target) {
        return std::find(wanted.targets.begin(), wanted.targets.end(), target) != wanted.targets.end();
    };
    std::map<std::string, drive::Model> models;
    std::map<std::string, std::vector<double>> exact;
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        const std::filesystem::path path = wanted.models / (std::string(name) + ".json");
        models[name] = drive::parse_model(base::read_file(path, drive::most_model_bytes), path.string());
        const std::size_t steps =
            long_steps + static_cast<std::size_t>(std::ceil(models[name].delay_s / model_step_s - 1e-9));
        std::vector<double> times;
        for (std::size_t k = 0; k <= steps; ++k) {
            times.push_back(static_cast<double>(k) * model_step_s);
        }
        exact[name] = drive::respond(models[name], std::vector<drive::Change>{{0.0, 1.0}}, times);
    }

    std::vector<ModelCase> cases;
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        for (const drive::Writing writing :
             {drive::Writing::delta, drive::Writing::bdf2, drive::Writing::merged, drive::Writing::apart}) {
            glsum::ModelKernels::for_each([&]<class K>() {
                const std::string kernel(K::name());
                const std::string written = drive::realtime_name(kernel, writing);
                const bool suits =
                    base::matches_any(wanted.kernels, kernel) || base::matches_any(wanted.kernels, written);
                constexpr bool with_modes = std::is_same_v<typename K::HistoryPart, glsum::Modes>;
                const bool increments = writing == drive::Writing::delta || writing == drive::Writing::bdf2;
                if (!suits || (with_modes && (!increments || !has_tail(models[name])))) {
                    return;
                }
                for (const auto& length : lengths_of(wanted, with_modes, writing)) {
                    const std::size_t steps =
                        exact[name].size() - 1 - (with_modes ? 0 : long_steps - model_response_steps);
                    std::optional<drive::RealtimeModel> made;
                    try {
                        made.emplace(models[name], writing, length.value_or(drive::Memory{model_response_steps + 1}),
                                     model_step_s, long_steps);
                    } catch (const glsum::Failure& refused) {
                        say(fmt::format("left out: {} {}: {}", name, written, refused.what()));
                        continue;
                    }
                    drive::RealtimeModel& design = *made;
                    // Whole orders end their memory by themselves, however long it might be.
                    const bool known = !cases.empty() && cases.back().model == name && cases.back().name == written &&
                                       cases.back().design.memory().text() == design.memory().text();
                    if (!known) {
                        const bool full = !length && design.memory().taps == model_response_steps + 1;
                        cases.push_back({name, written, kernel, writing, full, std::move(design), steps, &exact[name]});
                    }
                }
            });
        }
    }
    if (cases.empty()) {
        std::vector<std::string> names;
        glsum::ModelKernels::for_each([&]<class K>() { names.emplace_back(K::name()); });
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format(
                "--kernels, --taps: nothing that can be stepped; models are stepped with {}, each also as {} and "
                "{}; found {}",
                fmt::join(names, ", "), drive::realtime_name("ring_...", drive::Writing::delta),
                drive::realtime_name("ring_...", drive::Writing::apart), fmt::join(wanted.kernels, ", ")));
    }
    {
        base::Progress progress("models here", cases.size());
        for (ModelCase& one : cases) {
            run_here(one);
            progress.advance();
        }
    }
    std::vector<ModelColumns> columns;
    for (const ModelBoard& on : wanted.boards) {
        step_there(cases, on);
        columns.push_back(columns_of(on));
    }

    Study study;
    for (const ModelCase& one : cases) {
        if (wants("host")) {
            study.rows.push_back(to_host_row(one));
        }
        add_target_rows(study.rows, one, wanted.boards, columns);
        study.wrong += one.fault.empty() && one.same_bits() ? 0 : 1;
    }
    study.text = fmt::format(
        "Models stepped at 1 kHz, a unit step, for so many seconds; errors relative to the largest exact output.\n"
        "ringdelta: one table on increments; ringbdf2: the same of second order in h; ring: the textbook's, one table; "
        "ringapart:\n"
        "the textbook's, one for each order; modes: 2+7 near taps and modes, full memory.\n");
    for (const char* name : {"fopdt", "sopdt", "niopdt"}) {
        study.text += to_table(cases, name, columns.empty() ? std::vector<ModelColumns>{{}} : columns);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        study.text += meaning_of(wanted.boards[i], columns[i]);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        study.text += deadline_table(cases, i, columns[i]);
    }
    if (wants("host") && !wanted.quick) {
        study.text += time_long_records(models["niopdt"], "niopdt", wanted.long_records, study.rows);
    }
    Sweep sweep;
    sweep.targets = wanted.targets;
    sweep.samples = model_response_steps;
    sweep.jobs = wanted.jobs;
    sweep.kernels = wanted.kernels;
    sweep.orders = {0.0};  // a sweep names where software double is counted; models have orders of their own
    std::vector<qemu::Board> stepped_on;
    for (const ModelBoard& on : wanted.boards) {
        stepped_on.push_back(on.board);
        stepped_on.back().measure_elf = qemu::model_elf(on.board);
    }
    study.context = make_context(Json(), sweep, stepped_on);
    for (const char* of_sums : {"target_count_order", "weights", "first_weights"}) {
        study.context.erase(of_sums);
    }
    study.context["sweep"]["orders"] = Json::array();
    return study;
}

}  // namespace bench
