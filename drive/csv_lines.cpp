#include "drive/csv_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drive/log.hpp"
#include "drive/refusal.hpp"

namespace drive {

std::string_view trimmed(std::string_view text) {
    const auto from = text.find_first_not_of(" \t\r");
    return from == std::string_view::npos ? text.substr(0, 0)
                                          : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::string_view behind_byte_order_mark(std::string_view text, const std::string& name) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        refuse(fmt::format("{}:1: expected text in UTF-8 or ASCII, found UTF-16", name));
    }
    return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

bool CsvLines::next(std::string_view& line) {
    while (at_ < text_.size()) {
        const auto end = std::min(text_.find('\n', at_), text_.size());
        line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        if (line.size() > LogLimits::line) {
            refuse(fmt::format("{}:{}: expected lines of at most {} bytes, found one of {}", name_, number_,
                               LogLimits::line, line.size()));
        }
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        const std::string_view held = trimmed(line);
        if (!held.empty() && held.front() != '#') {
            return true;
        }
    }
    return false;
}

}  // namespace drive
