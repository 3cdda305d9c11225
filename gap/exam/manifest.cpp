#include "gap/exam/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "gap/exam/fields.hpp"

namespace gap::exam {
namespace {

// Below the folder of the data: what a manifest from elsewhere names is no other file of this machine.
void check_paths(const Fields& fields, const char* key, const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
        if (normal.is_absolute() || *normal.begin() == "..") {
            fields.refuse(key, "paths below the folder of the data", path);
        }
    }
}

drive::Columns take_columns(Fields& fields) {
    drive::Columns columns;
    columns.time = fields.text_or("time_column", "");
    columns.output = fields.text_or("output_column", "");
    std::vector<std::string> inputs = fields.texts("input_columns", 0);
    if (!inputs.empty()) {
        columns.input = inputs.front();
        columns.more_inputs.assign(inputs.begin() + 1, inputs.end());
    }
    return columns;
}

std::map<std::string, std::string> take_units(Fields& fields) {
    std::map<std::string, std::string> units;
    if (fields.has("units")) {
        const nlohmann::ordered_json object = fields.take("units");
        Fields own(object, fields.name() + ": units");
        for (const auto& [column, unit] : object.items()) {
            units[column] = own.text(column.c_str());
        }
        if (units.size() > Limits::list) {
            fields.refuse("units", fmt::format("at most {}", Limits::list), fmt::format("{}", units.size()));
        }
    }
    return units;
}

Asked to_asked(Fields fields) {
    Asked asked;
    asked.name = fields.text("name");
    asked.train = fields.texts("train", 1);
    asked.validate = fields.texts("validate", 0);
    check_paths(fields, "train", asked.train);
    check_paths(fields, "validate", asked.validate);
    for (const std::string& path : asked.validate) {
        if (std::find(asked.train.begin(), asked.train.end(), path) != asked.train.end()) {
            fields.refuse("validate", "logs that are not fitted", path);
        }
    }
    asked.split_s = fields.positive("split_s");
    if (asked.split_s && !asked.validate.empty()) {
        fields.refuse("split_s", "it or validate", "both");
    }
    asked.columns = take_columns(fields);
    asked.base = fields.text("base");
    if (!asked.is_fitted()) {
        check_paths(fields, "base", {asked.base});
    }
    asked.domain = fields.has("domain") ? fields.one_of("domain", {"mechanical", "thermal", "hydraulic", "electric"})
                                        : std::string();
    asked.units = take_units(fields);
    if (fields.has("metric")) {
        asked.metric = fields.one_of("metric", {"simulation", "prediction"}) == "prediction" ? Metric::prediction
                                                                                             : Metric::simulation;
    }
    asked.refit = fields.flag_or("refit", false);
    fields.refuse_rest(
        "name, train, validate, split_s, base, domain, metric, refit, time_column, input_columns, output_column and "
        "units");
    return asked;
}

}  // namespace

std::vector<Asked> parse_manifest(const std::string& text, const std::string& name) {
    std::vector<Asked> all;
    for (Fields& question : questions_in(text, name, "glsum-exam-1")) {
        all.push_back(to_asked(std::move(question)));
    }
    return all;
}

}  // namespace gap::exam
