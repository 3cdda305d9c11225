#include "bench/generate/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
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

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
    return text;
}

std::string licence_line(const std::string& licence) { return licence.empty() ? "" : "Licence: " + licence + ".\n"; }

std::string float_literal(double value) {
    constexpr double most = std::numeric_limits<float>::max();
    std::string text = fmt::format("{}", static_cast<float>(std::clamp(value, -most, most)));
    return text + (text.find_first_of(".e") == std::string::npos ? ".0F" : "F");
}

std::string fingerprint(std::string_view text) {
    std::uint64_t hash = 0xCBF29CE484222325U;  // FNV-1a
    for (const char letter : text) {
        hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3U;
    }
    return fmt::format("{:016X}", hash);
}

std::string include_guard(const std::string& name, const std::string& design, const std::string& identity) {
    return fill(R"(#if defined(@NAME@_H) && !defined(@NAME@_IS_@identity@)
#define @NAME@_DESIGN "@design@"
#error "@name@: another design of this prefix was included before (see the two DESIGN); make one with another --prefix"
#endif
#ifndef @NAME@_H
#define @NAME@_H
#define @NAME@_IS_@identity@
#define @NAME@_DESIGN "@design@"
)",
                {{"name", name}, {"NAME", upper(name)}, {"design", design}, {"identity", identity}});
}

}  // namespace generate
