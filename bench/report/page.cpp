#include "bench/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "bench/build_info.hpp"
#include "bench/parallel.hpp"
#include "bench/report/columns.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/results.hpp"
#include "bench/signals.hpp"
#include "bench/truncation_bound.hpp"
#include "glsum/weights.hpp"
#include "qemu/failure.hpp"

namespace bench::report {
namespace {

// Bounds take samples^2 steps for each order and signal.
constexpr std::size_t most_samples = 20'000;
constexpr std::size_t most_cases = 1'000;

template <class T>
std::optional<T> to_number(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// An order and signal whose record can be made again, and the lengths that it was measured at.
struct Case {
    std::string order;
    std::string signal;
    std::set<std::size_t> lengths;
    std::vector<double> bounds;
};

// {"of": {order: {signal: {taps: bound}}}}, or {"missing": why there is none}.
Json bounds_of(const Results& results, unsigned jobs) {
    const auto samples = results.context.find("n_samples");
    const auto seed = results.context.find("seed");
    Json json;
    if (samples == results.context.end() || seed == results.context.end() || !samples->is_number_unsigned() ||
        !seed->is_number_unsigned()) {
        json["missing"] = "the context has no n_samples and seed, so the records cannot be made again";
        return json;
    }
    if (*samples < 2 || *samples > most_samples) {
        json["missing"] =
            fmt::format("records of {} samples: bounds are drawn up to {}", samples->dump(), most_samples);
        return json;
    }
    std::map<std::string, Case> by_key;
    for (const Json& row : results.rows) {
        const auto key = parse_key(row.value("name", ""));
        if (!key || key->aspect != "accuracy" || !key->amplitude.empty() ||
            std::find(std::begin(signal_names), std::end(signal_names), key->signal) == std::end(signal_names)) {
            continue;
        }
        const auto taps = to_number<std::size_t>(key->taps);
        const auto order = to_number<double>(key->order);
        if (taps && order && glsum::order_in_range(*order)) {
            Case& found = by_key[key->order + '/' + key->signal];
            found.order = key->order;
            found.signal = key->signal;
            found.lengths.insert(*taps);
        }
    }
    if (by_key.size() > most_cases) {
        json["missing"] =
            fmt::format("{} pairs of order and signal: bounds are drawn for up to {}", by_key.size(), most_cases);
        return json;
    }
    std::vector<Case> cases;
    for (auto& [key, found] : by_key) {
        cases.push_back(std::move(found));
    }
    parallel_for(cases.size(), jobs, [&](std::size_t i) {
        const std::vector<std::size_t> lengths(cases[i].lengths.begin(), cases[i].lengths.end());
        cases[i].bounds = truncation_bounds(*to_number<double>(cases[i].order), cases[i].signal, lengths,
                                            samples->get<std::size_t>(), seed->get<std::uint64_t>());
    });
    json["of"] = Json::object();
    for (const Case& found : cases) {
        std::size_t i = 0;
        for (const std::size_t taps : found.lengths) {
            json["of"][found.order][found.signal][std::to_string(taps)] = found.bounds[i++];
        }
    }
    return json;
}

Json to_json(const Input& input, unsigned jobs) {
    Json json;
    json["name"] = input.name;
    json["context"] = input.results.context;
    json["bounds"] = bounds_of(input.results, jobs);
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

std::string make_page(const Input& input, const Input* other, unsigned jobs) {
    Json data;
    data["version"] = build_info::version;
    data["d3"] = page_parts::d3_version;
    data["files"] = Json::array({to_json(input, jobs)});
    if (other != nullptr) {
        data["files"].push_back(to_json(*other, jobs));
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
