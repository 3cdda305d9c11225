// The page as a person uses it, in a headless Chromium. Exit status 77 (skipped) where there is none, unless
// GLSUM_REQUIRE_BROWSER=1.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "base/files.hpp"
#include "bench/report/best.hpp"
#include "bench/report/curves.hpp"
#include "bench/report/page.hpp"
#include "bench/rows/key.hpp"
#include "tests/report/browser.hpp"
#include "tests/report/pretend_results.hpp"

namespace {

using test::Browser;
using Json = Browser::Json;
namespace key = test::key;

class Page : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string name = (std::filesystem::temp_directory_path() / "glsum-browser-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
        browser = std::make_unique<Browser>(folder);
        browser->open("about:blank");
        (void)browser->requests();  // the browser's own first page
        input = to_input("first.json", test::pretend_results(4000, 1));
    }
    static void TearDownTestSuite() {
        browser.reset();
        std::filesystem::remove_all(folder);
    }
    void TearDown() override {
        // Whatever a test did: the page said nothing on the console and asked for nothing but itself.
        EXPECT_EQ(browser->console(), std::vector<std::string>{});
        for (const std::string& url : browser->requests()) {
            EXPECT_TRUE(url.starts_with("file://" + folder.string()) || url.starts_with("data:")) << url;
        }
        browser->devtools("Emulation.clearDeviceMetricsOverride", Json::object());
        Json media;
        media["features"] = Json::array();
        browser->devtools("Emulation.setEmulatedMedia", media);
    }

    static bench::report::Input to_input(const std::string& name, bench::Results results) {
        auto bounds = bench::truncation_bounds(results.context, results.rows, 2);
        return {name, std::move(results), std::move(bounds)};
    }
    static void open(const bench::report::Input& a, const bench::report::Input* b = nullptr,
                     const std::string& hash = "") {
        const auto path = folder / "page.html";
        base::write_file(path, make_page(a, b));
        browser->open("about:blank");
        browser->open("file://" + path.string() + hash);
        for (int tries = 0; run("return document.documentElement.dataset.drawn || ''") != "all"; ++tries) {
            ASSERT_LT(tries, 200) << "never drawn as a whole";
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    static Json run(const std::string& script, const Json& arguments = Json::array()) {
        return browser->run(script, arguments);
    }
    static int count(const std::string& selector) {
        return run("return document.querySelectorAll(arguments[0]).length", Json::array({selector}));
    }
    static std::string text(const std::string& selector) {
        return run("return document.querySelector(arguments[0]).textContent", Json::array({selector}));
    }
    // For a person to read: times are no test. -1: the browser has not said yet when it painted.
    static void print_times(const char* what) {
        const Json times =
            run("return [(performance.getEntriesByName('first-contentful-paint')[0] || {startTime: -1}).startTime,"
                "performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd,"
                "performance.getEntriesByName('drawn')[0].startTime]");
        std::printf("%s: first paint after %.0f ms, curves drawn after %.0f ms, all after %.0f ms\n", what,
                    times[0].get<double>(), times[1].get<double>(), times[2].get<double>());
    }
    // What the tip says of a name; empty when it says nothing of it or is hidden.
    static std::string tip(const std::string& name) {
        return run(
            "const tip = document.getElementById('tip'); if (tip.hidden) return '';"
            "const term = [...tip.querySelectorAll('dt')].find(term => term.textContent === arguments[0]);"
            "return term ? term.nextSibling.textContent : ''",
            Json::array({name}));
    }
    static double tip_number(const std::string& name) {
        std::string digits = tip(name);
        digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
        return digits.empty() ? std::nan("") : std::stod(digits);
    }
    // Where the first mark of a kernel stands in a panel, after scrolling there.
    static std::pair<double, double> first_mark(const std::string& order, const std::string& axis,
                                                const std::string& kernel) {
        const Json place = run(
            "const svg = "
            "document.querySelector(`svg.panel[data-order='${arguments[0]}'][data-axis='${arguments[1]}']`);"
            "svg.scrollIntoView({block: 'center'});"
            "const line = svg.querySelector(`g[data-kernel='${arguments[2]}'] .line`);"
            "const point = line.getPointAtLength(0).matrixTransform(line.getScreenCTM()); return [point.x, point.y]",
            Json::array({order, axis, kernel}));
        return {place[0], place[1]};
    }
    static double worst(const std::string& kernel, const std::string& order, const std::string& taps,
                        const std::string& counter) {
        double largest = 0.0;
        for (const bench::Json& row : input.results.rows) {
            const auto key = bench::parse_key(row["name"].get<std::string>());
            if (key->kernel == kernel && key->order == order && key->taps == taps && key->aspect == "accuracy") {
                largest = std::max(largest, row[counter].get<double>());
            }
        }
        return largest;
    }

    static inline std::filesystem::path folder;
    static inline std::unique_ptr<Browser> browser;
    static inline bench::report::Input input;
};

TEST_F(Page, DrawsAPanelForEachOrderAndCost) {
    open(input);
    EXPECT_EQ(count("svg.panel[data-axis=taps]"), 4);  // the first four orders
    EXPECT_EQ(count("svg.panel[data-axis=host]"), 4);
    EXPECT_EQ(count("svg.panel[data-axis='cycles-m7:pretend']"), 4);
    EXPECT_EQ(count("svg.panel[data-axis=bytes]"), 4);
    EXPECT_EQ(count("svg.panel[data-axis=taps] .reference.bound"), 4);
    EXPECT_EQ(count("svg.panel[data-axis='cycles-m7:pretend'][data-order='0.2'] .band"), 40);
    EXPECT_EQ(count("#kernels button"), 40);
    EXPECT_EQ(run("return performance.getEntriesByType('resource').length"), 0);
    EXPECT_EQ(run("return document.body.innerText.match(/NaN|undefined|Infinity/)"), Json());
    print_times("4000 rows");
}

TEST_F(Page, HoverTellsTheNumbersOfTheFile) {
    open(input, nullptr, "#find=ring_plain_q31");
    const auto [x, y] = first_mark("0.5", "taps", "ring_plain_q31");
    browser->move_to(x, y);
    EXPECT_EQ(text("#tip strong"), "ring_plain_q31");
    EXPECT_EQ(tip("order"), "0.5");
    EXPECT_EQ(tip("taps"), "50");
    EXPECT_NEAR(tip_number("total error") / worst("ring_plain_q31", "0.5", "50", "error_max"), 1.0, 1e-3);
    EXPECT_NEAR(tip_number("rounding error") / worst("ring_plain_q31", "0.5", "50", "rounding_error_max"), 1.0, 1e-3);
    EXPECT_NEAR(tip_number("truncation bound") / worst_of_signals(input.bounds).at("0.5").at("50"), 1.0, 1e-3);
    EXPECT_EQ(tip("state + coefficients"), "424 B");
    browser->move_to(5, 5);
    EXPECT_EQ(run("return document.getElementById('tip').hidden"), true);
}

TEST_F(Page, HoverFollowsTheKindOfErrorAndTheSignal) {
    open(input, nullptr, "#find=ring_plain_q31&error=truncation_error_max&signal=sine5");
    const auto [x, y] = first_mark("0.5", "bytes", "ring_plain_q31");
    browser->move_to(x, y);
    const bench::Json* row = nullptr;
    for (const bench::Json& each : input.results.rows) {
        row = each["name"] == "gl/ring_plain_q31/order:0.5/taps:50/accuracy/signal:sine5" ? &each : row;
    }
    EXPECT_NEAR(tip_number("truncation error") / (*row)["truncation_error_max"].get<double>(), 1.0, 1e-3);
    EXPECT_EQ(tip("signal"), "sine5");
    EXPECT_EQ(text("#curves-title"), "Truncation error of the sum");
}

TEST_F(Page, FiltersByClickAndKeepsThemInTheAddress) {
    open(input);
    EXPECT_GT(count("#panels g[data-kernel$=_f32]"), 0);
    browser->click("#words-format input[value=f32]");
    browser->click("#words-history input[value=ring]");
    browser->click("#taps input[value='50']");
    browser->click("#orders input[value='0.2']");
    browser->click("#axes input[value=bytes]");
    const auto check = [&] {
        EXPECT_EQ(count("#panels g[data-kernel$=_f32], #kernels button[data-kernel$=_f32]"), 0);
        EXPECT_EQ(count("#panels g[data-kernel^=ring_]"), 0);
        EXPECT_GT(count("#panels g[data-kernel=shift_fir_q15]"), 0);
        EXPECT_EQ(count("svg.panel[data-order='0.2']"), 0);
        EXPECT_EQ(count("svg.panel[data-axis=bytes]"), 0);
        EXPECT_EQ(run("return [...document.querySelectorAll('#row-table tbody tr')].some(row => "
                      "/_f32$/.test(row.cells[0].textContent)"
                      " || row.cells[2].textContent === '50')"),
                  false);
    };
    check();
    const std::string hash = run("return location.hash");
    EXPECT_NE(hash.find("no-format=f32"), std::string::npos) << hash;
    open(input, nullptr, hash);
    check();
    browser->click("#reset");
    EXPECT_GT(count("#panels g[data-kernel$=_f32]"), 0);
    EXPECT_EQ(run("return location.hash"), "");
}

TEST_F(Page, EverythingIsReachedByKeys) {
    open(input, nullptr, "#find=ring_plain");
    std::set<std::string> reached;
    bool visible = true;
    for (int stop = 0; stop < 140 && !reached.contains("panel taps"); ++stop) {
        browser->press(key::tab);
        const Json focus =
            run("const node = document.activeElement; const style = getComputedStyle(node.matches('.chip input') ? "
                "node.nextSibling : node);"
                "return [node.id || node.value || node.dataset.kernel || (node.dataset.axis ? 'panel ' + "
                "node.dataset.axis : ''), "
                "node.tagName.toLowerCase(), style.outlineStyle]");
        reached.insert(focus[0].get<std::string>());
        reached.insert(focus[1].get<std::string>());
        visible = visible && focus[2] != "none";
    }
    EXPECT_TRUE(visible) << "an element has the focus and does not show it";
    for (const char* name :
         {"theme", "ask-order", "ask-error", "ask-target", "panel answer", "error", "signal", "0.5", "host", "linear",
          "fronts", "reset", "colour", "q31", "find", "ring_plain_f32", "panel taps"}) {
        EXPECT_TRUE(reached.contains(name)) << name;
    }
    // In the first panel, over the memory length: along a kernel and across.
    EXPECT_NE(tip("taps"), "");
    browser->press(key::home);
    EXPECT_EQ(tip("taps"), "50");
    browser->press(key::right);
    EXPECT_EQ(tip("taps"), "62");
    const std::string before = text("#tip strong");
    const double error = tip_number("total error");
    for (int i = 0; i < 5; ++i) {
        browser->press(key::down);
    }
    EXPECT_LE(tip_number("total error"), error);
    for (int i = 0; i < 5; ++i) {
        browser->press(key::up);
    }
    EXPECT_GE(tip_number("total error"), error);
    EXPECT_NE(text("#tip strong"), "");
    const std::string kernel = text("#tip strong");
    browser->press(key::enter);
    EXPECT_EQ(count("#kernels button[aria-pressed=true]"), 1);
    EXPECT_EQ(run("return document.querySelector('#kernels button[aria-pressed=true]').dataset.kernel"), kernel);
    EXPECT_EQ(run("return document.activeElement.matches('svg.panel')"), true) << "the focus is lost";
    browser->press(key::escape);
    EXPECT_EQ(run("return document.getElementById('tip').hidden"), true);
}

TEST_F(Page, TheFrontIsThatOfTheTables) {
    open(input);
    const auto groups = bench::group(input.results.rows);
    const auto costs = bench::report::costs_of(groups);
    const auto points = bench::report::curve_points(groups, costs);
    for (std::size_t c = 0; c < costs.size(); ++c) {
        const std::string axis = costs[c].name == "host_ns"                   ? "host"
                                 : costs[c].name.starts_with("model_cycles:") ? "cycles-m7:pretend"
                                                                              : costs[c].name;
        std::set<std::string> expected;
        for (const auto& point : points) {
            if (point.front[c] && point.group->order == "0.5") {
                expected.insert(point.entry->kernel + " " + point.group->taps);
            }
        }
        const std::set<std::string> found = run(
            "const {placed, pointsOf} = modules['select.js'];"
            "const all = modules['catalogue.js'].catalogueOf(JSON.parse(document.getElementById('data').textContent));"
            "const {now} = modules['state.js'].makeState(modules['choices.js'].choicesOf(all));"
            "return placed(pointsOf(all, now, all.files[0], '0.5'), all.axes.find(axis => axis.id === arguments[0]))"
            ".filter(point => point.front).map(point => point.kernel + ' ' + point.taps)",
            Json::array({axis}));
        EXPECT_EQ(found, expected) << axis;
        EXPECT_FALSE(expected.empty()) << axis;
    }
}

TEST_F(Page, TextsOfAFileStayTexts) {
    const std::string kernel = "x_<img src=x onerror=window.stolen=1>_</script><script>window.stolen=1</script>";
    bench::Results results = test::pretend_results(400, 2);
    results.context["cpu"] = "</title></script><script>window.stolen=1</script>";
    for (std::size_t i = 0; i < 8; ++i) {
        results.rows[i]["name"] =
            "gl/" + kernel.substr(0, kernel.find("</")) + "/order:0.2/taps:50/accuracy/signal:s" + std::to_string(i);
    }
    results.rows[9]["name"] = kernel;
    bench::mark_error(results.rows[10], "<b onclick=alert(1)>wrong</b> \u2028 & \"quoted\"");
    open(to_input("</title><script>window.stolen=1</script>.json", results));
    EXPECT_EQ(run("return window.stolen"), Json());
    EXPECT_EQ(count("#tip img, main img, aside img, main b"), 0);
    EXPECT_EQ(run("return document.title"), "glsum: </title><script>window.stolen=1</script>.json");
    EXPECT_NE(text("#fault-table").find("<b onclick=alert(1)>wrong</b>"), std::string::npos);
    EXPECT_EQ(text("#kernels").find("onerror"), std::string::npos);  // no name of a kernel: such rows are not read
    EXPECT_NE(text("#context-table").find("</title></script><script>"), std::string::npos);
}

TEST_F(Page, WrongRowsAreListedAndNotDrawn) {
    bench::Results results = input.results;
    for (bench::Json& row : results.rows) {
        if (row["name"] == "gl/ring_plain_q15/order:0.2/taps:50/m7:pretend") {
            bench::mark_error(row, "the target's outputs differ");
        }
    }
    open(to_input("wrong.json", results), nullptr, "#find=ring_plain_q15&orders=0.2");
    const auto [x, y] = first_mark("0.2", "taps", "ring_plain_q15");
    browser->move_to(x, y);
    EXPECT_EQ(tip("taps"), "62");  // not 50: a kernel with a wrong row is ranked by no other row
    EXPECT_EQ(count("#fault-table tbody tr"), 1);
    EXPECT_NE(text("#fault-table").find("the target's outputs differ"), std::string::npos);
}

TEST_F(Page, TwoFilesAreOverlaidAndTheLargestChangeComesFirst) {
    bench::Results other = input.results;
    const std::string changed = "gl/ring_plain_q31/order:0.5/taps:50/m7:pretend";
    for (bench::Json& row : other.rows) {
        if (row["name"] == changed) {
            row["instructions_per_sample"] = row["instructions_per_sample"].get<double>() * 4.0;
        } else if (row["name"] == "gl/ring_plain_f32/order:0.5/taps:62/accuracy/signal:step") {
            row["error_max"] = row["error_max"].get<double>() * 0.5;
        }
    }
    other.context["compiler"] = "another";
    const auto b = to_input("second.json", other);
    open(input, &b);
    EXPECT_GT(count("svg.panel .kernel.second"), 0);
    EXPECT_EQ(run("return getComputedStyle(document.querySelector('svg.panel .kernel.second .line')).strokeDasharray"),
              "5px, 3px");
    EXPECT_EQ(count("#difference-table tbody tr"), 2);
    EXPECT_NE(text("#difference-table tbody tr").find("instructions_per_sample"), std::string::npos);
    EXPECT_EQ(text("#difference-table tbody tr td:nth-child(7)"), "4.000");
    EXPECT_NE(text("#notices").find("compiler"), std::string::npos);
    browser->click("#counter");
    run("const select = document.getElementById('counter'); select.value = 'error_max'; select.dispatchEvent(new "
        "Event('change'))");
    EXPECT_EQ(count("#difference-table tbody tr"), 1);
    EXPECT_EQ(text("#difference-table tbody tr td:nth-child(7)"), "0.5000");
    EXPECT_EQ(count("#context-table tr.differs"), 1);
}

// Question, answer, chart and table stand on the first screen, and with two files what is better and worse.
TEST_F(Page, TheFirstScreenAnswers) {
    Json laptop;
    laptop["width"] = 1280;
    laptop["height"] = 720;
    laptop["deviceScaleFactor"] = 1;
    laptop["mobile"] = false;
    browser->devtools("Emulation.setDeviceMetricsOverride", laptop);
    const auto bottom = [](const char* selector) {
        return run("return document.querySelector(arguments[0]).getBoundingClientRect().bottom",
                   Json::array({selector}))
            .get<double>();
    };
    const auto choose = [](const char* id, const char* value) {
        run("const select = document.getElementById(arguments[0]); select.value = arguments[1]; "
            "select.dispatchEvent(new Event('change'))",
            Json::array({id, value}));
    };
    open(input);
    EXPECT_EQ(count("#question select"), 3);
    EXPECT_LE(bottom("#answer-panel svg"), 720.0);
    EXPECT_LE(bottom("#answer-table"), 720.0);
    EXPECT_TRUE(run("return document.getElementById('changes').hidden").get<bool>());

    choose("ask-error", "1e-3");
    choose("ask-order", "0.9");
    // The cheapest of the file, found here by going over its rows.
    const auto groups = bench::group(input.results.rows);
    const auto costs = bench::report::costs_of(groups);
    const auto points = bench::report::curve_points(groups, costs);
    const auto cost = bench::report::deciding_cost(costs);
    const auto* best = bench::report::cheapest(points, costs[*cost], "0.9", 1e-3, bench::report::Memory::any);
    ASSERT_NE(best, nullptr);
    const std::string expected = "Within 1e-3 (0.1 %) at order 0.9 the cheapest is " + best->entry->kernel + " of " +
                                 best->group->taps + " taps: ";
    EXPECT_TRUE(text("#answer-text").starts_with(expected)) << text("#answer-text");
    EXPECT_EQ(text("#answer-table tr.chosen td"), best->entry->kernel);
    const std::string hash = run("return location.hash");
    EXPECT_EQ(hash, "#ask-order=0.9&ask-error=1e-3");
    open(input, nullptr, hash);
    EXPECT_TRUE(text("#answer-text").starts_with(expected)) << text("#answer-text");
    choose("ask-error", "1e-6");
    EXPECT_EQ(text("#answer-text"), "No kernel of this file errs 1e-6 (0.0001 %) or less at order 0.9.");

    EXPECT_TRUE(run("return document.getElementById('cores').hidden").get<bool>());  // one machine's rows alone

    // With a second machine's rows both stand beside each other, the one that was chosen for each marked.
    bench::report::Input both = input;
    for (const bench::Json& row : input.results.rows) {
        std::string name = row["name"];
        if (const std::size_t at = name.find("/m7:pretend"); at != std::string::npos) {
            bench::Json slower = row;
            slower["name"] = name.replace(at, std::string::npos, "/m4:other");
            slower["model_cycles_per_sample"] = 2.0 * row["model_cycles_per_sample"].get<double>();
            slower["real_time"] = 1000.0;
            both.results.rows.push_back(std::move(slower));
        }
    }
    open(both);
    choose("ask-error", "1e-3");
    choose("ask-order", "0.9");
    EXPECT_FALSE(run("return document.getElementById('cores').hidden").get<bool>());
    EXPECT_EQ(count("#cores-table tbody tr"), 2);
    EXPECT_EQ(text("#cores-table tbody tr td"), "M7 pretend");
    EXPECT_EQ(text("#cores-table tbody tr:nth-child(2) td"), "M4 other");
    EXPECT_EQ(text("#cores-table tbody tr:nth-child(2) td:nth-child(6)"), "1");  // us
    EXPECT_EQ(count("#cores-table tr.chosen"), 2);

    bench::Results other = input.results;
    for (bench::Json& row : other.rows) {
        if (const std::string name = row["name"];
            name.starts_with("gl/ring_plain_q31/order:0.5/") && name.ends_with("m7:pretend")) {
            row["code_bytes"] = 240;
        }
    }
    const auto b = to_input("second.json", other);
    open(input, &b);
    EXPECT_LE(bottom("#changes-table"), 720.0);
    EXPECT_EQ(count("#changes-table tbody tr"), 1) << "a line for all lengths of a kernel";
    EXPECT_EQ(text("#changes-table tbody tr td:nth-child(3)"), "worse");
    EXPECT_EQ(text("#changes-table tbody tr td:nth-child(4)"), "+100 %");
}

TEST_F(Page, StallsAreStackedToTheModelledCycles) {
    open(input);
    EXPECT_EQ(run("return document.getElementById('stalls').hidden"), false);
    EXPECT_EQ(count("svg.stalls .stack"), 40);
    // Issue, fpu latency, load use: their widths are to each other as the counters are.
    const Json widths = run(
        "return Object.fromEntries([...document.querySelectorAll('svg.stalls .stack[data-kernel=ring_plain_q31] .bar')]"
        ".map(bar => [bar.dataset.cause || 'issuing', Number(bar.getAttribute('width')) + 1]))");
    const std::string stall_case = run("return document.getElementById('stall-case').value");
    const std::string order = stall_case.substr(0, stall_case.find('|'));
    const std::string rest = stall_case.substr(stall_case.find('|') + 1);
    const std::string name =
        "gl/ring_plain_q31/order:" + order + "/taps:" + rest.substr(0, rest.find('|')) + "/m7:pretend";
    bool seen = false;
    for (const bench::Json& row : input.results.rows) {
        if (row["name"] == name) {
            seen = true;
            EXPECT_NEAR(widths["stall_fpu_latency"].get<double>() / widths["stall_load_use"].get<double>(),
                        row["stall_fpu_latency"].get<double>() / row["stall_load_use"].get<double>(), 0.05);
            EXPECT_NEAR(widths["issuing"].get<double>() / widths["stall_load_use"].get<double>(),
                        row["instructions_per_sample"].get<double>() / 2.0 / row["stall_load_use"].get<double>(), 0.05);
        }
    }
    EXPECT_TRUE(seen) << name;
    EXPECT_GT(count("#effective-panels svg.panel"), 0);
}

TEST_F(Page, InstructionsAreNeverCalledCycles) {
    bench::Results results = input.results;
    for (bench::Json& row : results.rows) {
        for (const char* field : {"model_cycles_per_sample", "model_cycles_low", "model_cycles_high",
                                  "cycles_per_sample", "stall_load_use", "stall_fpu_latency"}) {
            row.erase(field);
        }
    }
    open(to_input("counted.json", results));
    EXPECT_EQ(count("svg.panel[data-axis=instructions]"), 4);
    const std::string words =
        run("return document.querySelector('main').innerText.replace(/they are not cycles|not cycles/g, '')");
    std::string lower = words;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    EXPECT_EQ(lower.substr(0, lower.find("effective taps in fixed point")).find("cycle"), std::string::npos) << lower;
}

TEST_F(Page, FitsAPhone) {
    Json phone;
    phone["width"] = 390;
    phone["height"] = 844;
    phone["deviceScaleFactor"] = 2;
    phone["mobile"] = true;
    browser->devtools("Emulation.setDeviceMetricsOverride", phone);
    open(input);
    EXPECT_LE(run("return document.documentElement.scrollWidth").get<int>(), 390);
    EXPECT_EQ(run("return [...document.querySelectorAll('svg.panel')].every(svg => svg.getBoundingClientRect().right "
                  "<= 390)"),
              true);
    EXPECT_EQ(run("return document.getElementById('panel-controls').open"), false);
    browser->click("#panel-controls summary");
    browser->click("#panel-kernels summary");
    EXPECT_LE(run("return document.documentElement.scrollWidth").get<int>(), 390);
}

TEST_F(Page, DarkByTheSystemAndByTheButton) {
    const auto scheme = [](const char* value) {
        Json feature;
        feature["name"] = "prefers-color-scheme";
        feature["value"] = value;
        Json media;
        media["features"] = Json::array({feature});
        browser->devtools("Emulation.setEmulatedMedia", media);
    };
    const auto paper = [] { return run("return getComputedStyle(document.body).backgroundColor"); };
    scheme("light");
    open(input, nullptr, "#find=ring_plain_q31");
    EXPECT_EQ(paper(), "rgb(255, 255, 255)");
    scheme("dark");
    EXPECT_EQ(paper(), "rgb(20, 22, 26)");
    browser->click("#theme");
    EXPECT_EQ(paper(), "rgb(255, 255, 255)");
    browser->click("#theme");
    scheme("light");
    EXPECT_EQ(paper(), "rgb(20, 22, 26)");
    EXPECT_NE(run("return location.hash").get<std::string>().find("theme=dark"), std::string::npos);
}

TEST_F(Page, AWholeBenchFitsInThreeMegabytes) {
    const auto whole = to_input("whole.json", test::pretend_results(37'140, 3));
    EXPECT_LT(make_page(whole, nullptr).size(), 3'000'000U);
    open(whole);
    EXPECT_EQ(count("svg.panel[data-axis=taps]"), 4);
    print_times("37 140 rows");
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const char* required = std::getenv("GLSUM_REQUIRE_BROWSER");
    if (!Browser::installed() && (required == nullptr || std::string(required) != "1")) {
        std::puts("skipped: no chromium and chromedriver here (Debian packages chromium, chromium-driver)");
        return 77;
    }
    return RUN_ALL_TESTS();
}
