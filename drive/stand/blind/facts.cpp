#include "drive/stand/blind/facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/failure.hpp"

namespace stand::blind {

std::string to_json(const Facts& facts) {
    return nlohmann::ordered_json{{"schema", "glsum-case-1"}, {"domain", facts.domain}}.dump(2) + "\n";
}

Facts parse_facts(const std::string& text, const std::string& name) {
    const auto refuse = [&](const std::string& expected, const std::string& found) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: expected {}, found {}", name, expected, found.substr(0, 60)));
    };
    const auto file = nlohmann::json::parse(text, nullptr, false);
    if (!file.is_object()) {
        refuse("a JSON object", text);
    }
    const auto text_of = [&](const char* key) {
        return file.contains(key) && file[key].is_string() ? file[key].get<std::string>() : std::string("nothing");
    };
    if (text_of("schema") != "glsum-case-1") {
        refuse("the schema glsum-case-1", text_of("schema"));
    }
    const std::vector<std::string> domains{"mechanical", "thermal", "hydraulic", "electric"};
    const Facts facts{text_of("domain")};
    if (std::find(domains.begin(), domains.end(), facts.domain) == domains.end()) {
        refuse(fmt::format("one of the domains {}", fmt::join(domains, ", ")), facts.domain);
    }
    return facts;
}

}  // namespace stand::blind
