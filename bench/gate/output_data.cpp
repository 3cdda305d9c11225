// The outputs that programs read: JSON, JUnit.
#include <fmt/format.h>

#include <unordered_map>

#include "bench/gate/outputs.hpp"
#include "bench/rows/row.hpp"

namespace bench::gate {
namespace {

void put(Json& json, const char* key, const std::optional<double>& value) {
    if (value) {
        json[key] = *value;
    }
}

Json to_json(const Finding& finding) {
    Json json;
    json["level"] = name_of(finding.level);
    json["layer"] = name_of(finding.layer);
    json["row"] = finding.row;
    if (!finding.counter.empty()) {
        json["counter"] = finding.counter;
    }
    put(json, "baseline", finding.baseline);
    put(json, "current", finding.current);
    put(json, "change", finding.change);
    put(json, "change_low", finding.change_low);
    put(json, "change_high", finding.change_high);
    json["what"] = finding.what;
    if (!finding.reason.empty()) {
        json["reason"] = finding.reason;
    }
    return json;
}

std::string_view name_of(Effect effect) {
    switch (effect) {
        case Effect::incomparable:
            return "incomparable";
        case Effect::advisory:
            return "advisory";
        case Effect::note:
            return "note";
    }
    return "";
}

// What XML cannot hold as it is; of control characters it holds three.
std::string escape_xml(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\t':
            case '\n':
            case '\r':
                escaped += fmt::format("&#{};", static_cast<int>(c));
                break;
            default:
                escaped += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
        }
    }
    return escaped;
}

std::string line_of(const Finding& finding) {
    return fmt::format("{}: {}{}{}{}", gate::name_of(finding.layer), finding.counter,
                       finding.counter.empty() ? "" : ": ", finding.what,
                       finding.reason.empty() ? "" : " (" + finding.reason + ")");
}

struct TestCase {
    std::string name;
    std::string failures;
    std::string other;
};

std::string to_xml(const TestCase& test) {
    std::string text = fmt::format("    <testcase classname=\"glsum.gate\" name=\"{}\"", escape_xml(test.name));
    if (test.failures.empty() && test.other.empty()) {
        return text + "/>\n";
    }
    text += ">\n";
    if (!test.failures.empty()) {
        const std::string first = test.failures.substr(0, test.failures.find('\n'));
        text +=
            fmt::format("      <failure message=\"{}\">{}</failure>\n", escape_xml(first), escape_xml(test.failures));
    }
    if (!test.other.empty()) {
        text += fmt::format("      <system-out>{}</system-out>\n", escape_xml(test.other));
    }
    return text + "    </testcase>\n";
}

}  // namespace

std::string to_json(const Verdict& verdict) {
    Json json;
    json["schema"] = "glsum-gate-1";
    json["verdict"] = verdict.word();
    json["exit_status"] = static_cast<int>(verdict.status);
    json["headline"] = verdict.headline();
    json["baseline"] = verdict.baseline_name;
    json["current"] = verdict.current_name;
    json["not_judged"] = verdict.not_judged;
    json["conditions"] = Json::array();
    for (const Difference& difference : verdict.differences) {
        json["conditions"].push_back({{"field", difference.field},
                                      {"baseline", difference.baseline},
                                      {"current", difference.current},
                                      {"effect", name_of(difference.effect)}});
    }
    json["rows"] = verdict.rows.size();
    json["layers"] = Json::array();
    for (const Layer layer : layers) {
        const LayerCount& count = verdict.count(layer);
        json["layers"].push_back({{"layer", gate::name_of(layer)},
                                  {"compared", count.compared},
                                  {"failed", count.failed},
                                  {"warned", count.warned},
                                  {"better", count.better},
                                  {"moot", count.moot},
                                  {"not_judged", count.not_judged}});
    }
    json["findings"] = Json::array();
    for (const Finding& finding : verdict.findings) {
        json["findings"].push_back(to_json(finding));
    }
    // Names come from files: what is no UTF-8 there must not stop the report.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_junit(const Verdict& verdict) {
    std::vector<TestCase> tests{{"conditions", "", ""}};
    if (!verdict.refusal.empty() || verdict.status == glsum::Exit::not_comparable) {
        tests.front().failures = verdict.headline();
    }
    for (const Difference& difference : verdict.differences) {
        tests.front().other +=
            fmt::format("{}: {} in the baseline, {} now\n", difference.field, difference.baseline, difference.current);
    }
    if (!verdict.not_judged.empty()) {
        tests.front().other += "not judged: " + verdict.not_judged + "\n";
    }
    std::unordered_map<std::string, std::size_t> at;
    if (verdict.status != glsum::Exit::not_comparable) {
        for (const std::string& row : verdict.rows) {
            at.emplace(row, tests.size());
            tests.push_back({row, "", ""});
        }
    }
    for (const Finding& finding : verdict.findings) {
        const auto [found, is_new] = at.try_emplace(finding.row, tests.size());
        if (is_new) {  // a lost kernel, a new row
            tests.push_back({finding.row, "", ""});
        }
        TestCase& test = tests[found->second];
        (finding.level == Level::fail ? test.failures : test.other) += line_of(finding) + "\n";
    }
    std::size_t failures = 0;
    std::string cases;
    for (const TestCase& test : tests) {
        failures += test.failures.empty() ? 0 : 1;
        cases += to_xml(test);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{0}\" failures=\"{1}\">\n"
        "  <testsuite name=\"glsum gate\" tests=\"{0}\" failures=\"{1}\" errors=\"0\" skipped=\"0\">\n{2}"
        "  </testsuite>\n</testsuites>\n",
        tests.size(), failures, cases);
}

}  // namespace bench::gate
