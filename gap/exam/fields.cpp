#include "gap/exam/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/failure.hpp"
#include "gap/exam/manifest.hpp"

namespace gap::exam {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void throw_bad_input(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

// JSON as it is, but for bytes that are no text.
std::string shortened(const Json& value) {
    return value.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60);
}

Json parse_json(const std::string& text, const std::string& name) {
    constexpr int deepest = 12;
    if (text.size() > Limits::bytes) {
        throw_bad_input(fmt::format("{}: expected at most {} bytes, found {}", name, Limits::bytes, text.size()));
    }
    try {
        return Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) {
            if (depth > deepest) {
                throw_bad_input(fmt::format("{}: expected values nested at most {} deep, found more", name, deepest));
            }
            return true;
        });
    } catch (const Json::parse_error& error) {
        const auto before = std::min<std::size_t>(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(before), '\n');
        throw_bad_input(fmt::format("{}:{}: expected JSON, found what is none at byte {}", name, line, error.byte));
    }
}

bool is_name(const std::string& name) {
    return !name.empty() && name.size() <= Limits::name && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

bool is_text(const Json& value) {
    if (!value.is_string()) {
        return false;
    }
    const auto& text = value.get_ref<const std::string&>();
    return !text.empty() && text.size() <= Limits::text &&
           std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

}  // namespace

Fields::Fields(Json object, std::string name) : object_(std::move(object)), name_(std::move(name)) {
    if (!object_.is_object()) {
        throw_bad_input(fmt::format("{}: expected an object, found {}", name_, shortened(object_)));
    }
}

void Fields::refuse(const std::string& key, const std::string& expected, const std::string& found) const {
    throw_bad_input(fmt::format("{}: {}: expected {}, found {}", name_, key, expected, found));
}

Json Fields::take(const char* key) {
    if (!has(key)) {
        refuse(key, "a value", "none");
    }
    Json value = object_[key];
    object_.erase(key);
    return value;
}

std::string Fields::text(const char* key) {
    const Json value = take(key);
    if (!is_text(value)) {
        refuse(key, fmt::format("a text of 1 to {} bytes", Limits::text), shortened(value));
    }
    return value.get<std::string>();
}

std::string Fields::text_or(const char* key, const std::string& otherwise) { return has(key) ? text(key) : otherwise; }

std::string Fields::one_of(const char* key, const std::vector<std::string>& words) {
    const Json value = take(key);
    if (!value.is_string() || std::find(words.begin(), words.end(), value.get<std::string>()) == words.end()) {
        refuse(key, fmt::format("one of {}", fmt::join(words, ", ")), shortened(value));
    }
    return value.get<std::string>();
}

bool Fields::flag_or(const char* key, bool otherwise) {
    if (!has(key)) {
        return otherwise;
    }
    const Json value = take(key);
    if (!value.is_boolean()) {
        refuse(key, "true or false", shortened(value));
    }
    return value.get<bool>();
}

std::optional<double> Fields::positive(const char* key) {
    if (!has(key)) {
        return std::nullopt;
    }
    const Json value = take(key);
    if (!value.is_number() || !(value.get<double>() > 0.0) || !std::isfinite(value.get<double>())) {
        refuse(key, "a number above 0", shortened(value));
    }
    return value.get<double>();
}

std::vector<Json> Fields::list(const char* key, std::size_t most, bool needed) {
    if (!needed && !has(key)) {
        return {};
    }
    const Json value = take(key);
    if (!value.is_array() || value.size() > most) {
        refuse(key, fmt::format("a list of at most {}", most),
               value.is_array() ? fmt::format("one of {}", value.size()) : shortened(value));
    }
    return {value.begin(), value.end()};
}

std::vector<std::string> Fields::texts(const char* key, std::size_t least) {
    std::vector<std::string> found;
    for (const Json& value : list(key, Limits::list, least > 0)) {
        if (!is_text(value)) {
            refuse(fmt::format("{}[{}]", key, found.size()), fmt::format("a text of 1 to {} bytes", Limits::text),
                   shortened(value));
        }
        found.push_back(value.get<std::string>());
    }
    if (found.size() < least) {
        refuse(key, fmt::format("a list of at least {}", least), fmt::format("one of {}", found.size()));
    }
    return found;
}

void Fields::refuse_rest(const std::string& known) const {
    if (!object_.empty()) {
        throw_bad_input(fmt::format("{}: expected no fields but {}, found {}", name_, known, object_.begin().key()));
    }
}

Fields object_in(const std::string& text, const std::string& name) { return {parse_json(text, name), name}; }

std::vector<Fields> questions_in(const std::string& text, const std::string& name, const std::string& schema) {
    Fields file = object_in(text, name);
    (void)file.one_of("schema", {schema});
    std::vector<Fields> questions;
    std::set<std::string> names;
    for (Json& question : file.list("questions", Limits::questions, true)) {
        const std::string place = fmt::format("{}: questions[{}]", name, questions.size());
        if (!question.is_object() || !question.contains("name") || !question["name"].is_string() ||
            !is_name(question["name"].get<std::string>())) {
            throw_bad_input(fmt::format("{}: expected a name of 1 to {} small letters, digits, _ and -, found {}",
                                        place, Limits::name, shortened(question)));
        }
        const auto own = question["name"].get<std::string>();
        if (!names.insert(own).second) {
            throw_bad_input(fmt::format("{}: expected names that differ, found {} twice", place, own));
        }
        questions.emplace_back(std::move(question), fmt::format("{}: {}", name, own));
    }
    if (questions.empty()) {
        throw_bad_input(fmt::format("{}: questions: expected at least one, found none", name));
    }
    file.refuse_rest("schema and questions");
    return questions;
}

}  // namespace gap::exam
