#include "bench/gate/row_table.hpp"

#include <algorithm>

#include "bench/rows/counters.hpp"
#include "bench/rows/key.hpp"

namespace bench::gate {
namespace {

// Newer versions of Google Benchmark write a text `skipped` besides.
bool is_wrong_or_skipped(const Json& row) { return is_wrong(row) || row.contains("skipped"); }

}  // namespace

bool Measured::wrong() const {
    return std::any_of(repetitions.begin(), repetitions.end(),
                       [](const Json* row) { return is_wrong_or_skipped(*row); });
}

std::string Measured::error() const {
    for (const Json* row : repetitions) {
        if (is_wrong_or_skipped(*row)) {
            const auto message = row->find("error_message");
            return message != row->end() && message->is_string() ? message->get<std::string>() : "marked as wrong";
        }
    }
    return "";
}

std::vector<double> Measured::times() const {
    std::vector<double> times;
    for (const Json* row : repetitions) {
        if (const auto time = value_of(*row, Counter::cpu_time)) {
            times.push_back(*time);
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
    const auto key = parse_any_key(name);
    if (!key) {
        return Kind::other;
    }
    return key->is_accuracy()          ? Kind::accuracy
           : key->is_host()            ? Kind::host
           : !key->is_target()         ? Kind::other
           : key->core() == count_only ? Kind::target_count
                                       : Kind::target_model;
}

bool is_counter(const std::string& key, const Json& value) { return value.is_number() && is_measured(key); }

std::string subject_of(const std::string& name) {
    const auto key = parse_key(name);
    return key ? bench::subject_of(*key) : name;
}

std::string kernel_of(const std::string& name) {
    const auto key = parse_key(name);
    return key ? key->kernel : "";
}

std::string row_of(const std::string& kernel, const std::string& name) {
    auto key = parse_key(name);
    if (!key) {
        return name;
    }
    key->kernel = kernel;
    return to_name(*key);
}

}  // namespace bench::gate
