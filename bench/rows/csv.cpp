#include "bench/rows/csv.hpp"

#include <limits>
#include <set>
#include <unordered_map>

#include "base/files.hpp"
#include "bench/rows/counters.hpp"
#include "bench/rows/key.hpp"

namespace bench {

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

std::string to_tidy_csv(const std::vector<Json>& rows) {
    std::string text = "kernel,order,taps,target,signal,amplitude,repetition,counter,value,unit\n";
    for (const Json& row : rows) {
        const auto key = parse_key(row.value("name", ""));
        if (!key || is_wrong(row) || row.value("run_type", "iteration") != "iteration") {
            continue;
        }
        std::string subject;
        for (const std::string* part : {&key->kernel, &key->order, &key->taps, &key->aspect, &key->signal}) {
            subject += csv_field(*part) + ',';
        }
        subject += csv_field(key->amplitude) + ',' + std::to_string(row.value("repetition_index", 0)) + ',';
        for (const auto& [field, value] : row.items()) {
            const CounterFacts* facts = find_counter(field);
            const bool is_number = value.is_number() && facts != nullptr;
            // Of accuracy no time was taken: what Google Benchmark's tools expect there is a 0.
            if (is_number && (facts->role == Role::counter || (facts->role == Role::time && key->is_host()))) {
                text +=
                    subject + csv_field(field) + ',' + value.dump() + ',' + csv_field(std::string(facts->unit)) + '\n';
            }
        }
    }
    return text;
}

void write_tidy_csv(const std::filesystem::path& path, const std::vector<Json>& rows) {
    base::write_file(path, to_tidy_csv(rows));
}

}  // namespace bench
