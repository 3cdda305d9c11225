// What an exam asks: logs of rigs by their paths, how to read them, and which base to judge.
//
//   {"schema": "glsum-exam-1", "questions": [
//     {"name": "heater", "train": ["heater.csv"], "validate": [], "split_s": 300, "base": "fit", "domain": "thermal",
//      "metric": "simulation", "refit": false, "time_column": "time_s", "input_columns": ["input"],
//      "output_column": "output", "units": {"input": "W", "output": "K"}}]}
//
// `name`, `train` and `base` are needed; without `validate` there is `split_s` or parts of the logs are kept aside.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drive/log.hpp"
#include "gap/drive/question.hpp"

namespace gap::exam {

/// Bounds of what is read, of a manifest and of a truth alike.
struct Limits {
    static constexpr std::size_t bytes = 4u << 20;
    static constexpr std::size_t questions = 1000;
    static constexpr std::size_t list = 64;   ///< logs, input columns, causes, alternatives
    static constexpr std::size_t text = 512;  ///< of a path, a column, a unit
    static constexpr std::size_t name = 64;
};

/// One question as it is written down.
struct Asked {
    std::string name;                   ///< small letters, digits, `_` and `-`: a folder is called so
    std::vector<std::string> train;     ///< paths below the folder of the data
    std::vector<std::string> validate;  ///< likewise; empty: the split's other part, or what is kept aside
    std::optional<double> split_s;      ///< s, above 0
    drive::Columns columns;
    std::string base;                          ///< `fit`, `fit:FORM` or the path of a model's file
    std::string domain;                        ///< mechanical, thermal, hydraulic, electric; empty: not said
    std::map<std::string, std::string> units;  ///< by column
    std::optional<Metric> metric;              ///< not said: simulation, unless a base is found that integrates
    bool refit = false;
    [[nodiscard]] bool is_fitted() const { return base == "fit" || base.starts_with("fit:"); }
};

/// \throws glsum::Failure (bad input) naming the file, the line or the question, what was expected and what was found.
[[nodiscard]] std::vector<Asked> parse_manifest(const std::string& text, const std::string& name);

}  // namespace gap::exam
