#include "drive/log_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "base/nearest_name.hpp"
#include "drive/decimals.hpp"
#include "drive/refusal.hpp"
#include "drive/stamps.hpp"
#include "drive/time_unit.hpp"

namespace drive {
namespace {

constexpr std::size_t none = LogColumns::none;

// A column that a log may have.
struct Role {
    const char* what;
    const char* option;
    std::vector<std::string_view> names;  ///< one of them wins over all other names
    std::vector<std::string_view> also;   ///< what loggers usually write, in small letters
    std::size_t number;                   ///< without a header; from 0
};

const Role time_role{"time", "--time-column", {"time_s"}, {"time", "t", "timestamp", "datetime"}, 0};
const Role input_role{"input", "--input-column", {"input", "duty"}, {"u", "cmd", "command", "pwm"}, 1};
const Role output_role{
    "output", "--output-column", {"output", "y", "angle_rad", "counts"}, {"measured", "measurement"}, 2};
const Role reference_role{"reference", "--reference-column", {"reference"}, {}, none};
const Role simulated_role{"simulation", "--simulated", {}, {}, none};

// Single letters as they are: T may be a temperature.
bool is_one_of(const std::string& name, const std::vector<std::string_view>& words) {
    const std::string small = name.size() > 1 ? lower(name) : name;
    return std::find(words.begin(), words.end(), small) != words.end();
}

// Whether a logger means this role by the name: one of its words in any case, with a unit or without. A unit of time in
// full, such as millis, names the time.
bool is_usual(const std::string& name, const Role& role) {
    if (&role == &time_role) {
        const TimeName parts = split_time_unit(name);
        return (parts.base.empty() && parts.unit && name.size() > 3) || is_one_of(parts.base, role.also);
    }
    const std::string base = split_unit(name).base;
    return is_one_of(base, role.also) || is_one_of(base, role.names);
}

// Names by how many letters they are away, for a message.
std::vector<std::string> nearest_to(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t longest = 40;
    constexpr std::size_t most = 256;
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& name : names) {
        if (name.empty() || name.size() > longest || near.size() == most) {
            continue;
        }
        const std::size_t letters = base::letters_between(lower(word.substr(0, longest)), lower(name));
        const bool contains = lower(name).find(lower(word)) != std::string::npos;
        if (contains || 2 * letters <= std::max(word.size(), name.size())) {
            near.emplace_back(letters, name);
        }
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> nearest;
    for (std::size_t i = 0; i < near.size() && i < 3; ++i) {
        nearest.push_back(shown(near[i].second));
    }
    return nearest;
}

class Search {
public:
    explicit Search(const LogHeader& header) : header_(header) {}

    [[nodiscard]] std::vector<std::size_t> by_name(const Role& role) const {
        return matching([&](const std::string& name) {
            return std::find(role.names.begin(), role.names.end(), name) != role.names.end();
        });
    }
    [[nodiscard]] std::vector<std::size_t> by_usual_name(const Role& role) const {
        return matching([&](const std::string& name) { return is_usual(name, role); });
    }
    /// Whether a column would be found without an option.
    [[nodiscard]] bool has(const Role& role) const {
        return header_.is_written ? !by_name(role).empty() || !by_usual_name(role).empty()
                                  : role.number < header_.names.size();
    }

    /// The column that an option names; by its number, where none is called so.
    [[nodiscard]] std::size_t given(const Role& role, const std::string& name) const {
        const auto called = matching([&](const std::string& other) { return other == name; });
        if (!called.empty()) {
            return only(role, called);
        }
        std::size_t number = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
        const bool is_number = error == std::errc{} && end == name.data() + name.size();
        if (is_number && number >= 1 && number <= header_.names.size()) {
            return number - 1;
        }
        if (!header_.is_written) {
            refuse(fmt::format("{}: expected a column {} for the {}; the log has no header, its columns are 1 to {}",
                               header_.place, name, role.what, header_.names.size()));
        }
        const auto nearest = nearest_to(name, header_.names);
        refuse(fmt::format("{}: expected a column {} for the {}, found {}{}", header_.place, name, role.what, all(),
                           nearest.empty() ? "" : fmt::format("; nearest: {}", fmt::join(nearest, ", "))));
    }

    /// The column that is meant where no option names it.
    [[nodiscard]] std::size_t usual(const Role& role, std::size_t number, std::vector<std::string>& found) const {
        if (!header_.is_written) {
            if (number >= header_.names.size()) {
                refuse(
                    fmt::format("{}: expected a header such as time_s,input,output or a column {} for the {}, found "
                                "{} columns without a header; {} N names one by its number",
                                header_.place, number + 1, role.what, header_.names.size(), role.option));
            }
            found.push_back(fmt::format("column {} as {}", number + 1, role.what));
            return number;
        }
        if (const auto called = by_name(role); !called.empty()) {
            return only(role, called);
        }
        const auto called = by_usual_name(role);
        if (called.empty()) {
            std::vector<std::string> nearest;
            for (const std::string_view name : role.names) {
                for (std::string& other : nearest_to(std::string(name), header_.names)) {
                    if (std::find(nearest.begin(), nearest.end(), other) == nearest.end()) {
                        nearest.push_back(std::move(other));
                    }
                }
            }
            refuse(fmt::format("{}: expected a column {} for the {}, found {}{}; {} names another", header_.place,
                               fmt::join(role.names, ", "), role.what, all(),
                               nearest.empty() ? "" : fmt::format("; nearest: {}", fmt::join(nearest, ", ")),
                               role.option));
        }
        found.push_back(fmt::format("{} as {}", shown(header_.names[only(role, called)]), role.what));
        return called.front();
    }

private:
    template <class Holds>
    [[nodiscard]] std::vector<std::size_t> matching(Holds holds) const {
        std::vector<std::size_t> columns;
        for (std::size_t i = 0; header_.is_written && i < header_.names.size(); ++i) {
            if (holds(header_.names[i])) {
                columns.push_back(i);
            }
        }
        return columns;
    }
    [[nodiscard]] std::size_t only(const Role& role, const std::vector<std::size_t>& columns) const {
        if (columns.size() > 1) {
            refuse(fmt::format("{}: expected one column for the {}, found {} and {}: name one by {}", header_.place,
                               role.what, header_.names[columns[0]], header_.names[columns[1]], role.option));
        }
        return columns.front();
    }
    [[nodiscard]] std::string all() const { return shown(fmt::format("{}", fmt::join(header_.names, ","))); }

    const LogHeader& header_;
};

void refuse_twice(const LogHeader& header, const LogColumns& columns) {
    std::vector<std::pair<std::size_t, const Role*>> taken = {{columns.time, &time_role},
                                                              {columns.input, &input_role},
                                                              {columns.output, &output_role},
                                                              {columns.reference, &reference_role},
                                                              {columns.simulated, &simulated_role}};
    for (const std::size_t input : columns.more_inputs) {
        taken.emplace_back(input, &input_role);
    }
    for (std::size_t i = 0; i < taken.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (taken[i].first == taken[j].first && taken[i].first != none) {
                refuse(fmt::format(
                    "{}: expected different columns for the {} and {} {}, found {} for both; {} names "
                    "another",
                    header.place, taken[j].second->what, taken[j].second == taken[i].second ? "another" : "the",
                    taken[i].second->what, header.names[taken[i].first], taken[i].second->option));
            }
        }
    }
}

// Units that stand below a header, beside those of time. A dash is none: it may be a value that is missing.
bool is_known_unit(std::string_view word) {
    static constexpr std::string_view units[] = {
        "V",    "mV",  "A",    "mA",   "W",     "kW",    "mm",    "cm",  "m",      "um",    "km",  "rad",
        "mrad", "deg", "°",    "°C",   "degC",  "degF",  "C",     "K",   "rpm",    "1/min", "1/s", "Hz",
        "kHz",  "Pa",  "kPa",  "bar",  "mbar",  "N",     "mN",    "Nm",  "kg",     "g",     "l",   "l/min",
        "%",    "m/s", "mm/s", "m/s2", "m/s^2", "rad/s", "deg/s", "°/s", "counts", "ticks"};
    return std::find(std::begin(units), std::end(units), word) != std::end(units) || time_unit_of(word).has_value();
}

bool is_bracketed(std::string_view word) {
    return word.size() > 2 &&
           ((word.front() == '[' && word.back() == ']') || (word.front() == '(' && word.back() == ')'));
}

}  // namespace

LogHeader header_of(const std::vector<Field>& first_line, const std::string& place) {
    LogHeader header;
    header.place = place;
    header.is_written = !looks_like_number(first_line.front().text) && !looks_like_date(first_line.front().text);
    for (const Field& field : first_line) {
        header.names.push_back(header.is_written ? text_of(field) : fmt::format("{}", header.names.size() + 1));
    }
    return header;
}

LogColumns find_columns(const LogHeader& header, const Columns& asked) {
    const Search search(header);
    LogColumns columns;
    const auto find = [&](const Role& role, const std::string& name, std::size_t number) {
        return name.empty() ? search.usual(role, number, columns.found) : search.given(role, name);
    };
    columns.time = find(time_role, asked.time, time_role.number);
    const bool has_reference = asked.takes_reference && (!asked.reference.empty() || search.has(reference_role));
    if (has_reference) {
        columns.reference = find(reference_role, asked.reference, reference_role.number);
    }
    // Two columns without a header, and no input needed: time and output.
    const bool input_is_left_out = !header.is_written && header.names.size() == 2;
    if ((asked.needs_input && !has_reference) || !asked.input.empty() ||
        (search.has(input_role) && !input_is_left_out)) {
        columns.input = find(input_role, asked.input, input_role.number);
    }
    if (asked.needs_output || !asked.output.empty()) {
        columns.output = find(output_role, asked.output, columns.input == none ? 1 : output_role.number);
    }
    for (const std::string& name : asked.more_inputs) {
        columns.more_inputs.push_back(search.given(input_role, name));
    }
    if (!asked.simulated.empty()) {
        columns.simulated = search.given(simulated_role, asked.simulated);
    }
    refuse_twice(header, columns);
    return columns;
}

bool is_row_of_units(const std::vector<Field>& fields, std::size_t time) {
    if (time_unit_of(fields[time].text)) {
        return true;
    }
    bool any_known = false;
    for (const Field& field : fields) {
        if (looks_like_number(field.text) || looks_like_date(field.text)) {
            return false;
        }
        any_known = any_known || is_known_unit(field.text) || is_bracketed(field.text);
    }
    return any_known;
}

}  // namespace drive
