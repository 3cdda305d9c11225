#include "drive/csv_dialect.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

#include "drive/csv_lines.hpp"
#include "drive/decimals.hpp"
#include "drive/refusal.hpp"
#include "drive/stamps.hpp"

namespace drive {
namespace {

// Lines that the separator is found by.
constexpr std::size_t looked_at = 64;

// The likeliest first: blanks last, as they part wherever tabs do.
constexpr std::array<std::pair<Separator, const char*>, 4> separators = {{{Separator::comma, "comma"},
                                                                          {Separator::semicolon, "semicolon"},
                                                                          {Separator::tab, "tab"},
                                                                          {Separator::blank, "blank"}}};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// How the first lines look under one separator.
struct Reading {
    Separator separator = Separator::comma;
    const char* name = "";
    std::size_t in_first_line = 0;
    bool even = true;  ///< equally many fields in each line
    std::size_t fields = 0;
    std::size_t numbers = 0;  ///< of them, dates among them
    std::string shows;        ///< the last line's fields, for a message
    [[nodiscard]] bool splits() const { return in_first_line >= 2; }
    [[nodiscard]] bool has_more_numbers_than(const Reading& other) const {
        return numbers * other.fields > other.numbers * fields;
    }
};

Reading read_with(std::pair<Separator, const char*> separator, const std::vector<std::string_view>& lines) {
    Reading reading;
    reading.separator = separator.first;
    reading.name = separator.second;
    std::vector<Field> fields;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!split_fields(lines[i], separator.first, fields)) {
            reading.even = false;
            continue;
        }
        reading.in_first_line = i == 0 ? fields.size() : reading.in_first_line;
        reading.even = reading.even && fields.size() == reading.in_first_line;
        reading.fields += fields.size();
        for (const Field& field : fields) {
            reading.numbers += looks_like_number(field.text) || looks_like_date(field.text) ? 1 : 0;
        }
    }
    reading.shows = fmt::format("{} fields by {}", fields.size(), reading.name);
    for (std::size_t i = 0; i < fields.size() && i < 3; ++i) {
        reading.shows += fmt::format("{}{}", i == 0 ? ": " : ", ", shown(fields[i].text));
    }
    reading.shows += fields.size() > 3 ? ", ..." : "";
    return reading;
}

}  // namespace

std::string text_of(const Field& field) {
    std::string text(field.text);
    for (std::size_t at = 0; field.quoted && (at = text.find("\"\"", at)) != std::string::npos; ++at) {
        text.erase(at, 1);
    }
    return text;
}

bool split_fields(std::string_view line, Separator separator, std::vector<Field>& fields) {
    fields.clear();
    const auto separates = [&](char c) {
        return separator == Separator::blank ? is_blank(c) : c == static_cast<char>(separator);
    };
    const auto skip_blanks = [&](std::size_t at) {
        while (at < line.size() && is_blank(line[at]) && (separator == Separator::blank || !separates(line[at]))) {
            ++at;
        }
        return at;
    };
    if (separator == Separator::blank) {
        line = trimmed(line);
    }
    for (std::size_t at = 0;;) {
        at = skip_blanks(at);
        Field field;
        if (at < line.size() && line[at] == '"') {
            const std::size_t from = ++at;
            while (at < line.size() && (line[at] != '"' || (at + 1 < line.size() && line[at + 1] == '"'))) {
                at += line[at] == '"' ? 2 : 1;
            }
            if (at >= line.size()) {
                return false;
            }
            field = {trimmed(line.substr(from, at - from)), true};
            const std::size_t behind = skip_blanks(++at);
            if (separator == Separator::blank) {
                if (at < line.size() && behind == at) {
                    return false;
                }
            } else if (behind < line.size() && !separates(line[behind])) {
                return false;
            } else {
                at = behind;
            }
        } else {
            const std::size_t from = at;
            while (at < line.size() && !separates(line[at])) {
                ++at;
            }
            field.text = trimmed(line.substr(from, at - from));
        }
        fields.push_back(field);
        if (at >= line.size()) {
            return true;
        }
        ++at;
    }
}

Separator separator_named(const std::string& word) {
    for (const auto& [separator, name] : separators) {
        if (word == name) {
            return separator;
        }
    }
    refuse(fmt::format("--separator: expected comma, semicolon, tab or blank, found {}", shown(word)));
}

Separator find_separator(std::string_view text, const std::string& name) {
    std::vector<std::string_view> lines;
    CsvLines source(text, name);
    for (std::string_view line; lines.size() < looked_at && source.next(line);) {
        lines.push_back(line);
    }
    std::vector<Reading> readings;
    bool any_even = false;
    for (const auto& separator : separators) {
        Reading reading = read_with(separator, lines);
        any_even = any_even || (reading.splits() && reading.even);
        readings.push_back(std::move(reading));
    }
    const Reading* best = nullptr;
    const Reading* as_good = nullptr;  // the first after it; behind tabs only blanks are, which is no other reading
    for (const Reading& reading : readings) {
        if (!reading.splits() || (any_even && !reading.even)) {
            continue;
        }
        if (best == nullptr || reading.has_more_numbers_than(*best)) {
            best = &reading;
            as_good = nullptr;
        } else if (as_good == nullptr && best->numbers > 0 && !best->has_more_numbers_than(reading) &&
                   best->separator != Separator::tab) {
            as_good = &reading;
        }
    }
    if (best == nullptr) {
        refuse(fmt::format("{}:{}: expected columns apart by commas, semicolons, tabs or blanks, found one: {}", name,
                           source.number(), lines.empty() ? "nothing" : shown(trimmed(lines.front()))));
    }
    if (as_good != nullptr) {
        refuse(fmt::format("{}:{}: {}, or {}? --separator {} or {} decides", name, source.number(), best->shows,
                           as_good->shows, best->name, as_good->name));
    }
    return best->separator;
}

}  // namespace drive
