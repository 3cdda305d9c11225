#include "drive/decimals.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "drive/refusal.hpp"

namespace drive {
namespace {

// \return  whether the whole text is a number, which may be beyond the range of doubles
bool read_number(std::string_view text, double& value) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) {
            return false;
        }
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
        value = HUGE_VAL;
    }
    return error != std::errc::invalid_argument && end == text.data() + text.size();
}

bool read_with_either_mark(std::string_view text, double& value, char& mark) {
    const auto at = text.find_first_of(".,");
    mark = at == std::string_view::npos ? '\0' : text[at];
    if (mark != ',') {
        return read_number(text, value);
    }
    std::string with_point(text);
    with_point[at] = '.';
    return read_number(with_point, value);
}

const char* name_of(char mark) { return mark == ',' ? "decimal commas" : "decimal points"; }

}  // namespace

bool looks_like_number(std::string_view text) {
    double value = 0.0;
    char mark = 0;
    return read_with_either_mark(text, value, mark);
}

Decimals::Decimals(const std::string& file, const std::string& mark) : file_(file) {
    if (mark == "comma" || mark == "point") {
        mark_ = mark == "comma" ? ',' : '.';
    } else if (!mark.empty()) {
        refuse(fmt::format("--decimal: expected point or comma, found {}", shown(mark)));
    }
}

double Decimals::number(std::string_view field, std::size_t line, std::string_view column) {
    double value = 0.0;
    char mark = 0;
    if (!read_with_either_mark(field, value, mark) || !std::isfinite(value)) {
        refuse(fmt::format("{}:{}: {}: expected a finite number, found {}", file_, line, column, shown(field)));
    }
    if (mark == 0) {
        return value;
    }
    if (mark_ != 0 && mark != mark_) {
        refuse(fmt::format("{}:{}: {}: expected {} throughout, as {}, found {}", file_, line, column, name_of(mark_),
                           line_ == 0 ? "--decimal says" : fmt::format("{} in line {} has", shown(example_), line_),
                           shown(field)));
    }
    if (line_ == 0) {
        mark_ = mark;
        line_ = line;
        example_ = std::string(field);
    }
    return value;
}

}  // namespace drive
