#include "drive/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drive/refusal.hpp"

namespace drive {

Json parse_json(const std::string& text, const std::string& name, const std::string& what) {
    try {
        return Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) {
            if (depth > 8) {
                refuse(fmt::format("{}: expected {}, found values nested {} deep", name, what, depth));
            }
            return true;
        });
    } catch (const Json::parse_error& error) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        const bool cut = text.find_last_not_of(" \t\r\n") == std::string::npos || error.byte > text.size();
        refuse(fmt::format(
            "{}:{}: {}", name, 1 + std::count(text.begin(), end, '\n'),
            cut ? fmt::format("the file ends in the middle; expected {} in JSON", what)
                : fmt::format("expected JSON, found '{}'", text.substr(error.byte < 12 ? 0 : error.byte - 12, 20))));
    } catch (const Json::out_of_range&) {
        refuse(fmt::format("{}: expected finite numbers, found one beyond double precision", name));
    }
}

std::string shortened(const Json& value) { return value.dump().substr(0, 60); }

Fields::Fields(Json object, std::string name) : object_(std::move(object)), name_(std::move(name)) {
    if (!object_.is_object()) {
        refuse(fmt::format("{}: expected an object, found {}", name_, shortened(object_)));
    }
}

Json Fields::take(const char* key) {
    if (!has(key)) {
        refuse(fmt::format("{}: expected the field {}", name_, key));
    }
    Json value = object_[key];
    object_.erase(key);
    return value;
}

double Fields::number(const char* key) {
    const Json value = take(key);
    if (!value.is_number()) {
        refuse(fmt::format("{}: {}: expected a number, found {}", name_, key, shortened(value)));
    }
    return value.get<double>();
}

void Fields::refuse_rest(const std::string& expected) const {
    if (!object_.empty()) {
        refuse(fmt::format("{}: expected {} alone, found {}", name_, expected, object_.begin().key()));
    }
}

}  // namespace drive
