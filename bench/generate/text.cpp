#include "bench/generate/text.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace generate {

std::string fill(std::string_view text, const Places& places) {
    std::string filled;
    while (!text.empty()) {
        const std::size_t at = text.find('@');
        filled += text.substr(0, at);
        if (at == std::string_view::npos) {
            break;
        }
        const std::size_t end = text.find('@', at + 1);
        const auto place = places.find(text.substr(at + 1, end - at - 1));
        if (end == std::string_view::npos || place == places.end()) {
            throw std::out_of_range("no such place: " + std::string(text.substr(at, end - at + 1)));
        }
        filled += place->second;
        text.remove_prefix(end + 1);
    }
    return filled;
}

std::string upper(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
}

std::string helper(const std::string& result, const std::string& name, const std::string& arguments,
                   const std::string& body) {
    return "@NAME@_HELPER " + result + " @name@_" + name + "(" + arguments + ")\n{\n" + body + "}\n";
}

std::string accumulate(bool fused) { return fused ? "@name@_fused_multiply_add" : "@name@_multiply_add"; }

std::string rounded_once(bool fused) { return fused ? ", product and addition rounded once" : ""; }

}  // namespace generate
