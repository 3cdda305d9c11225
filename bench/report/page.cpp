#include "bench/report/page.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "base/build_info.hpp"
#include "bench/report/columns.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/rows/counters.hpp"
#include "glsum/catalogue.hpp"

namespace bench::report {
namespace {

// {"of": {order: {signal: {taps: bound}}}, "missing": why there is none, or empty}.
Json to_json(const TruncationBounds& bounds) {
    Json json;
    json["missing"] = bounds.missing;
    json["of"] = bounds.of;
    return json;
}

// Of the table of counters what the page shows, in its order.
Json shown_counters() {
    Json all = Json::array();
    for (const CounterFacts& facts : counter_table()) {
        if (facts.shown == Shown::nowhere) {
            continue;
        }
        Json counter;
        counter["name"] = facts.name;
        counter["family"] = facts.is_family;
        counter["is_time"] = facts.role == Role::time;
        counter["unit"] = facts.unit;
        counter["better"] = name_of(facts.better);
        counter["layer"] = name_of(facts.layer);
        counter["compared"] = facts.shown >= Shown::compared;
        counter["drawn"] = facts.shown >= Shown::drawn;
        counter["title"] = facts.title;
        counter["meaning"] = facts.meaning;
        all.push_back(std::move(counter));
    }
    return all;
}

// What the catalogue says of each kernel's name: {name: {history, technique, format, fixed: whether in fixed point}}.
Json words_of_kernels() {
    Json all;
    for (const glsum::CatalogueEntry& entry : glsum::catalogue) {
        if (!entry.format.empty()) {
            all[std::string(entry.name)] = {{"history", entry.history},
                                            {"technique", entry.technique},
                                            {"format", entry.format},
                                            {"fixed", entry.exact_sums}};
        }
    }
    return all;
}

Json to_json(const Input& input) {
    Json json;
    json["name"] = input.name;
    json["context"] = input.results.context;
    json["bounds"] = to_json(input.bounds);
    json["tables"] = to_tables(input.results.rows);
    return json;
}

void replace_all(std::string& text, std::string_view what, std::string_view with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
        text.replace(at, what.size(), with);
    }
}

// JSON in which nothing can end a script element or begin a comment or an entity.
std::string to_script_text(const Json& json) {
    std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<' || c == '>' || c == '&') {
            safe += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            safe += c;
        }
    }
    return safe;
}

std::string to_html_text(std::string text) {
    replace_all(text, "&", "&amp;");
    replace_all(text, "<", "&lt;");
    replace_all(text, ">", "&gt;");
    replace_all(text, "\"", "&quot;");
    return text;
}

// The template with each {{name}} replaced once; what comes in is not looked at again.
std::string fill(std::string_view page, const std::map<std::string, std::string_view, std::less<>>& parts) {
    std::string filled;
    for (;;) {
        const std::size_t begin = page.find("{{");
        filled += page.substr(0, begin);
        if (begin == std::string_view::npos) {
            return filled;
        }
        const std::size_t end = page.find("}}", begin);
        filled += parts.at(std::string(page.substr(begin + 2, end - begin - 2)));
        page.remove_prefix(end + 2);
    }
}

}  // namespace

std::string make_page(const Input& input, const Input* other) {
    Json data;
    data["version"] = build_info::version;
    data["d3"] = page_parts::d3_version;
    data["counters"] = shown_counters();
    data["kernels"] = words_of_kernels();
    data["files"] = Json::array({to_json(input)});
    if (other != nullptr) {
        data["files"].push_back(to_json(*other));
    }
    const std::string text = to_script_text(data);
    const std::string title =
        to_html_text("glsum: " + input.name + (other != nullptr ? " and " + other->name : std::string()));
    return fill(page_parts::html, {{"title", title},
                                   {"css", page_parts::css},
                                   {"css_hash", page_parts::css_hash},
                                   {"d3", page_parts::d3},
                                   {"d3_hash", page_parts::d3_hash},
                                   {"js", page_parts::js},
                                   {"js_hash", page_parts::js_hash},
                                   {"data", text}});
}

}  // namespace bench::report
