#include "drive/time_unit.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "drive/csv_lines.hpp"

namespace drive {
namespace {

struct Named {
    TimeUnit unit;
    std::vector<std::string_view> words;
};

const std::array<Named, 6>& named_units() {
    // The micro sign has two places in Unicode, and one in Latin-1.
    static const std::array<Named, 6> units = {{
        {{"ns", "nanoseconds", 1.0, 1e9}, {"ns", "nsec", "nanos", "nanoseconds"}},
        {{"us", "microseconds", 1.0, 1e6}, {"us", "usec", "micros", "microseconds", "\xC2\xB5s", "\xCE\xBCs", "\xB5s"}},
        {{"ms", "milliseconds", 1.0, 1e3}, {"ms", "msec", "millis", "milliseconds"}},
        {{"s", "seconds", 1.0, 1.0}, {"s", "sec", "secs", "seconds"}},
        {{"min", "minutes", 60.0, 1.0}, {"min", "minutes"}},
        {{"h", "hours", 3600.0, 1.0}, {"h", "hours"}},
    }};
    return units;
}

std::string_view without_brackets(std::string_view word) {
    const bool has_brackets =
        !word.empty() && ((word.front() == '[' && word.back() == ']') || (word.front() == '(' && word.back() == ')'));
    return has_brackets ? trimmed(word.substr(1, word.size() - 2)) : word;
}

}  // namespace

std::string lower(std::string_view text) {
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return small;
}

std::optional<TimeUnit> time_unit_of(std::string_view word) {
    const std::string small = lower(without_brackets(trimmed(word)));
    for (const Named& named : named_units()) {
        if (std::find(named.words.begin(), named.words.end(), small) != named.words.end()) {
            return named.unit;
        }
    }
    return std::nullopt;
}

NameWithUnit split_unit(std::string_view name) {
    for (const auto& [opening, closing] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        const auto at = name.rfind(opening);
        if (at != std::string_view::npos && at > 0 && name.back() == closing) {
            return {std::string(trimmed(name.substr(0, at))),
                    std::string(trimmed(name.substr(at + 1, name.size() - at - 2)))};
        }
    }
    return {std::string(name), {}};
}

TimeName split_time_unit(std::string_view name) {
    const NameWithUnit brackets = split_unit(name);
    if (const auto unit = time_unit_of(brackets.unit)) {
        return {brackets.base, unit};
    }
    if (const auto unit = time_unit_of(name)) {
        return {{}, unit};
    }
    const auto at = name.find_last_of("_/ ");
    if (at != std::string_view::npos && at > 0) {
        if (const auto unit = time_unit_of(name.substr(at + 1))) {
            const auto last = name.find_last_not_of("_/ ", at);
            return {std::string(last == std::string_view::npos ? std::string_view() : name.substr(0, last + 1)), unit};
        }
    }
    return {brackets.base, std::nullopt};
}

}  // namespace drive
