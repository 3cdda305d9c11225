#include "drive/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "qemu/failure.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

std::string_view trimmed(std::string_view text) {
    const auto from = text.find_first_not_of(" \t\r");
    return from == std::string_view::npos ? std::string_view()
                                          : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const auto comma = line.find(',');
        std::string_view field = trimmed(line.substr(0, comma));
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = field.substr(1, field.size() - 2);
        }
        fields.push_back(field);
        if (comma == std::string_view::npos) {
            return fields;
        }
        line.remove_prefix(comma + 1);
    }
}

std::string shown(std::string_view text) { return text.empty() ? "nothing" : fmt::format("'{}'", text.substr(0, 40)); }

constexpr std::size_t none = static_cast<std::size_t>(-1);

// The lines of a text, one after the other.
class Lines {
public:
    Lines(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    /// The next line that is neither empty nor a comment.
    bool next(std::string_view& line) {
        while (at_ < text_.size()) {
            const auto end = std::min(text_.find('\n', at_), text_.size());
            line = text_.substr(at_, end - at_);
            at_ = end + 1;
            ++number_;
            if (line.size() > LogLimits::line) {
                refuse(fmt::format("{}:{}: expected lines of at most {} bytes, found one of {}", name_, number_,
                                   LogLimits::line, line.size()));
            }
            line = trimmed(line);
            if (!line.empty() && line.front() != '#') {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::size_t number() const { return number_; }

private:
    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

class Header {
public:
    Header(std::vector<std::string_view> names, std::string place)
        : names_(std::move(names)), place_(std::move(place)) {}

    /// The column of one of the names; `given` replaces them.
    [[nodiscard]] std::size_t find(const char* what, const std::string& given,
                                   std::vector<std::string_view> usual) const {
        if (!given.empty()) {
            usual = {given};
        }
        std::size_t found = none;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (std::find(usual.begin(), usual.end(), names_[i]) != usual.end()) {
                if (found != none) {
                    refuse(fmt::format("{}: expected one column for the {}, found {} and {}: name one", place_, what,
                                       names_[found], names_[i]));
                }
                found = i;
            }
        }
        if (found == none) {
            refuse(fmt::format("{}: expected a column {} for the {}, found {}", place_, fmt::join(usual, ", "), what,
                               shown(fmt::format("{}", fmt::join(names_, ",")))));
        }
        return found;
    }
    [[nodiscard]] bool has(std::string_view name) const {
        return std::find(names_.begin(), names_.end(), name) != names_.end();
    }
    [[nodiscard]] std::string_view name(std::size_t column) const { return names_[column]; }
    [[nodiscard]] std::size_t size() const { return names_.size(); }

private:
    std::vector<std::string_view> names_;
    std::string place_;
};

double number(std::string_view field, const std::string& name, std::size_t line, std::string_view column) {
    std::string_view digits = field;
    if (!digits.empty() && digits.front() == '+') {
        digits.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        refuse(fmt::format("{}:{}: {}: expected a finite number, found {}", name, line, column, shown(field)));
    }
    return value;
}

// A counter of a known width is unwrapped; a jump that looks like a wrap is refused while its width is unknown.
void unwrap(Log& log, int bits, std::string_view column) {
    const double turn = std::exp2(bits);
    double carried = 0.0;
    for (std::size_t i = 1; i < log.output.size(); ++i) {
        const double jump = log.output[i] + carried - log.output[i - 1];
        if (bits > 0) {
            if (std::fabs(jump) > turn / 2) {
                carried -= std::copysign(turn, jump);
            }
            log.output[i] += carried;
            continue;
        }
        for (const int width : {16, 32}) {
            const double range = std::exp2(width);
            const auto [low, high] = std::minmax(log.output[i], log.output[i - 1]);
            const bool inside = (low >= 0 && high < range) || (low >= -range / 2 && high < range / 2);
            if (inside && std::fabs(jump) > 0.9 * range) {
                refuse(
                    fmt::format("{}:{}: {}: jumps by {} from one sample to the next, as a counter of {} bits does that "
                                "wraps; expected counts that do not, or --counter-bits {}",
                                log.name, log.line[i], column, jump, width, width));
            }
        }
    }
}

void check_units(Log& log, const Header& header, std::size_t input, std::size_t output) {
    if (input != none && header.name(input) == "duty") {
        for (std::size_t i = 0; i < log.input.size(); ++i) {
            if (log.input[i] < 0.0 || log.input[i] > 1.0) {
                refuse(fmt::format("{}:{}: duty: expected 0 to 1, found {}{}", log.name, log.line[i], log.input[i],
                                   log.input[i] > 1.0 && log.input[i] <= 100.0 ? " (percent? divide by 100)" : ""));
            }
        }
    }
    if (header.name(output) == "angle_rad") {
        const auto largest = std::max_element(log.output.begin(), log.output.end(),
                                              [](double a, double b) { return std::fabs(a) < std::fabs(b); });
        if (std::fabs(*largest) > 4.0 * std::numbers::pi) {
            log.warnings.push_back(
                fmt::format("{}:{}: angle_rad reaches {}: more than two turns; are these degrees?", log.name,
                            log.line[static_cast<std::size_t>(largest - log.output.begin())], *largest));
        }
    }
    if (header.name(output) == "counts") {
        for (std::size_t i = 0; i < log.output.size(); ++i) {
            if (log.output[i] != std::floor(log.output[i])) {
                log.warnings.push_back(fmt::format("{}:{}: counts: expected whole numbers, found {}", log.name,
                                                   log.line[i], log.output[i]));
                break;
            }
        }
    }
}

}  // namespace

Log parse_log(const std::string& text, const std::string& name, const Columns& columns) {
    Log log;
    log.name = name;
    Lines lines(text, name);
    std::string_view line;
    if (!lines.next(line)) {
        refuse(fmt::format("{}: expected a header such as time_s,input,output, found nothing", name));
    }
    const Header header(split(line), fmt::format("{}:{}", name, lines.number()));
    const std::size_t time = header.find("time", columns.time, {"time_s"});
    const bool has_reference = columns.takes_reference && (!columns.reference.empty() || header.has("reference"));
    const std::size_t reference = has_reference ? header.find("reference", columns.reference, {"reference"}) : none;
    const bool has_input =
        (columns.needs_input && !has_reference) || !columns.input.empty() || header.has("input") || header.has("duty");
    const std::size_t input = has_input ? header.find("input", columns.input, {"input", "duty"}) : none;
    const std::size_t output = header.find("output", columns.output, {"output", "y", "angle_rad", "counts"});
    if (header.name(output) == "counts" && !columns.counts_per_unit) {
        log.warnings.push_back(fmt::format("{}: the output is in counts; --counts-per-unit would make it units", name));
    }
    while (lines.next(line)) {
        const auto fields = split(line);
        const auto at = lines.number();
        if (fields.size() != header.size()) {
            refuse(fmt::format("{}:{}: expected {} fields, as the header has, found {}", name, at, header.size(),
                               fields.size()));
        }
        if (log.time_s.size() == LogLimits::samples) {
            refuse(fmt::format("{}:{}: expected at most {} samples", name, at, LogLimits::samples));
        }
        log.time_s.push_back(number(fields[time], name, at, header.name(time)));
        if (input != none) {
            log.input.push_back(number(fields[input], name, at, header.name(input)));
        }
        if (reference != none) {
            log.reference.push_back(number(fields[reference], name, at, header.name(reference)));
        }
        log.output.push_back(number(fields[output], name, at, header.name(output)));
        log.line.push_back(at);
    }
    if (log.time_s.size() < 2) {
        refuse(fmt::format("{}: expected at least 2 samples, found {}", name, log.time_s.size()));
    }
    if (header.name(output) == "counts" || columns.counter_bits > 0) {
        unwrap(log, columns.counter_bits, header.name(output));
    }
    check_units(log, header, input, output);
    if (columns.counts_per_unit) {
        if (!(std::fabs(*columns.counts_per_unit) > 0.0 && std::isfinite(*columns.counts_per_unit))) {
            refuse(
                fmt::format("--counts-per-unit: expected a number other than 0, found {}", *columns.counts_per_unit));
        }
        for (double& value : log.output) {
            value /= *columns.counts_per_unit;
        }
    }
    return log;
}

std::string StampReport::text() const {
    std::string said = fmt::format("intervals {:.6g} to {:.6g} s, usually {:.6g} s", smallest_interval_s,
                                   largest_interval_s, usual_interval_s);
    if (repeated > 0) {
        said += fmt::format("; {} repeated stamps, from line {}: their mean output stays", repeated, first_repeated);
    }
    if (backward > 0) {
        said += fmt::format("; {} stamps run backward, from line {}: left out", backward, first_backward);
    }
    if (missing > 0) {
        said += fmt::format("; about {} samples missing, from line {}: the gaps are bridged", missing, first_gap);
    }
    return said;
}

StampReport order_stamps(Log& log) {
    StampReport report;
    Log ordered;
    ordered.name = log.name;
    ordered.warnings = log.warnings;
    std::size_t with_this_stamp = 1;
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        if (!ordered.time_s.empty() && log.time_s[i] < ordered.time_s.back()) {
            report.first_backward = report.backward++ == 0 ? log.line[i] : report.first_backward;
            continue;
        }
        if (!ordered.time_s.empty() && log.time_s[i] == ordered.time_s.back()) {
            report.first_repeated = report.repeated++ == 0 ? log.line[i] : report.first_repeated;
            ++with_this_stamp;
            ordered.output.back() += (log.output[i] - ordered.output.back()) / static_cast<double>(with_this_stamp);
            if (!log.input.empty()) {
                ordered.input.back() = log.input[i];
            }
            if (!log.reference.empty()) {
                ordered.reference.back() = log.reference[i];
            }
            continue;
        }
        with_this_stamp = 1;
        ordered.time_s.push_back(log.time_s[i]);
        ordered.output.push_back(log.output[i]);
        ordered.line.push_back(log.line[i]);
        if (!log.input.empty()) {
            ordered.input.push_back(log.input[i]);
        }
        if (!log.reference.empty()) {
            ordered.reference.push_back(log.reference[i]);
        }
    }
    if (ordered.time_s.size() < 2) {
        refuse(fmt::format("{}: expected at least 2 different stamps, found {}", log.name, ordered.time_s.size()));
    }
    if (report.backward * 10 > log.time_s.size()) {
        refuse(fmt::format("{}:{}: expected stamps that rise; {} of {} run backward", log.name, report.first_backward,
                           report.backward, log.time_s.size()));
    }
    std::vector<double> intervals(ordered.time_s.size() - 1);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        intervals[i] = ordered.time_s[i + 1] - ordered.time_s[i];
    }
    std::vector<double> sorted = intervals;
    std::sort(sorted.begin(), sorted.end());
    report.smallest_interval_s = sorted.front();
    report.largest_interval_s = sorted.back();
    report.usual_interval_s = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        if (intervals[i] > 1.75 * report.usual_interval_s) {
            report.first_gap = report.missing == 0 ? ordered.line[i + 1] : report.first_gap;
            report.missing += static_cast<std::size_t>(std::llround(intervals[i] / report.usual_interval_s)) - 1;
        }
    }
    log = std::move(ordered);
    return report;
}

Resampled resample(Log log, double step_s, Hold hold) {
    Resampled result;
    result.stamps = order_stamps(log);
    const double from = log.time_s.front();
    const double span = log.time_s.back() - from;
    if (!(step_s > 0.0 && std::isfinite(step_s)) || span / step_s + 1.0 > static_cast<double>(LogLimits::samples)) {
        refuse(fmt::format("{}: expected a step above 0 s that gives at most {} samples over {} s, found {}", log.name,
                           LogLimits::samples, span, step_s));
    }
    const auto count = static_cast<std::size_t>(std::floor(span / step_s + 1e-9)) + 1;
    if (count < 2) {
        refuse(fmt::format("{}: expected a step of at most {} s, the length of the log, found {}", log.name, span,
                           step_s));
    }
    Log& out = result.log;
    out.name = log.name;
    out.warnings = log.warnings;
    std::size_t i = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double t = from + static_cast<double>(k) * step_s;
        // A stamp that differs from t by rounding alone counts as reached.
        while (i + 1 < log.time_s.size() && log.time_s[i + 1] <= t + 1e-9 * step_s) {
            ++i;
        }
        out.time_s.push_back(t);
        out.line.push_back(log.line[i]);
        if (!log.input.empty()) {
            out.input.push_back(log.input[i]);
        }
        if (!log.reference.empty()) {
            out.reference.push_back(log.reference[i]);
        }
        double value = log.output[i];
        if (hold == Hold::linear && i + 1 < log.time_s.size()) {
            const double part = std::max(0.0, (t - log.time_s[i]) / (log.time_s[i + 1] - log.time_s[i]));
            value += part * (log.output[i + 1] - log.output[i]);
        }
        out.output.push_back(value);
    }
    return result;
}

std::string to_csv(const Log& log, const std::string& output_name) {
    std::string text =
        log.input.empty() ? fmt::format("time_s,{}\n", output_name) : fmt::format("time_s,input,{}\n", output_name);
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        text += log.input.empty() ? fmt::format("{},{}\n", log.time_s[i], log.output[i])
                                  : fmt::format("{},{},{}\n", log.time_s[i], log.input[i], log.output[i]);
    }
    return text;
}

}  // namespace drive
