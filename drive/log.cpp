#include "drive/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "drive/csv_dialect.hpp"
#include "drive/csv_lines.hpp"
#include "drive/decimal_pairs.hpp"
#include "drive/decimals.hpp"
#include "drive/log_columns.hpp"
#include "drive/refusal.hpp"
#include "drive/stamps.hpp"

namespace drive {
namespace {

constexpr std::size_t none = LogColumns::none;

// The lines of a log, as fields.
class Rows {
public:
    Rows(std::string_view text, const std::string& name, const Columns& asked)
        : lines_(text, name), name_(name), pairs_(asked.decimal == "comma") {
        std::string_view line;
        CsvLines first(text, name);
        if (!first.next(line)) {
            refuse(fmt::format("{}: expected a header such as time_s,input,output, found nothing", name));
        }
        separator_ = asked.separator.empty() ? find_separator(text, name) : separator_named(asked.separator);
        pairs_ = pairs_ && separator_ == Separator::comma;
    }

    bool next() {
        if (!lines_.next(line_)) {
            return false;
        }
        if (!split_fields(line_, separator_, fields_)) {
            refuse(fmt::format("{}: expected quotes that end with their field, found {}", place(), shown(line_)));
        }
        any_quoted_ = any_quoted_ || std::any_of(fields_.begin(), fields_.end(), [](auto& f) { return f.quoted; });
        return true;
    }
    /// Of a first line that is data: where --decimal says so, its commas separate and part in turn.
    void pair_decimals() {
        if (!pairs_ || any_quoted_) {
            return;
        }
        if (fields_.size() % 2 != 0) {
            refuse(
                fmt::format("{}: expected an even number of fields, which --decimal comma joins by twos, found {}; "
                            "quote decimal commas or put semicolons between fields",
                            place(), fields_.size()));
        }
        fields_ = joined_pairs(fields_);
    }
    void expect(std::size_t count) {
        if (fields_.size() == 2 * count && pairs_) {
            fields_ = joined_pairs(fields_);
        }
        if (fields_.size() != count) {
            refuse(fmt::format("{}: expected {} fields, as the header has, found {}{}", place(), count, fields_.size(),
                               separator_ == Separator::comma ? as_decimal_commas(fields_, count) : ""));
        }
    }

    [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }
    [[nodiscard]] std::string_view text(std::size_t column) const { return fields_[column].text; }
    [[nodiscard]] std::size_t line() const { return lines_.number(); }
    [[nodiscard]] std::string place() const { return fmt::format("{}:{}", name_, line()); }
    [[nodiscard]] Separator separator() const { return separator_; }
    [[nodiscard]] bool any_quoted() const { return any_quoted_; }

private:
    CsvLines lines_;
    const std::string& name_;
    bool pairs_;
    Separator separator_ = Separator::comma;
    std::string_view line_;
    std::vector<Field> fields_;
    bool any_quoted_ = false;
};

const char* plural_of(Separator separator) {
    switch (separator) {
        case Separator::semicolon:
            return "semicolons";
        case Separator::tab:
            return "tabs";
        case Separator::blank:
            return "blanks between fields";
        case Separator::comma:
            break;
    }
    return "commas";
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

void check_units(Log& log, std::string_view input, std::string_view output) {
    if (input == "duty") {
        for (std::size_t i = 0; i < log.input.size(); ++i) {
            if (log.input[i] < 0.0 || log.input[i] > 1.0) {
                refuse(fmt::format("{}:{}: duty: expected 0 to 1, found {}{}", log.name, log.line[i], log.input[i],
                                   log.input[i] > 1.0 && log.input[i] <= 100.0 ? " (percent? divide by 100)" : ""));
            }
        }
    }
    if (output == "angle_rad") {
        const auto largest = std::max_element(log.output.begin(), log.output.end(),
                                              [](double a, double b) { return std::fabs(a) < std::fabs(b); });
        if (std::fabs(*largest) > 4.0 * std::numbers::pi) {
            log.warnings.push_back(
                fmt::format("{}:{}: angle_rad reaches {}: more than two turns; are these degrees?", log.name,
                            log.line[static_cast<std::size_t>(largest - log.output.begin())], *largest));
        }
    }
    if (output == "counts") {
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
    const std::string_view body = behind_byte_order_mark(text, name);
    Rows rows(body, name, columns);
    Decimals decimals(name, columns.decimal);
    (void)rows.next();
    LogHeader header = header_of(rows.fields(), rows.place());
    if (!header.is_written) {
        rows.pair_decimals();
        header = header_of(rows.fields(), rows.place());
    }
    const LogColumns at = find_columns(header, columns);
    if (at.output != none && header.names[at.output] == "counts" && !columns.counts_per_unit) {
        log.warnings.push_back(fmt::format("{}: the output is in counts; --counts-per-unit would make it units", name));
    }
    bool more = header.is_written ? rows.next() : true;
    const bool has_units = header.is_written && more && rows.fields().size() == header.names.size() &&
                           is_row_of_units(rows.fields(), at.time);
    const std::string time_below = has_units ? text_of(rows.fields()[at.time]) : std::string();
    Stamps stamps(name, decimals, {header.names[at.time], time_below, columns.time_unit});
    more = has_units ? rows.next() : more;
    log.more_inputs.resize(at.more_inputs.size());
    const bool may_doubt = !header.is_written && columns.decimal.empty() && rows.separator() == Separator::comma;
    CommaDoubt doubt;
    for (; more; more = rows.next()) {
        if (may_doubt) {
            doubt.see(rows.fields(), rows.line());
        }
        rows.expect(header.names.size());
        if (log.time_s.size() == LogLimits::samples) {
            refuse(fmt::format("{}: expected at most {} samples", rows.place(), LogLimits::samples));
        }
        const auto number = [&](std::size_t column) {
            return decimals.number(rows.text(column), rows.line(), header.names[column]);
        };
        log.time_s.push_back(stamps.read(rows.text(at.time), rows.line()));
        if (at.input != none) {
            log.input.push_back(number(at.input));
        }
        for (std::size_t i = 0; i < at.more_inputs.size(); ++i) {
            log.more_inputs[i].push_back(number(at.more_inputs[i]));
        }
        if (at.reference != none) {
            log.reference.push_back(number(at.reference));
        }
        log.output.push_back(at.output == none ? 0.0 : number(at.output));
        if (at.simulated != none) {
            log.simulated.push_back(number(at.simulated));
        }
        log.line.push_back(rows.line());
    }
    if (log.time_s.size() < 2) {
        refuse(fmt::format("{}: expected at least 2 samples, found {}", name, log.time_s.size()));
    }
    doubt.refuse_if_any(name);
    std::vector<std::string> found;
    const auto say_if = [&](bool is_there, const std::string& what) {
        if (is_there) {
            found.push_back(what);
        }
    };
    say_if(body.size() != text.size(), "a byte order mark");
    say_if(columns.separator.empty() && rows.separator() != Separator::comma, plural_of(rows.separator()));
    say_if(rows.any_quoted(), "quoted fields");
    say_if(columns.decimal.empty() && decimals.has_commas(), "decimal commas");
    say_if(!header.is_written, "no header");
    say_if(has_units, "a row of units");
    say_if(!stamps.found().empty(), stamps.found());
    found.insert(found.end(), at.found.begin(), at.found.end());
    if (!found.empty()) {
        log.warnings.insert(log.warnings.begin(), fmt::format("{}: read with {}", name, fmt::join(found, ", ")));
    }
    if (at.output != none) {
        const std::string_view output = header.names[at.output];
        if (output == "counts" || columns.counter_bits > 0) {
            unwrap(log, columns.counter_bits, output);
        }
        check_units(log, at.input == none ? "" : header.names[at.input], output);
    }
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

std::string to_csv(const Log& log, const std::string& output_name) {
    std::string text = "time_s";
    text += log.input.empty() ? "" : ",input";
    for (std::size_t i = 0; i < log.more_inputs.size(); ++i) {
        text += fmt::format(",input_{}", i + 2);
    }
    text += "," + output_name + (log.simulated.empty() ? "\n" : ",simulated\n");
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        text += fmt::format("{}", log.time_s[i]);
        if (!log.input.empty()) {
            text += fmt::format(",{}", log.input[i]);
        }
        for (const std::vector<double>& input : log.more_inputs) {
            text += fmt::format(",{}", input[i]);
        }
        text += fmt::format(",{}", log.output[i]);
        text += log.simulated.empty() ? "\n" : fmt::format(",{}\n", log.simulated[i]);
    }
    return text;
}

}  // namespace drive
