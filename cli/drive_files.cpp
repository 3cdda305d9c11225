#include "cli/drive_files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "base/files.hpp"
#include "drive/model_file.hpp"
#include "drive/stability.hpp"

namespace cli {
namespace {

constexpr const char* time_column = "Column of the stamps, by name or number; usually time_s";
constexpr const char* input_column = "Column of the input; usually input or duty";

void add_other_column_options(Command& command, drive::Columns& columns) {
    command.add_option("--output-column", columns.output,
                       "Column of the output; usually output, y, angle_rad or counts");
    command.add_option("--counts-per-unit", columns.counts_per_unit,
                       "Divide the output by this: encoder counts to units");
    command
        .add_option("--counter-bits", columns.counter_bits, "Counts come from a counter of so many bits, which wraps")
        .between(2, 52);
    command.add_option("--separator", columns.separator, "Of a log's fields; without it, as the file shows")
        .one_of({"comma", "semicolon", "tab", "blank"});
    command.add_option("--decimal", columns.decimal, "Decimal mark of a log; without it, as the file shows")
        .one_of({"point", "comma"});
    command
        .add_option("--time-unit", columns.time_unit,
                    "Of the stamps; without it, as their name or a row of units says, else s")
        .one_of({"ns", "us", "ms", "s", "min", "h"});
}

}  // namespace

drive::Model read_model(const std::filesystem::path& path) {
    return drive::parse_model(base::read_file(path, drive::most_model_bytes), path.string());
}

drive::Log read_log(const std::filesystem::path& path, const drive::Columns& columns) {
    drive::Log log = drive::parse_log(base::read_file(path, drive::LogLimits::bytes), path.string(), columns);
    for (const std::string& warning : log.warnings) {
        fmt::print(stderr, "glsum: warning: {}\n", warning);
    }
    return log;
}

drive::Log read_ordered_log(const std::filesystem::path& path, const drive::Columns& columns) {
    drive::Log log = read_log(path, columns);
    const drive::StampReport report = drive::order_stamps(log);
    if (!report.clean()) {
        fmt::print(stderr, "glsum: warning: {}: {}\n", log.name, report.text());
    }
    return log;
}

std::vector<gap::Record> read_records(const std::vector<std::filesystem::path>& paths, const drive::Columns& columns) {
    std::vector<gap::Record> records;
    for (const auto& path : paths) {
        records.push_back(gap::to_record(read_ordered_log(path, columns)));
    }
    return records;
}

void warn_if_unstable(const drive::Model& model, const std::string& name) {
    const int growing = drive::zeros_right_of_axis(model.denominator);
    if (growing > 0) {
        fmt::print(stderr, "glsum: warning: {}: unstable: {} poles with a positive real part, its response grows\n",
                   name, growing);
    }
}

gap::Improved simulate_effects(const drive::Model& model, const drive::Log& log, const std::string& name) {
    gap::Record record{log.name, log.time_s, log.input, {}, 0.0, log.more_inputs};
    record.usual_interval_s = (log.time_s.back() - log.time_s.front()) / static_cast<double>(log.time_s.size() - 1);
    return gap::simulate_improved(model, std::move(record), name);
}

void add_column_options(Command& command, drive::Columns& columns) {
    command.add_option("--time-column", columns.time, time_column);
    command.add_option("--input-column", columns.input, input_column);
    add_other_column_options(command, columns);
}

void add_diagnosis_column_options(Command& command, drive::Columns& columns) {
    command.add_option("--time-column", columns.time, time_column);
    auto inputs = std::make_shared<std::vector<std::string>>();
    command
        .add_option("--input-column", *inputs,
                    fmt::format("{}; repeatable: the first is the base's, others come beside it", input_column))
        .each([&columns, inputs](const std::string& name) {
            if (columns.input.empty()) {
                columns.input = name;
            } else {
                columns.more_inputs.push_back(name);
            }
        });
    command.add_option("--simulated", columns.simulated,
                       "Column of what your own simulator gave for the same input, in the output's units");
    add_other_column_options(command, columns);
}

void put(const std::string& text, const std::filesystem::path& path) {
    if (path.empty()) {
        std::fputs(text.c_str(), stdout);
    } else {
        base::write_file(path, text);
    }
}

void put_either(const Output& json, const std::function<std::string()>& as_json,
                const std::function<std::string()>& as_text, const std::filesystem::path& out) {
    if (json.wanted()) {
        json.or_to(out).write(as_json());
    }
    if (!json.to_stdout()) {
        put(as_text(), out);
    }
}

}  // namespace cli
