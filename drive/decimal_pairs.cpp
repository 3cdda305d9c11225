#include "drive/decimal_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "drive/refusal.hpp"

namespace drive {
namespace {

// Of the readings this many are shown.
constexpr std::size_t most_readings = 3;

std::string_view from_first_to_last(const Field& first, const Field& last) {
    return {first.text.data(), static_cast<std::size_t>(last.text.data() + last.text.size() - first.text.data())};
}

bool is_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_whole(std::string_view text) {
    return is_digits(text.starts_with('-') || text.starts_with('+') ? text.substr(1) : text);
}

// Adds the ways to read the fields from `at` on as `left` numbers, `said` being those before.
void add_readings(const std::vector<Field>& fields, std::size_t at, std::size_t left, const std::string& said,
                  std::vector<std::string>& readings) {
    const std::size_t rest = fields.size() - at;
    if (readings.size() == most_readings || rest < left || rest > 2 * left) {
        return;
    }
    if (left == 0) {
        readings.push_back(said);
        return;
    }
    const std::string before = said.empty() ? "" : said + " ";
    if (rest >= 2 && is_whole(fields[at].text) && is_digits(fields[at + 1].text)) {
        add_readings(fields, at + 2, left - 1, before + std::string(from_first_to_last(fields[at], fields[at + 1])),
                     readings);
    }
    add_readings(fields, at + 1, left - 1, before + std::string(fields[at].text), readings);
}

}  // namespace

std::vector<Field> joined_pairs(const std::vector<Field>& fields) {
    std::vector<Field> joined;
    for (std::size_t i = 0; i < fields.size(); i += 2) {
        joined.push_back({from_first_to_last(fields[i], fields[i + 1]), false});
    }
    return joined;
}

std::string as_decimal_commas(const std::vector<Field>& fields, std::size_t expected) {
    // A longer line is no puzzle that anybody wants to see solved.
    constexpr std::size_t most_fields = 16;
    if (fields.size() <= expected || fields.size() > most_fields ||
        std::any_of(fields.begin(), fields.end(), [](const Field& field) { return field.quoted; })) {
        return "";
    }
    std::vector<std::string> readings;
    add_readings(fields, 0, expected, "", readings);
    if (readings.empty()) {
        return "";
    }
    std::string said = fmt::format(": with decimal commas it may be {}", shown(readings.front()));
    for (std::size_t i = 1; i < readings.size(); ++i) {
        said += fmt::format(" or {}", shown(readings[i]));
    }
    return said + (fields.size() == 2 * expected ? "; --decimal comma reads it so"
                                                 : "; quote such fields or put semicolons between them");
}

void CommaDoubt::see(const std::vector<Field>& fields, std::size_t line) {
    for (const Field& field : fields) {
        settled_ = settled_ || field.quoted || field.text.find('.') != std::string_view::npos;
        if (line_ == 0 && field.text.size() > 1 && field.text.front() == '0' && is_digits(field.text)) {
            line_ = line;
            field_ = std::string(field.text);
            shown_ = shown(from_first_to_last(fields.front(), fields.back()));
            fields_ = fields.size();
        }
    }
}

void CommaDoubt::refuse_if_any(const std::string& file) const {
    if (settled_ || line_ == 0) {
        return;
    }
    refuse(
        fmt::format("{}:{}: expected a header or decimal points, found {} in {}: {} fields, or fewer with decimal "
                    "commas? --decimal point or comma decides",
                    file, line_, shown(field_), shown_, fields_));
}

}  // namespace drive
