#include "bench/rows/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "base/files.hpp"
#include "bench/rows/counters.hpp"
#include "glsum/catalogue.hpp"

namespace bench {
namespace {

// The next part of a path-like name, behind `prefix`; empty when it does not begin so.
std::string take(std::string& rest, const std::string& prefix) {
    if (!rest.starts_with(prefix)) {
        return "";
    }
    const std::size_t end = std::min(rest.find('/', prefix.size()), rest.size());
    std::string part = rest.substr(prefix.size(), end - prefix.size());
    rest.erase(0, std::min(end + 1, rest.size()));
    return part;
}

std::string to_name(const RowKey& key) {
    return fmt::format("gl/{}/order:{}/taps:{}/{}{}{}{}{}", key.kernel, key.order, key.taps, key.aspect,
                       key.signal.empty() ? "" : "/signal:", key.signal,
                       key.amplitude.empty() ? "" : "/amplitude:", key.amplitude);
}

// Names come from files, and go to terminals and into gnuplot's scripts: only what our own names are made of.
bool is_word(std::string_view text, std::string_view marks) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [&](char c) {
        const auto letter = static_cast<unsigned char>(c);
        return letter < 0x80 && (std::isalnum(letter) != 0 || marks.find(c) != marks.npos);
    });
}

bool is_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

// "600", "full" or "2+7".
bool is_length(std::string_view text) {
    return text == "full" || (is_word(text, "+") && text.size() <= 18 && text.front() != '+' &&
                              text.find_first_not_of("0123456789+") == text.npos);
}

bool is_ours(const RowKey& key) {
    return is_word(key.kernel, "_") && is_number(key.order) && is_length(key.taps) && is_word(key.aspect, "_:-.") &&
           (key.signal.empty() || is_word(key.signal, "_")) && (key.amplitude.empty() || is_number(key.amplitude));
}

std::optional<double> number(const Json& row, const char* counter) {
    const auto found = row.find(counter);
    return found != row.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

void keep_larger(std::optional<double>& kept, std::optional<double> value) {
    kept = !kept || (value && *value > *kept) ? value : kept;
}

// The rows of one length by kernel: one a repetition.
using Repetitions = std::map<std::string, std::vector<const Json*>>;

// Of the repetitions that count; empty without any.
std::optional<double> median(const std::vector<const Json*>& repetitions, const char* counter) {
    std::vector<double> values;
    for (const Json* row : repetitions) {
        if (const auto value = number(*row, counter); value && !row->value("error_occurred", false)) {
            values.push_back(*value);
        }
    }
    if (values.empty()) {
        return std::nullopt;
    }
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void add_row(Entry& entry, const std::string& aspect, const Json& row) {
    if (row.value("error_occurred", false)) {
        entry.fault = aspect + ": " + row.value("error_message", "wrong");
        return;
    }
    if (aspect == "accuracy") {
        keep_larger(entry.error_max, number(row, "error_max"));
        keep_larger(entry.rounding_error_max, number(row, "rounding_error_max"));
        keep_larger(entry.truncation_error_max, number(row, "truncation_error_max"));
        keep_larger(entry.effective_taps, number(row, "effective_taps"));
    } else if (aspect.starts_with("m7")) {
        entry.target_instructions = number(row, "instructions_per_sample");
        entry.target_worst = number(row, "worst_instructions");
        if (const auto cycles = number(row, "model_cycles_per_sample")) {
            entry.model_cycles[aspect.substr(aspect.find(':') + 1)] = {*cycles, number(row, "model_cycles_low"),
                                                                       number(row, "model_cycles_high")};
        }
        const glsum::CatalogueEntry* facts = glsum::find_kernel(entry.kernel);
        entry.software_double = facts != nullptr && facts->in_double;
    }
    const auto state = number(row, "state_bytes");
    const auto coefficients = number(row, "coefficient_bytes");
    if (state && coefficients && (aspect.starts_with("m7") || !entry.target_instructions)) {
        entry.bytes = *state + *coefficients;
    }
}

// Modelled cycles where there are any, of the first core by name.
std::optional<double> target_cost(const Entry& entry) {
    return entry.model_cycles.empty() ? entry.target_instructions
                                      : std::optional(entry.model_cycles.begin()->second.median);
}

// \param cost  of an entry, if it has one
template <class CostOf>
void mark_front(Group& group, CostOf cost, bool Entry::*front) {
    constexpr double same_error = 1.01;
    for (Entry& entry : group.entries) {
        const auto rankable = [&](const Entry& e) { return e.fault.empty() && e.error_max && cost(e); };
        entry.*front =
            rankable(entry) && std::none_of(group.entries.begin(), group.entries.end(), [&](const Entry& other) {
                return rankable(other) && *cost(other) < *cost(entry) &&
                       *other.error_max <= *entry.error_max * same_error;
            });
    }
}

}  // namespace

std::optional<RowKey> parse_key(const std::string& name) {
    std::string rest = name;
    RowKey key;
    if (take(rest, "gl").empty() && !rest.empty()) {
        key.kernel = take(rest, "");
        key.order = take(rest, "order:");
        key.taps = take(rest, "taps:");
        key.aspect = take(rest, "");
        key.signal = take(rest, "signal:");
        key.amplitude = take(rest, "amplitude:");
    }
    // Nothing may be left over that another row's name lacks.
    return is_ours(key) && to_name(key) == name ? std::optional(key) : std::nullopt;
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char letter : text) {
        quoted.append(letter == '"' ? 2 : 1, letter);
    }
    return quoted + '"';
}

std::optional<double> taps_number(const std::string& taps) {
    double sum = 0.0;
    const char* at = taps.data();
    const char* const end = at + taps.size();
    for (;;) {
        std::uint32_t part = 0;
        const auto [behind, error] = std::from_chars(at, end, part);
        if (error != std::errc{}) {
            return std::nullopt;
        }
        sum += part;
        if (behind == end) {
            return sum > 0.0 ? std::optional(sum) : std::nullopt;
        }
        if (*behind != '+') {
            return std::nullopt;
        }
        at = behind + 1;
    }
}

std::string to_csv(const std::vector<Json>& rows) {
    const auto has_column = [](const std::string& field) {
        static const std::set<std::string> texts_of_every_row = {"name", "run_name", "run_type", "time_unit"};
        const CounterFacts* facts = find_counter(field);
        return facts != nullptr ? facts->role != Role::index : !texts_of_every_row.contains(field);
    };
    constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();
    std::vector<std::string> columns;
    std::unordered_map<std::string, std::size_t> column_of;
    for (const Json& row : rows) {
        for (const auto& [key, value] : row.items()) {
            if (const auto [found, is_new] = column_of.try_emplace(key, no_column); is_new && has_column(key)) {
                found->second = columns.size();
                columns.push_back(key);
            }
        }
    }
    std::string text = "name,kernel,order,taps,aspect,signal,amplitude";
    for (const std::string& column : columns) {
        text += ',' + csv_field(column);
    }
    text += '\n';
    std::vector<const Json*> values;
    for (const Json& row : rows) {
        const std::string name = row.value("name", "");
        const RowKey key = parse_key(name).value_or(RowKey{});
        text += csv_field(name);
        for (const std::string* part : {&key.kernel, &key.order, &key.taps, &key.aspect, &key.signal, &key.amplitude}) {
            text += ',' + csv_field(*part);
        }
        values.assign(columns.size(), nullptr);
        for (const auto& [field, value] : row.items()) {
            if (const std::size_t column = column_of.at(field); column != no_column) {
                values[column] = &value;
            }
        }
        for (const Json* value : values) {
            text += ',';
            if (value != nullptr) {
                text += value->is_string() ? csv_field(value->get_ref<const std::string&>()) : value->dump();
            }
        }
        text += '\n';
    }
    return text;
}

void write_csv(const std::filesystem::path& path, const std::vector<Json>& rows) {
    base::write_file(path, to_csv(rows));
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
        if (key->aspect == "host") {
            host[key->taps][key->kernel].push_back(&row);
            (void)group_of(*key);
        } else {
            add_row(entry_of(group_of(*key), key->kernel), key->aspect, row);
        }
    }
    for (Group& group : groups) {
        for (const auto& [kernel, repetitions] : host[group.taps]) {
            Entry& entry = entry_of(group, kernel);
            for (const Json* row : repetitions) {
                add_row(entry, "host", *row);
            }
            entry.host_ns = median(repetitions, "real_time");
            entry.host_cycles = median(repetitions, "cycles_per_sample");
        }
        mark_front(
            group, [](const Entry& entry) { return entry.host_ns; }, &Entry::host_front);
        mark_front(group, target_cost, &Entry::target_front);
    }
    return groups;
}

}  // namespace bench
