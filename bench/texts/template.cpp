#include "bench/texts/template.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <stdexcept>

namespace generate {
namespace {

using Lines = std::vector<std::string_view>;

struct Text {
    Lines preamble;
    std::vector<std::pair<std::string_view, Lines>> sections;
    [[nodiscard]] const Lines* find(std::string_view name) const {
        for (const auto& [known, lines] : sections) {
            if (known == name) {
                return &lines;
            }
        }
        return nullptr;
    }
};

constexpr std::string_view file_mark = "%file-of ";
constexpr std::string_view section_mark = "%section ";

std::map<std::string_view, Text> read_texts() {
    std::map<std::string_view, Text> texts;
    Text* text = nullptr;
    for (std::string_view rest = header_texts; !rest.empty();) {
        const std::size_t length = std::min(rest.find('\n'), rest.size() - 1);
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(length + 1);
        if (line.starts_with(file_mark)) {
            text = &texts[line.substr(file_mark.size())];
        } else if (line.starts_with("%#")) {
            continue;
        } else if (line.starts_with(section_mark)) {
            text->sections.emplace_back(line.substr(section_mark.size()), Lines{});
        } else {
            (text->sections.empty() ? text->preamble : text->sections.back().second).push_back(line);
        }
    }
    return texts;
}

const std::map<std::string_view, Text>& texts() {
    static const std::map<std::string_view, Text> all = read_texts();
    return all;
}

const Text* find_text(std::string_view name) {
    const auto found = texts().find(name);
    return found == texts().end() ? nullptr : &found->second;
}

[[noreturn]] void refuse(const std::string& what) { throw std::out_of_range("texts of headers: " + what); }

// The part before the mark, which is taken off with it.
std::string_view take(std::string_view& rest, std::string_view mark) {
    const std::size_t at = rest.find(mark);
    const std::string_view part = rest.substr(0, at);
    rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + mark.size());
    return part;
}

std::string unquoted(std::string_view text) {
    return std::string(text.starts_with('"') ? text.substr(1, text.size() - 2) : text);
}

void add_words(Words& words, std::string_view pair) {
    const std::string_view from = take(pair, " => ");
    words[unquoted(from)] = unquoted(pair);
}

// A file of a core's own loops, in the names of the header; what is said to all headers at once keeps its own.
std::string whole(std::string_view name) {
    constexpr std::string_view ours = "GLSUM_";
    const Text* const file = find_text(name);
    std::string text;
    for (const std::string_view line : file != nullptr ? file->preamble : Lines{}) {
        text += std::string(line) + '\n';
    }
    for (std::size_t at = 0; (at = text.find(ours, at)) != std::string::npos;) {
        if (text.compare(at, 15, "GLSUM_CORTEX_M4") == 0) {
            at += ours.size();
        } else {
            text.replace(at, ours.size(), "@NAME@_");
        }
    }
    return text;
}

long number_of(std::string_view text) {
    long number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? number : throw std::out_of_range("no number");
}

}  // namespace

struct HeaderText::Scope {
    const std::string& chain;
    std::size_t at;  // of the text in its chain
    Words words = {};
    std::string list = {};  // whose items are gone through
    std::string item = {};  // its name before what is the item's own

    // A fact's name, or that of the item's own.
    [[nodiscard]] std::string named(std::string_view name) const {
        return !list.empty() && name.starts_with(list) ? item + std::string(name.substr(list.size()))
                                                       : std::string(name);
    }
};

bool has_section(std::string_view text, std::string_view section) {
    const Text* const found = find_text(text);
    return found != nullptr && found->find(section) != nullptr;
}

std::string HeaderText::section(const std::string& chain, std::string_view name, std::size_t from) {
    const std::vector<std::string>& names = chains.at(chain);
    for (std::size_t at = from; at < names.size(); ++at) {
        const Text* const text = find_text(names[at]);
        const Lines* const lines = text == nullptr ? nullptr : text->find(name);
        if (lines != nullptr) {
            Scope scope{chain, at};
            std::string out;
            run(text->preamble, 0, true, scope, out);
            out.clear();
            run(*lines, 0, true, scope, out);
            return out;
        }
    }
    refuse("no " + std::string(name) + " in " + chain);
}

std::size_t HeaderText::run(std::span<const std::string_view> lines, std::size_t at, bool active, Scope& scope,
                            std::string& out) {
    for (; at < lines.size(); ++at) {
        const std::string_view line = lines[at];
        const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
        if (indent == line.size() || line[indent] != '%') {
            out += active ? filled(line, scope) + "\n" : "";
            continue;
        }
        std::string_view rest = line.substr(indent + 1);
        const std::string_view word = take(rest, " ");
        if (word == "end" || word == "else") {
            return at;
        }
        if (word == "if") {
            const bool holding = active && holds(rest, scope);
            at = run(lines, at + 1, holding, scope, out);
            at = lines[at].ends_with("else") ? run(lines, at + 1, active && !holding, scope, out) : at;
        } else if (word == "each") {
            const long count = active ? facts[std::string(rest)] : 0;
            const std::size_t first = at + 1;
            at = run(lines, first, false, scope, out);
            scope.list = std::string(rest) + ".";
            for (long i = 0; i < count; ++i) {
                scope.item = scope.list + std::to_string(i) + ".";
                run(lines, first, true, scope, out);
            }
            scope.list.clear();
        } else if (active && word == "let") {
            const std::string fact(take(rest, " "));
            facts[fact] = holds(rest, scope) ? 1 : 0;
        } else if (active && word == "words") {
            add_words(scope.words, filled(rest, scope));
        } else if (active) {
            include(word, filled(rest, scope), indent, scope, out);
        }
    }
    return at;
}

void HeaderText::include(std::string_view word, std::string_view rest, std::size_t indent, Scope& scope,
                         std::string& out) {
    const std::string_view name = take(rest, " | ");
    Words own;
    while (!rest.empty()) {
        add_words(own, take(rest, " | "));
    }
    if (word == "file") {
        out += filled(whole(name), scope);
    } else if (word == "text" || (word == "optional" && place_of(name) != std::string_view::npos)) {
        Words words = scope.words;
        for (const auto& [from, to] : own) {
            words[from] = to;
        }
        out += filled(shared(name, words, indent), scope);
    } else if (word != "optional") {
        std::string text =
            word == "kept" ? section(scope.chain, name, scope.at + 1) : section(std::string(word), name, 0);
        for (const auto& [from, to] : own) {
            text = replaced(text, from, to);
        }
        out += text;
    }
}

bool HeaderText::holds(std::string_view condition, const Scope& scope) const {
    bool any = false;
    bool all = true;
    for (std::string_view rest = condition; !rest.empty();) {
        std::string_view word = take(rest, " ");
        if (word == "and" || word == "or") {
            any = word == "or" ? any || all : any;
            all = word == "or" ? true : all;
            continue;
        }
        const bool negated = word == "not";
        word = negated ? take(rest, " ") : word;
        const auto value = [&](std::string_view term) {
            const auto found = facts.find(scope.named(term));
            return found != facts.end() ? found->second : 0;
        };
        bool one = word == "true" || value(word) != 0;
        if (!rest.empty() && !rest.starts_with("and ") && !rest.starts_with("or ")) {
            const std::string_view sign = take(rest, " ");
            const std::string_view other = take(rest, " ");
            const long a = value(word);
            const long b = other.front() >= '0' && other.front() <= '9' ? number_of(other) : value(other);
            one = sign == "<"    ? a < b
                  : sign == ">"  ? a > b
                  : sign == ">=" ? a >= b
                  : sign == "==" ? a == b
                  : sign == "%"  ? a % b != 0
                                 : (refuse("no sign " + std::string(sign)), false);
        }
        all = all && one != negated;
    }
    return any || all;
}

std::string HeaderText::filled(std::string_view line, const Scope& scope) {
    return fill(line, [&](std::string_view name) {
        if (const auto place = places.find(name); place != places.end()) {
            return place->second;
        }
        if (const auto fact = facts.find(scope.named(name)); fact != facts.end()) {
            return std::to_string(fact->second);
        }
        std::string_view rest = name;
        const std::string chain(take(rest, " "));
        if (chain != "kept" && !chains.contains(chain)) {
            refuse("no place " + std::string(name));
        }
        std::string text = chain == "kept" ? section(scope.chain, rest, scope.at + 1) : section(chain, rest, 0);
        text.erase(text.find_last_not_of('\n') + 1);
        return text;
    });
}

std::string HeaderText::filled(std::string_view text) {
    const std::string none;
    return filled(text, Scope{none, 0});
}

std::string HeaderText::helpers(const std::vector<std::string>& of_chains, std::string used) {
    constexpr std::string_view mark = "helper ";
    std::vector<std::pair<std::string, std::string>> all;  // by the name that is called
    std::set<std::string_view> taken;
    for (const std::string& chain : of_chains) {
        for (const std::string& name : chains.at(chain)) {
            const Text* const text = find_text(name);
            for (const auto& [called, lines] : text == nullptr ? decltype(Text::sections){} : text->sections) {
                if (called.starts_with(mark) && taken.insert(called).second) {
                    all.emplace_back(called.substr(mark.size()), section(chain, called));
                }
            }
        }
    }
    std::string text;
    for (auto helper = all.rbegin(); helper != all.rend(); ++helper) {
        if (used.find(places.at("name") + "_" + helper->first + "(") != std::string::npos && !helper->second.empty()) {
            text = "\n" + helper->second + text;
            used += helper->second;
        }
    }
    return text;
}

}  // namespace generate
