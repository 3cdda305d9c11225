#include "bench/gate/row_table.hpp"

#include <algorithm>

#include "bench/rows/counters.hpp"
#include "bench/rows/results.hpp"

namespace bench::gate {
namespace {

bool is_wrong(const Json& row) {
    const auto error = row.find("error_occurred");
    // Newer versions of Google Benchmark write a text `skipped` besides.
    return (error != row.end() && error->is_boolean() && error->get<bool>()) || row.contains("skipped");
}

}  // namespace

bool Measured::wrong() const {
    return std::any_of(repetitions.begin(), repetitions.end(), [](const Json* row) { return is_wrong(*row); });
}

std::string Measured::error() const {
    for (const Json* row : repetitions) {
        if (is_wrong(*row)) {
            const auto message = row->find("error_message");
            return message != row->end() && message->is_string() ? message->get<std::string>() : "marked as wrong";
        }
    }
    return "";
}

std::vector<double> Measured::times() const {
    std::vector<double> times;
    for (const Json* row : repetitions) {
        if (const auto time = row->find("cpu_time"); time != row->end() && time->is_number()) {
            times.push_back(time->get<double>());
        }
    }
    return times;
}

RowTable::RowTable(const Results& results) {
    rows_.reserve(results.rows.size());
    for (const Json& row : results.rows) {
        const auto type = row.find("run_type");
        if (type != row.end() && *type != "iteration") {
            continue;
        }
        const auto& name = row["name"].get_ref<const std::string&>();
        Measured& measured = rows_[name];
        if (measured.repetitions.empty()) {
            names_.push_back(name);
        }
        measured.repetitions.push_back(&row);
    }
}

const Measured* RowTable::find(const std::string& name) const {
    const auto found = rows_.find(name);
    return found == rows_.end() ? nullptr : &found->second;
}

Kind kind_of(const std::string& name) {
    if (name.find("/accuracy/") != std::string::npos) {
        return Kind::accuracy;
    }
    if (name.ends_with("/host")) {
        return Kind::host;
    }
    if (name.ends_with("/m7:count")) {
        return Kind::target_count;
    }
    return name.find("/m7:") != std::string::npos ? Kind::target_model : Kind::other;
}

bool is_counter(const std::string& key, const Json& value) {
    return value.is_number() && is_measured(key);
}

std::string subject_of(const std::string& name) {
    const auto key = parse_key(name);
    return key ? "gl/" + key->kernel + "/order:" + key->order + "/taps:" + key->taps : name;
}

std::string kernel_of(const std::string& name) {
    const auto key = parse_key(name);
    return key ? key->kernel : "";
}

}  // namespace bench::gate
