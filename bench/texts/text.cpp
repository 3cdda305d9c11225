#include "bench/texts/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "base/failure.hpp"

namespace generate {

std::string fill(std::string_view text, const Places& places) {
    return fill(text, [&](std::string_view name) {
        const auto place = places.find(name);
        return place != places.end() ? place->second : throw std::out_of_range("no such place: " + std::string(name));
    });
}

std::string fill(std::string_view text, const std::function<std::string(std::string_view)>& find) {
    std::string filled;
    while (!text.empty()) {
        const std::size_t at = text.find('@');
        filled += text.substr(0, at);
        if (at == std::string_view::npos) {
            break;
        }
        const std::size_t end = text.find('@', at + 1);
        if (end == std::string_view::npos) {
            throw std::out_of_range("a place without an end: " + std::string(text.substr(at)));
        }
        filled += find(text.substr(at + 1, end - at - 1));
        text.remove_prefix(end + 1);
    }
    return filled;
}

std::string upper(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return word;
}

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

bool is_identifier(const std::string& text) {
    return !text.empty() && text.size() <= 60 && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

void check_prefix(const std::string& prefix) {
    if (!is_identifier(prefix)) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("--prefix: expected letters, digits and underscores, found {}", prefix));
    }
}

std::string prefix_of_file(const std::filesystem::path& file) {
    std::string prefix = file.stem().string();
    for (char& letter : prefix) {
        letter = is_identifier(std::string("_") + letter) ? letter : '_';
    }
    return is_identifier(prefix) ? prefix : ("glsum_" + prefix).substr(0, 60);
}

}  // namespace generate
