// The fields of a JSON object, taken one by one; what is wrong is said with the file's name and the field's.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace drive {

using Json = nlohmann::ordered_json;

/// \param name  begins every message \param what  is expected: "a model"
/// \throws glsum::Failure (bad input) with the line: no JSON, values nested more than 8 deep, a number beyond double
/// precision.
[[nodiscard]] Json parse_json(const std::string& text, const std::string& name, const std::string& what);

/// At most 60 characters of a value, for a message.
[[nodiscard]] std::string shortened(const Json& value);

/// Each field that is taken is gone, so that what is left is not ours. Every failure is glsum::Failure (bad input).
class Fields {
public:
    /// \throws unless `object` is one
    Fields(Json object, std::string name);

    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// \throws when it is not there
    Json take(const char* key);
    /// \throws when it is not there or no number
    double number(const char* key);
    double number_or(const char* key, double otherwise) { return has(key) ? number(key) : otherwise; }

    /// \param expected  the fields' names, for the message \throws when a field is left
    void refuse_rest(const std::string& expected) const;
    /// What is left, as JSON; empty when nothing is.
    [[nodiscard]] std::string rest() const { return object_.empty() ? "" : object_.dump(); }

private:
    Json object_;
    std::string name_;
};

}  // namespace drive
