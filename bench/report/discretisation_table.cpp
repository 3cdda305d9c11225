#include "bench/report/discretisation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "bench/rows/key.hpp"

namespace bench {
namespace {

void add_new(std::vector<std::string>& texts, const std::string& text) {
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) {
        texts.push_back(text);
    }
}

std::string of_counter(const std::vector<Json>& rows, Counter counter, const std::string& title) {
    std::vector<std::string> orders;  // as they come
    std::vector<std::string> signals;
    std::map<std::pair<std::string, std::string>, double> errors;
    for (const Json& row : rows) {
        const auto found = value_of(row, counter);
        const auto key = parse_key(row.value("name", ""));
        if (found && key && key->amplitude.empty()) {
            add_new(orders, key->order);
            add_new(signals, key->signal);
            errors[{key->order, key->signal}] = *found;
        }
    }
    if (errors.empty()) {
        return "";
    }
    std::string text = fmt::format("\n{}\n  {:<8}", title, "order");
    for (const std::string& signal : signals) {
        text += fmt::format(" {:>9}", signal);
    }
    text += '\n';
    for (const std::string& order : orders) {
        text += fmt::format("  {:<8}", order);
        for (const std::string& signal : signals) {
            const auto error = errors.find({order, signal});
            text += fmt::format(" {:>9}", error == errors.end() ? "-" : fmt::format("{:.2e}", error->second));
        }
        text += '\n';
    }
    return text;
}

}  // namespace

std::string discretisation_table(const Json& context, const std::vector<Json>& rows) {
    // From a file a field may be anything; older files have none.
    const auto named = context.find("weights");
    const std::string weights = named == context.end() ? "gl"
                                : named->is_string()   ? named->get<std::string>()
                                                       : named->dump();
    return of_counter(rows, Counter::discretisation_error_max,
                      fmt::format("discretisation error max, weights {}: of the exact sum, by h alone", weights)) +
           of_counter(rows, Counter::discretisation_error_late_max, "the same in the second half of the record");
}

}  // namespace bench
