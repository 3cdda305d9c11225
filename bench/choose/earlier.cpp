#include "bench/choose/earlier.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/rows/target_fields.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"

namespace choose {
namespace {

using bench::Counter;
using bench::value_of;

std::string text(const bench::Json& context, const char* field) {
    const auto found = context.find(field);
    return found == context.end() ? "" : found->is_string() ? found->get<std::string>() : found->dump();
}

// The first field in which two contexts differ, as "field (there, here)"; empty when they agree.
std::string difference(const bench::Json& there, const bench::Json& here, std::initializer_list<const char*> fields) {
    for (const char* field : fields) {
        if (text(there, field) != text(here, field) || text(here, field).empty()) {
            return fmt::format("{} is \"{}\" there and \"{}\" here", field, text(there, field), text(here, field));
        }
    }
    return "";
}

// Which weights a file is of; those of Grünwald-Letnikov where it is older than the field.
std::string weights_of(const bench::Json& context) {
    return context.contains("weights") ? text(context, "weights") : "gl";
}

// visit(key, taps, row) for the rows of the question's order without a fault.
template <class Visit>
void for_each_row(const Earlier& earlier, const Question& question, Visit visit) {
    const std::string order = fmt::format("{}", question.conditions.order);
    for (const bench::Json& row : earlier.rows) {
        const auto key = bench::parse_key(row.value("name", ""));
        if (!key || key->order != order || !key->amplitude.empty() || bench::is_wrong(row) ||
            row.value("run_type", "iteration") != "iteration") {
            continue;
        }
        if (const auto taps = taps_of(*key, question.counted_order(), question.conditions.samples)) {
            visit(*key, *taps, row);
        }
    }
}

}  // namespace

std::optional<std::size_t> taps_of(const bench::RowKey& key, const CountedOrder& order, std::size_t samples) {
    const auto length = bench::parse_length(key.taps, samples);
    if (!length || length->taps > samples) {
        return std::nullopt;
    }
    if (!length->modes) {
        return length->taps;
    }
    const bench::Length written = bench::as_counted(key.kernel, *length);
    const double of_weights = bench::order_of_weights(key.kernel, order.of(key.kernel));
    const bench::Length counted = written.blocks ? bench::length_with_blocks(of_weights, written.taps, samples)
                                                 : bench::length_with_modes(key.kernel, of_weights, written.taps);
    const bool asked_for = counted.text() == written.text();
    return asked_for ? std::optional(written.taps) : std::nullopt;
}

Earlier read_earlier(const Question& question, const bench::Json& context) {
    Earlier earlier;
    if (question.results.empty()) {
        earlier.note = "no earlier measurements were asked for";
        return earlier;
    }
    const std::string name = question.results.filename().string();
    if (!question.results_asked_for && !std::filesystem::exists(question.results)) {
        earlier.note = fmt::format("{} is not there; everything is measured afresh", name);
        return earlier;
    }
    bench::Results results = bench::read_results(question.results);
    if (const std::string weights = weights_of(results.context); weights != "gl") {
        earlier.note =
            fmt::format("everything is measured afresh, not of {}: its weights are {}, not gl", name, weights);
        return earlier;
    }
    // Of a run on several machines the file has the hash of each one's firmware.
    const base::Machine* const machine = machine_of(question.target);
    const std::string own = machine == nullptr ? "" : bench::target_field("elf_sha256", *machine, false);
    const bool own_firmware =
        !text(context, "elf_sha256").empty() && text(results.context, own.c_str()) == text(context, "elf_sha256");
    const std::string firmware = own_firmware ? "" : difference(results.context, context, {"elf_sha256"});
    std::string build = difference(results.context, context, {"glsum_version", "compiler", "flags", "contraction"});
    const bool clean = text(results.context, "dirty") == "false" && text(context, "dirty") == "false";
    if (build.empty() && !firmware.empty()) {
        // Another firmware, but the same host build if it is the same commit.
        build = !clean ? "one of the two builds is of uncommitted sources"
                       : difference(results.context, context, {"commit"});
    }
    if (build.empty()) {
        build = difference(results.context, context, {"n_samples", "seed"});
    }
    if (build.empty() && question.conditions.step_s != bench::step_s) {
        build = "its records are sampled at 1 ms";
    }
    if (build.empty() && question.goal) {
        build = "its errors are of sums";
    }
    earlier.errors = build.empty();
    earlier.note = fmt::format("errors: {}", earlier.errors ? "of " + name + " where it has them"
                                                            : "measured afresh, not of " + name + ": " + build);
    if (machine != nullptr) {
        // The file may have other cores too.
        const std::string core = question.core.empty() ? "" : text(context, "core_file");
        const bool same_core = text(results.context, "core_file").find(core) != std::string::npos;
        const std::string why = !firmware.empty() ? firmware : same_core ? "" : core + " is not among its cores";
        earlier.on_target = why.empty();
        earlier.note += fmt::format("; {}: {}", core.empty() ? "instructions" : "model cycles",
                                    why.empty() ? "of " + name + " where it has them" : "measured afresh: " + why);
    }
    earlier.rows = std::move(results.rows);
    return earlier;
}

void remember(const Earlier& earlier, const Question& question, MeasuredErrors& errors) {
    if (!earlier.errors) {
        return;
    }
    for_each_row(earlier, question, [&](const bench::RowKey& key, std::size_t taps, const bench::Json& row) {
        if (const auto error = value_of(row, Counter::error_max); error && key.is_accuracy()) {
            errors.remember(key.kernel, taps, key.signal, *error);
        }
    });
}

void remember(const Earlier& earlier, const Question& question, OnTarget& costs) {
    if (!earlier.on_target) {
        return;
    }
    const Counter counter = costs.modelled() ? Counter::model_cycles_per_sample : Counter::instructions_per_sample;
    const Counter limit = costs.modelled() ? Counter::model_cycles_high : counter;
    for_each_row(earlier, question, [&](const bench::RowKey& key, std::size_t taps, const bench::Json& row) {
        const auto value = value_of(row, counter);
        const auto limited = value_of(row, limit);
        if (key.machine() != machine_of(question.target) || (costs.modelled() && key.core() != question.core) ||
            !value || !limited) {
            return;
        }
        // In software double the data decides, and with it the order at which the count was taken.
        if (costs.costly(key.kernel) && value_of(row, Counter::counted_at_order) != question.conditions.order) {
            return;
        }
        Cost cost;
        cost.value = *value;
        cost.limited = std::max(*value, *limited);
        cost.bytes =
            value_of(row, Counter::state_bytes).value_or(0.0) + value_of(row, Counter::coefficient_bytes).value_or(0.0);
        costs.remember({key.kernel, taps}, cost);
    });
}

}  // namespace choose
