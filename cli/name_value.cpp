#include "cli/name_value.hpp"

namespace cli {

std::pair<std::string, std::string> split_at_equals(const std::string& word) {
    const auto at = word.find('=');
    return at == std::string::npos ? std::pair(word, std::string())
                                   : std::pair(word.substr(0, at), word.substr(at + 1));
}

}  // namespace cli
