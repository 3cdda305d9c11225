#include "bench/rows/groups.hpp"

#include <set>
#include <unordered_map>
#include <utility>

#include "bench/rows/front.hpp"
#include "bench/rows/key.hpp"
#include "bench/rows/median.hpp"
#include "glsum/catalogue.hpp"

namespace bench {
namespace {

void keep_larger(std::optional<double>& kept, std::optional<double> value) {
    kept = !kept || (value && *value > *kept) ? value : kept;
}

// The rows of one length by kernel: one a repetition.
using Repetitions = std::map<std::string, std::vector<const Json*>>;

// Of the repetitions that count; empty without any.
std::optional<double> median(const std::vector<const Json*>& repetitions, Counter counter) {
    std::vector<double> values;
    for (const Json* row : repetitions) {
        if (const auto value = value_of(*row, counter); value && !is_wrong(*row)) {
            values.push_back(*value);
        }
    }
    return values.empty() ? std::nullopt : std::optional(median_of(std::move(values)));
}

void add_row(Entry& entry, const RowKey& key, const Json& row) {
    if (is_wrong(row)) {
        entry.fault = key.aspect + ": " + row.value("error_message", "wrong");
        return;
    }
    if (key.is_accuracy()) {
        keep_larger(entry.error_max, value_of(row, Counter::error_max));
        keep_larger(entry.rounding_error_max, value_of(row, Counter::rounding_error_max));
        keep_larger(entry.truncation_error_max, value_of(row, Counter::truncation_error_max));
        keep_larger(entry.effective_taps, value_of(row, Counter::effective_taps));
    } else if (key.is_target()) {
        const base::Machine* const machine = key.machine();
        if (entry.counted_on == nullptr || machine <= entry.counted_on) {
            entry.counted_on = machine;
            entry.target_instructions = value_of(row, Counter::instructions_per_sample);
            entry.target_worst = value_of(row, Counter::worst_instructions);
        }
        if (const auto cycles = value_of(row, Counter::model_cycles_per_sample)) {
            entry.model_cycles[key.core()] = {*cycles, value_of(row, Counter::model_cycles_low),
                                              value_of(row, Counter::model_cycles_high), machine};
        }
        const glsum::CatalogueEntry* facts = glsum::find_kernel(entry.kernel);
        entry.software_double = facts != nullptr && facts->in_double;
    }
    const auto state = value_of(row, Counter::state_bytes);
    const auto coefficients = value_of(row, Counter::coefficient_bytes);
    const bool counts = key.is_target() ? key.machine() == entry.counted_on : !entry.target_instructions;
    if (state && coefficients && counts) {
        entry.bytes = *state + *coefficients;
    }
}

// Modelled cycles where there are any, of the first core.
std::optional<double> target_cost(const Entry& entry) {
    const ModelCycles* first = nullptr;
    for (const auto& [core, cycles] : entry.model_cycles) {
        first = first == nullptr || cycles.machine < first->machine ? &cycles : first;
    }
    return first == nullptr ? entry.target_instructions : std::optional(first->median);
}

// \param cost  of an entry, if it has one
template <class CostOf>
void mark_front(Group& group, CostOf cost, bool Entry::*front) {
    std::vector<Entry*> ranked;
    std::vector<Point> points;
    for (Entry& entry : group.entries) {
        if (entry.fault.empty() && entry.error_max && cost(entry)) {
            ranked.push_back(&entry);
            points.push_back({*cost(entry), *entry.error_max});
        }
    }
    const std::vector<bool> on = on_front(points);
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        ranked[i]->*front = on[i];
    }
}

}  // namespace

std::vector<ModelledCore> modelled_cores(std::span<const Group> groups) {
    std::set<std::pair<const base::Machine*, std::string>> found;
    for (const Group& group : groups) {
        for (const Entry& entry : group.entries) {
            for (const auto& [core, cycles] : entry.model_cycles) {
                found.emplace(cycles.machine, core);
            }
        }
    }
    std::vector<ModelledCore> cores;
    for (const auto& [machine, core] : found) {
        cores.push_back({machine, core});
    }
    return cores;
}

const base::Machine* counted_on(std::span<const Group> groups) {
    const base::Machine* first = nullptr;
    for (const Group& group : groups) {
        for (const Entry& entry : group.entries) {
            if (entry.counted_on != nullptr && (first == nullptr || entry.counted_on < first)) {
                first = entry.counted_on;
            }
        }
    }
    return first;
}

std::vector<Group> group(const std::vector<Json>& rows) {
    std::vector<Group> groups;
    std::unordered_map<std::string, std::size_t> group_at;  // by order and length
    std::unordered_map<std::string, std::size_t> entry_at;  // by those and kernel
    const auto group_of = [&](const RowKey& key) -> Group& {
        const auto [found, is_new] = group_at.try_emplace(key.order + '/' + key.taps, groups.size());
        if (is_new) {
            groups.push_back({key.order, key.taps, {}});
        }
        return groups[found->second];
    };
    const auto entry_of = [&](Group& group, const std::string& kernel) -> Entry& {
        const auto [found, is_new] =
            entry_at.try_emplace(group.order + '/' + group.taps + '/' + kernel, group.entries.size());
        if (is_new) {
            group.entries.emplace_back().kernel = kernel;
        }
        return group.entries[found->second];
    };
    std::unordered_map<std::string, Repetitions> host;  // by length: one order serves all
    for (const Json& row : rows) {
        const auto key = parse_key(row.value("name", ""));
        // The amplitude sweep is another question: tables and fronts are of full scale.
        if (!key || !key->amplitude.empty() || row.value("run_type", "iteration") != "iteration") {
            continue;
        }
        if (key->is_host()) {
            host[key->taps][key->kernel].push_back(&row);
            (void)group_of(*key);
        } else {
            add_row(entry_of(group_of(*key), key->kernel), *key, row);
        }
    }
    RowKey host_key;
    host_key.aspect = RowKey::host;
    for (Group& group : groups) {
        for (const auto& [kernel, repetitions] : host[group.taps]) {
            Entry& entry = entry_of(group, kernel);
            for (const Json* row : repetitions) {
                add_row(entry, host_key, *row);
            }
            entry.host_ns = median(repetitions, Counter::real_time);
            entry.host_cycles = median(repetitions, Counter::cycles_per_sample);
        }
        mark_front(
            group, [](const Entry& entry) { return entry.host_ns; }, &Entry::host_front);
        mark_front(group, target_cost, &Entry::target_front);
    }
    return groups;
}

}  // namespace bench
