#include "bench/target/target_build.hpp"

#include <fmt/format.h>

#include "base/failure.hpp"
#include "bench/rows/row.hpp"

namespace bench {

TargetBuild parse_target_build(const std::string& text, const std::string& name) {
    constexpr std::size_t longest = 4096;
    const Json found = text.size() > 4 * longest ? Json() : Json::parse(text, nullptr, false);
    const auto field = [&](const char* key) {
        const auto value = found.find(key);  // not copied: what stands there may be of any depth
        if (value == found.end() || !value->is_string() || value->get_ref<const std::string&>().size() > longest) {
            throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: expected JSON with the text {}", name, key));
        }
        return value->get<std::string>();
    };
    return {field("compiler"), field("flags")};
}

}  // namespace bench
