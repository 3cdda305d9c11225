#include "bench/gate/rules.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/glob.hpp"

namespace bench::gate {
namespace {

constexpr std::size_t file_limit = 1 << 20;
constexpr std::size_t rule_limit = 1000;
constexpr std::string_view keys[] = {"layer", "rows",   "counters", "better",    "relative",  "absolute",
                                     "level", "reason", "anchor",   "witnesses", "confidence"};

// One thresholds file while it is read: messages name its place.
class Reader {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    [[noreturn]] void refuse(const toml::source_region& at, const std::string& what) const {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}:{}:{}: {}", name_, at.begin.line, at.begin.column, what));
    }

    Rule rule(const toml::table& table) const {
        for (const auto& [key, value] : table) {
            if (std::find(std::begin(keys), std::end(keys), key.str()) == std::end(keys)) {
                refuse(key.source(), fmt::format("expected one of {}, found the key {}", fmt::join(keys, ", "),
                                                 std::string_view(key.str())));
            }
        }
        Rule rule;
        rule.line = table.source().begin.line;
        rule.layer = one_of<Layer>(table, "layer",
                                   {{name_of(Layer::accuracy), Layer::accuracy},
                                    {name_of(Layer::instructions_and_bytes), Layer::instructions_and_bytes},
                                    {name_of(Layer::model_cycles), Layer::model_cycles},
                                    {name_of(Layer::host_time), Layer::host_time}});
        rule.rows = globs(table, "rows");
        rule.counters = globs(table, "counters");
        rule.better = one_of<Better>(table, "better",
                                     {{"lower", Better::lower}, {"higher", Better::higher}, {"equal", Better::equal}});
        rule.fails = one_of<bool>(table, "level", {{"fail", true}, {"warn", false}});
        rule.reason = text(table, "reason");
        const auto relative = number(table, "relative");
        const auto absolute = number(table, "absolute");
        if (!relative && !absolute) {
            refuse(table.source(), "expected relative, absolute or both in this rule: 0 allows no change");
        }
        rule.relative = relative.value_or(0.0);
        rule.absolute = absolute.value_or(0.0);
        host_time(table, rule);
        return rule;
    }

private:
    const toml::node& need(const toml::table& table, std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node == nullptr) {
            refuse(table.source(), fmt::format("expected the key {} in this rule", key));
        }
        return *node;
    }

    std::string text(const toml::table& table, std::string_view key) const {
        const toml::node& node = need(table, key);
        const auto value = node.value_exact<std::string>();
        if (!value || value->find_first_not_of(" \t\r\n") == std::string::npos) {
            refuse(node.source(), fmt::format("{}: expected a text that is not empty", key));
        }
        return *value;
    }

    template <class Value>
    Value one_of(const toml::table& table, std::string_view key,
                 std::initializer_list<std::pair<std::string_view, Value>> choices) const {
        const std::string found = text(table, key);
        std::vector<std::string_view> names;
        for (const auto& [name, value] : choices) {
            if (name == found) {
                return value;
            }
            names.push_back(name);
        }
        refuse(need(table, key).source(),
               fmt::format("{}: expected one of {}, found {}", key, fmt::join(names, ", "), found));
    }

    // A glob or a list of them.
    std::vector<std::string> globs(const toml::table& table, std::string_view key) const {
        const toml::node& node = need(table, key);
        const toml::array* array = node.as_array();
        if (array == nullptr) {
            return {text(table, key)};
        }
        std::vector<std::string> found;
        for (const toml::node& element : *array) {
            const auto value = element.value_exact<std::string>();
            if (!value || value->empty()) {
                refuse(element.source(), fmt::format("{}: expected a text that is not empty", key));
            }
            found.push_back(*value);
        }
        if (found.empty()) {
            refuse(node.source(), fmt::format("{}: expected at least one glob, found none", key));
        }
        return found;
    }

    std::optional<double> number(const toml::table& table, std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node == nullptr) {
            return std::nullopt;
        }
        const auto value = node->value<double>();
        if (!node->is_number() || !value || !std::isfinite(*value) || *value < 0.0) {
            refuse(node->source(), fmt::format("{}: expected a finite number of at least 0", key));
        }
        return value;
    }

    void host_time(const toml::table& table, Rule& rule) const {
        if (rule.layer != Layer::host_time) {
            for (const std::string_view key : {"anchor", "witnesses", "confidence"}) {
                if (const toml::node* node = table.get(key)) {
                    refuse(node->source(), fmt::format("{}: only rules of the layer host_time have it", key));
                }
            }
            return;
        }
        if (const toml::node* node = table.get("absolute")) {
            refuse(node->source(), "absolute: times of two runs are only compared as ratios; expected relative");
        }
        if (rule.better != Better::lower) {
            refuse(need(table, "better").source(), "better: expected lower for times");
        }
        rule.anchor = text(table, "anchor");
        if (table.contains("witnesses")) {
            rule.witnesses = globs(table, "witnesses");
        }
        if (const auto confidence = number(table, "confidence")) {
            if (*confidence < 0.5 || *confidence > 0.9999) {
                refuse(need(table, "confidence").source(), "confidence: expected a number from 0.5 to 0.9999");
            }
            rule.confidence = *confidence;
        }
    }

    std::string name_;
};

}  // namespace

std::string_view name_of(Layer layer) {
    switch (layer) {
        case Layer::rows:
            return "rows";
        case Layer::answer:
            return "right_answer";
        case Layer::accuracy:
            return "accuracy";
        case Layer::instructions_and_bytes:
            return "instructions_and_bytes";
        case Layer::model_cycles:
            return "model_cycles";
        case Layer::host_time:
            return "host_time";
    }
    return "";
}

bool Rule::wants_row(const std::string& name) const { return base::matches_any(rows, name); }

bool Rule::wants_counter(const std::string& name) const { return base::matches_any(counters, name); }

double Rule::allowed(double baseline) const { return std::max(absolute, relative * std::fabs(baseline)); }

double Rule::excess(double baseline, double current) const {
    const double change = current - baseline;
    switch (better) {
        case Better::lower:
            return change - allowed(baseline);
        case Better::higher:
            return -change - allowed(baseline);
        case Better::equal:
            return std::fabs(change) - allowed(baseline);
        case Better::neither:
            break;
    }
    return 0.0;
}

Rules parse_rules(std::string_view text, const std::string& name) {
    const Reader reader(name);
    toml::table file;
    try {
        file = toml::parse(text);
    } catch (const toml::parse_error& error) {
        reader.refuse(error.source(), std::string(error.description()));
    }
    Rules rules;
    for (const auto& [key, value] : file) {
        const toml::array* array = value.as_array();
        if (key.str() != "rule" || array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
            reader.refuse(key.source(),
                          fmt::format("expected rules, [[rule]], found the key {}", std::string_view(key.str())));
        }
        if (array->size() > rule_limit) {
            reader.refuse(key.source(), fmt::format("expected at most {} rules", rule_limit));
        }
        for (const toml::node& element : *array) {
            rules.push_back(reader.rule(*element.as_table()));
        }
    }
    if (rules.empty()) {
        reader.refuse(file.source(), "expected at least one [[rule]], found none");
    }
    return rules;
}

Rules read_rules(const std::filesystem::path& path) {
    return parse_rules(base::read_file(path, file_limit), path.string());
}

std::optional<Better> better_of(const Rules& rules, const std::string& row, const std::string& counter) {
    for (const Rule& rule : rules) {
        if (rule.wants_counter(counter) && rule.wants_row(row)) {
            return rule.better;
        }
    }
    return std::nullopt;
}

}  // namespace bench::gate
