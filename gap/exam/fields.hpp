// An object of a JSON file, taken field by field: what is not as expected is refused, and what nobody took, too.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gap::exam {

class Fields {
public:
    /// \param name  begins every message: the file, and the place in it
    Fields(nlohmann::ordered_json object, std::string name);

    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Of one to `Limits::text` bytes without control characters.
    std::string text(const char* key);
    std::string text_or(const char* key, const std::string& otherwise);
    std::string one_of(const char* key, const std::vector<std::string>& words);
    bool flag_or(const char* key, bool otherwise);
    /// Of a number that is finite and above 0; none where the field is not there.
    std::optional<double> positive(const char* key);
    /// Of at most `Limits::list` texts. \param least  texts; below, with 0, the field need not be there
    std::vector<std::string> texts(const char* key, std::size_t least);
    /// A list of at most `most` values; none where the field is not there and `needed` is false.
    std::vector<nlohmann::ordered_json> list(const char* key, std::size_t most, bool needed);
    nlohmann::ordered_json take(const char* key);
    [[noreturn]] void refuse(const std::string& key, const std::string& expected, const std::string& found) const;
    /// \param known  what may stand here, for the message
    void refuse_rest(const std::string& known) const;

private:
    nlohmann::ordered_json object_;
    std::string name_;
};

/// \throws glsum::Failure (bad input): too long, no JSON (with its line), values nested too deep, no object.
[[nodiscard]] Fields object_in(const std::string& text, const std::string& name);

/// The questions of a file with this schema. \throws glsum::Failure (bad input): as `object_in`, another schema, none
/// or too many questions, names that are none or twice.
[[nodiscard]] std::vector<Fields> questions_in(const std::string& text, const std::string& name,
                                               const std::string& schema);

}  // namespace gap::exam
