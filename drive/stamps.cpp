#include "drive/stamps.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "drive/refusal.hpp"

namespace drive {
namespace {

// Seconds from 2001-09-09 to 2103: a drive's log that begins there in seconds counts them from 1970.
constexpr double earliest_since_1970_s = 1e9;
constexpr double latest_since_1970_s = 4.2e9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Takes so many digits off the front.
bool take_digits(std::string_view& text, std::size_t count, int& value) {
    if (text.size() < count) {
        return false;
    }
    value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_digit(text[i])) {
            return false;
        }
        value = 10 * value + (text[i] - '0');
    }
    text.remove_prefix(count);
    return true;
}

bool take(std::string_view& text, std::string_view any_of) {
    if (text.empty() || any_of.find(text.front()) == std::string_view::npos) {
        return false;
    }
    text.remove_prefix(1);
    return true;
}

// Digits behind a decimal mark, as a part of one.
bool take_part(std::string_view& text, double& part) {
    std::size_t count = 0;
    while (count < text.size() && is_digit(text[count])) {
        ++count;
    }
    const std::string written = "0." + std::string(text.substr(0, count));
    text.remove_prefix(count);
    return count > 0 && std::from_chars(written.data(), written.data() + written.size(), part).ec == std::errc{};
}

// Z, +02:00, +0200, +02 or nothing, to the end.
bool take_offset(std::string_view text, int& offset_s, bool& has_offset) {
    offset_s = 0;
    has_offset = !text.empty();
    if (text.empty() || text == "Z" || text == "z") {
        return true;
    }
    const bool west = text.front() == '-';
    int hours = 0;
    int minutes = 0;
    if (!take(text, "+-") || !take_digits(text, 2, hours)) {
        return false;
    }
    if (!text.empty()) {
        (void)take(text, ":");
        if (!take_digits(text, 2, minutes)) {
            return false;
        }
    }
    offset_s = (west ? -1 : 1) * (3600 * hours + 60 * minutes);
    return text.empty() && hours < 24 && minutes < 60;
}

// Digits, with a part behind a mark or none: exact in two parts.
std::optional<Instant> instant_of(std::string_view text) {
    Instant instant;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), instant.whole);
    std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
    if (error != std::errc{} || text.front() == '-' ||
        (!rest.empty() && (!take(rest, ".,") || !take_part(rest, instant.part) || !rest.empty()))) {
        return std::nullopt;
    }
    return instant;
}

double difference(const Instant& to, const Instant& from) {
    return static_cast<double>(to.whole - from.whole) + (to.part - from.part);
}

}  // namespace

std::optional<Instant> date_of(std::string_view text) {
    int year = 0;
    int month = 0;
    int day = 0;
    int hour = 0;
    int minute = 0;
    int second = 0;
    Instant instant;
    if (!take_digits(text, 4, year) || !take(text, "-") || !take_digits(text, 2, month) || !take(text, "-") ||
        !take_digits(text, 2, day) || !take(text, "Tt ") || !take_digits(text, 2, hour) || !take(text, ":") ||
        !take_digits(text, 2, minute)) {
        return std::nullopt;
    }
    if (take(text, ":")) {
        if (!take_digits(text, 2, second) || (take(text, ".,") && !take_part(text, instant.part))) {
            return std::nullopt;
        }
    }
    int offset_s = 0;
    while (take(text, " ")) {
    }
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!take_offset(text, offset_s, instant.has_offset) || !date.ok() || hour > 23 || minute > 59 || second > 60) {
        return std::nullopt;
    }
    const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
    instant.whole = days * 86400 + hour * 3600 + minute * 60 + second - offset_s;
    return instant;
}

bool looks_like_date(std::string_view text) { return date_of(text).has_value(); }

Stamps::Stamps(const std::string& file, Decimals& decimals, Column column)
    : file_(file), decimals_(decimals), column_(std::move(column)) {
    if (!column_.unit_by_option.empty()) {
        unit_ = time_unit_of(column_.unit_by_option);
        if (!unit_) {
            refuse(
                fmt::format("--time-unit: expected ns, us, ms, s, min or h, found {}", shown(column_.unit_by_option)));
        }
        return;
    }
    unit_ = split_time_unit(column_.name).unit;
    const auto below = time_unit_of(column_.unit_below);
    if (unit_ && below && !(*unit_ == *below)) {
        refuse(
            fmt::format("{}: the stamps' column is called {}, the row of units below has {}; --time-unit {} or {} "
                        "decides",
                        file_, shown(column_.name), shown(column_.unit_below), unit_->symbol, below->symbol));
    }
    unit_ = unit_ ? unit_ : below;
}

// The first stamp tells what kind they are.
void Stamps::begin(std::string_view field, std::size_t line) {
    if (const auto date = date_of(field)) {
        if (!column_.unit_by_option.empty()) {
            refuse(fmt::format("{}:{}: {}: expected a number of {}, as --time-unit says, found a date, {}", file_, line,
                               column_.name, unit_->name, shown(field)));
        }
        kind_ = Kind::date;
        first_ = *date;
        return;
    }
    const double value = decimals_.number(field, line, column_.name);
    if (!unit_ && !column_.unit_below.empty() && column_.unit_below != "-") {
        refuse(
            fmt::format("{}:{}: {}: expected stamps in ns, us, ms, s, min or h, found {} in the row of units; "
                        "--time-unit decides",
                        file_, line, column_.name, shown(column_.unit_below)));
    }
    kind_ = Kind::number;
    // Without a named unit a number of thirteen digits is a time of this century in milliseconds, and nothing else.
    for (const char* symbol : {"s", "ms", "us", "ns"}) {
        const TimeUnit unit = unit_ ? *unit_ : *time_unit_of(symbol);
        const double seconds = unit.seconds(value);
        if (seconds >= earliest_since_1970_s && seconds < latest_since_1970_s) {
            unit_by_size_ = !unit_;
            unit_ = unit;
            kind_ = Kind::since_1970;
            const auto instant = instant_of(field);
            first_ = instant ? *instant : Instant{std::llround(std::floor(value)), value - std::floor(value)};
            return;
        }
    }
    unit_ = unit_ ? *unit_ : TimeUnit{};
}

double Stamps::read(std::string_view field, std::size_t line) {
    if (kind_ == Kind::unknown) {
        begin(field, line);
    }
    if (kind_ == Kind::date) {
        const auto date = date_of(field);
        if (!date) {
            refuse(
                fmt::format("{}:{}: {}: expected a date such as 2024-05-01T12:00:00.5, as the first stamp is, found "
                            "{}",
                            file_, line, column_.name, shown(field)));
        }
        if (date->has_offset != first_.has_offset) {
            refuse(fmt::format("{}:{}: {}: expected dates {} offset from UTC, as the first stamp is, found {}", file_,
                               line, column_.name, first_.has_offset ? "with an" : "without", shown(field)));
        }
        return difference(*date, first_);
    }
    const double value = decimals_.number(field, line, column_.name);
    double seconds = 0.0;
    if (kind_ == Kind::since_1970) {
        const auto instant = instant_of(field);
        seconds = unit_->seconds(instant ? difference(*instant, first_)
                                         : value - static_cast<double>(first_.whole) - first_.part);
    } else {
        seconds = unit_->seconds(value);
    }
    if (!std::isfinite(seconds)) {
        refuse(fmt::format("{}:{}: {}: expected a finite number of seconds, found {} {}", file_, line, column_.name,
                           shown(field), unit_->name));
    }
    return seconds;
}

std::string Stamps::found() const {
    switch (kind_) {
        case Kind::date:
            return "dates as stamps, 0 s at the first";
        case Kind::since_1970:
            return fmt::format("stamps in {} since 1970{}, 0 s at the first", unit_->name,
                               unit_by_size_ && !(*unit_ == TimeUnit{}) ? " by their size" : "");
        case Kind::number:
            return *unit_ == TimeUnit{} ? "" : fmt::format("stamps in {}", unit_->name);
        case Kind::unknown:
            break;
    }
    return "";
}

}  // namespace drive
