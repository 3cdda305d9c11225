#include "bench/texts/shared.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace generate {
namespace {

bool in_word(char letter) { return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_'; }

// What every text has alike.
const Words common = {
    {"accumulate<Format, fused>", "@call@multiply_add"},
    {"static_cast<", "("},
    {"if constexpr ", "if "},
    {", scale)", ")"},
    {", state.scale)", ")"},
    {"std::", ""},
    {"typename ", ""},
    {"window.", ""},
    {"Format::template ", "@name@_"},
    {"Format::zero()", "0"},
    {"Format::", "@name@_"},
    {"GLSUM_", "@NAME@_"},
    {"Accumulator", "@accumulator@"},
    {"Coefficient", "@coefficient@"},
    {"Sample", "@sample@"},
    {"Output", "@output@"},
};

// The longest of the words that `text` has here and that does not begin or end within another; null if none.
const Words::value_type* word_at(const Words& words, std::string_view text, std::size_t at) {
    const auto fits = [&](const Words::value_type& word) {
        const std::size_t end = at + word.first.size();
        return text.substr(at, word.first.size()) == word.first &&
               (at == 0 || !in_word(word.first.front()) || !in_word(text[at - 1])) &&
               (end == text.size() || !in_word(word.first.back()) || word.first.back() == '_' || !in_word(text[end]));
    };
    const auto found = std::find_if(words.begin(), words.end(), fits);
    return found == words.end() ? nullptr : &*found;
}

std::string in_c99(std::string_view text, const Words& words) {
    std::string result;
    std::size_t casts = 0;  // that are open
    for (std::size_t at = 0; at < text.size();) {
        const Words::value_type* word = word_at(words, text, at);
        word = word != nullptr ? word : word_at(common, text, at);
        if (word != nullptr) {
            if (word->first == "static_cast<") {
                ++casts;
            }
            result += word->second;
            at += word->first.size();
        } else if (text[at] == '>' && casts > 0) {
            --casts;
            result += ')';
            ++at;
        } else {
            result += text[at++];
        }
    }
    return result;
}

}  // namespace

std::size_t place_of(std::string_view name) {
    const std::string mark = "// C99: " + std::string(name) + "\n";
    const std::size_t marked = kernel_sources.find(mark);
    return marked == std::string_view::npos ? marked : marked + mark.size();
}

std::string shared(std::string_view name, const Words& words, std::size_t indent) {
    const std::size_t begin = place_of(name);
    if (begin == std::string_view::npos) {
        throw std::out_of_range("no kernel has the text " + std::string(name));
    }
    const std::size_t end = kernel_sources.rfind('\n', kernel_sources.find("// C99", begin));
    std::string_view text = kernel_sources.substr(begin, end + 1 - begin);
    const std::size_t margin = text.find_first_not_of(' ');
    std::string lines;
    while (!text.empty()) {
        const std::size_t length = text.find('\n') + 1;
        const std::string_view line = text.substr(0, length);
        const std::size_t first = line.find_first_not_of(' ');
        if (line.substr(first) == "GLSUM_ROLLED\n") {
            lines += "@rolled@";  // whole lines or none
        } else {
            lines += first < margin ? std::string(line) : std::string(indent, ' ') + std::string(line.substr(margin));
        }
        text.remove_prefix(length);
    }
    return in_c99(lines, words);
}

}  // namespace generate
