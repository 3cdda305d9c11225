#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/gate/percent.hpp"
#include "bench/gate/trend.hpp"
#include "bench/rows/row.hpp"

namespace bench::gate {
namespace {

std::string change_of(double log_ratio) { return percent(std::expm1(log_ratio), 3); }

const char* verdict_of(const Change& change) {
    return change.better > 0 && change.worse > 0 ? "mixed"
           : change.better > 0                   ? "better"
           : change.worse > 0                    ? "worse"
                                                 : "";
}

std::string line_of(const Change& change) {
    const bool has_ratio = change.rows > change.without_ratio;
    const std::string range = has_ratio && change.highest > change.lowest
                                  ? fmt::format("  ({} to {})", change_of(change.lowest), change_of(change.highest))
                                  : "";
    std::string line = fmt::format("  {:>3}  {:<26} {:<26} {:>10} {:>11}  {:<6}{}", change.run + 1, change.kernel,
                                   change.counter, has_ratio ? change_of(change.log_ratio) : "from/to 0",
                                   fmt::format("{} of {}", change.rows, change.of), verdict_of(change), range);
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

}  // namespace

std::string to_table(const Trend& trend, std::size_t shown) {
    std::string text = fmt::format("\n  {:>3}  {:<36} {:<9} {:<10} {:>7} {:>8} {:>7} {:>7}\n", "run", "file", "commit",
                                   "date", "rows", "changed", "better", "worse");
    for (std::size_t run = 0; run < trend.runs.size(); ++run) {
        const TrendRun& one = trend.runs[run];
        text += fmt::format("  {:>3}  {:<36} {:<9} {:<10} {:>7}", run + 1, one.name, one.commit, one.date, one.rows);
        text += run == 0 ? "\n" : fmt::format(" {:>8} {:>7} {:>7}\n", one.changed, one.better, one.worse);
    }
    if (trend.changes.empty()) {
        return text + "\n  nothing changed\n";
    }
    text += fmt::format("\n  {:>3}  {:<26} {:<26} {:>10} {:>11}\n", "run", "kernel", "counter", "change", "rows");
    for (std::size_t i = 0; i < std::min(shown, trend.changes.size()); ++i) {
        text += line_of(trend.changes[i]);
    }
    if (shown < trend.changes.size()) {
        text += fmt::format("  ... and {} more; --json has them all\n", trend.changes.size() - shown);
    }
    return text +
           "\n  change: against the run before, the geometric mean of the rows that changed. Host times change where "
           "the\n"
           "  interval of their ratio to the anchor leaves 1 out.\n";
}

std::string to_json(const Trend& trend) {
    Json json;
    json["schema"] = "glsum-trend-1";
    json["runs"] = Json::array();
    for (const TrendRun& run : trend.runs) {
        json["runs"].push_back({{"name", run.name},
                                {"commit", run.commit},
                                {"date", run.date},
                                {"rows", run.rows},
                                {"changed", run.changed},
                                {"better", run.better},
                                {"worse", run.worse}});
    }
    json["changes"] = Json::array();
    for (const Change& change : trend.changes) {
        Json one{{"run", change.run + 1}, {"kernel", change.kernel}, {"counter", change.counter}, {"rows", change.rows},
                 {"of", change.of},       {"better", change.better}, {"worse", change.worse}};
        if (change.rows > change.without_ratio) {
            one["ratio"] = std::exp(change.log_ratio);
            one["ratio_lowest"] = std::exp(change.lowest);
            one["ratio_highest"] = std::exp(change.highest);
        }
        json["changes"].push_back(std::move(one));
    }
    json["series"] = Json::array();
    for (const Series& series : trend.series) {
        Json points = Json::array();
        for (std::size_t run = 0; run < series.changed.size(); ++run) {
            if (series.changed[run]) {
                points.push_back(run + 1);
            }
        }
        json["series"].push_back({{"kernel", series.kernel},
                                  {"counter", series.counter},
                                  {"ratio_to_first", series.level},
                                  {"change_points", points}});
    }
    return json.dump(1) + "\n";
}

std::optional<base::Picture> picture(const Trend& trend) {
    const std::size_t lines = std::min(std::size(base::palette), trend.series.size());
    if (lines == 0) {
        return std::nullopt;
    }
    base::Picture drawn;
    drawn.script =
        "set termoption noenhanced\nset title \"What moved furthest since the first run; points: where it changed\"\n"
        "set xlabel \"run\"\nset ylabel \"ratio to the first run\"\nset logscale y\nset grid\nset key outside right "
        "top\n";
    drawn.script += fmt::format("set xrange [0.8:{}.2]\nset xtics 1\n", trend.runs.size());
    std::string plots;
    for (std::size_t n = 0; n < lines; ++n) {
        const Series& series = trend.series[n];
        const std::string title = base::gnuplot_text(series.kernel + " " + series.counter);
        drawn.script += fmt::format("$line{} << END\n", n);
        std::string marks;
        for (std::size_t run = 0; run < series.level.size(); ++run) {
            drawn.script += fmt::format("{} {}\n", run + 1, series.level[run]);
            marks += series.changed[run] ? fmt::format("{} {}\n", run + 1, series.level[run]) : "";
        }
        drawn.script += fmt::format("END\n$marks{} << END\n{}END\n", n, marks);
        plots += fmt::format(
            "{}$line{} using 1:2 with lines lw 2 lc rgb \"{}\" title \"{}\", $marks{} using 1:2 with points pt 7 ps "
            "1.2 lc rgb \"{}\" notitle",
            n == 0 ? "plot " : ", ", n, base::palette[n], title, n, base::palette[n]);
    }
    drawn.script += plots + "\n";
    return drawn;
}

}  // namespace bench::gate
