#include "bench/gate/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/files.hpp"
#include "base/glob.hpp"
#include "bench/gate/row_table.hpp"
#include "bench/gate/rules.hpp"

namespace bench::gate {
namespace {

// Of the machine and the moment, not of what is compared.
constexpr std::string_view left_out_of_context[] = {"host_name",   "executable",          "num_cpus",
                                                    "mhz_per_cpu", "cpu_scaling_enabled", "caches",
                                                    "load_avg",    "elf_sha256",          "m4_elf_sha256"};

std::string today() {
    const std::time_t time = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&time));
    return text;
}

Json small_row(const Json& row) {
    const auto name = row["name"].get<std::string>();
    Json small{{"name", name}};
    if (kind_of(name) == Kind::host) {
        // What tells repetitions and their times, in the order of a row.
        const auto is_kept = [](const std::string& key) {
            return key == "run_type" || key == "time_unit" ||
                   std::ranges::any_of(std::array{Counter::repetition_index, Counter::iterations, Counter::real_time,
                                                  Counter::cpu_time},
                                       [&](Counter counter) { return key == name_of(counter); });
        };
        for (const auto& [key, value] : row.items()) {
            if (is_kept(key)) {
                small[key] = value;
            }
        }
        return small;
    }
    for (const auto& [key, value] : row.items()) {
        if (is_counter(key, value)) {
            small[key] = value;
        }
    }
    return small;
}

}  // namespace

Results make_baseline(const Results& current, const std::vector<std::string>& rows, const Json& previous,
                      const std::string& reason, const std::string& changed) {
    Results baseline;
    const RowTable table(current);
    std::vector<std::string> names;
    std::size_t wrong = 0;
    for (const std::string& name : table.names()) {
        if (base::matches_any(rows, name)) {
            names.push_back(name);
            wrong += table.find(name)->wrong() ? 1 : 0;
        }
    }
    if (names.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("no row matches {}: a baseline must hold some", fmt::join(rows, ", ")));
    }
    if (wrong > 0) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{} of {} rows are wrong: such a run is no baseline", wrong, names.size()));
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
        for (const Json* row : table.find(name)->repetitions) {
            baseline.rows.push_back(small_row(*row));
        }
    }
    for (const auto& [key, value] : current.context.items()) {
        if (std::find(std::begin(left_out_of_context), std::end(left_out_of_context), key) ==
            std::end(left_out_of_context)) {
            baseline.context[key] = value;
        }
    }
    baseline.context["baseline_rows"] = rows;
    baseline.context["history"] = previous.value("history", Json::array());
    baseline.context["history"].push_back({{"date", today()},
                                           {"commit", current.context.value("commit", "unknown")},
                                           {"reason", reason},
                                           {"changed", changed}});
    return baseline;
}

std::string summary_of_changes(const Verdict& verdict) {
    std::string text;
    const auto say = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    for (const Difference& difference : verdict.differences) {
        say(fmt::format("{} {} -> {}", difference.field, difference.baseline, difference.current));
    }
    if (verdict.status == glsum::Exit::not_comparable) {
        return text + "; values not compared";
    }
    for (const Layer layer : layers) {
        const LayerCount& count = verdict.count(layer);
        if (count.failed + count.warned > 0) {
            say(fmt::format("{} {}: {}", count.failed + count.warned, layer == Layer::rows ? "lost" : "worse",
                            name_of(layer)));
        }
        if (count.better > 0) {
            say(fmt::format("{} better: {}", count.better, name_of(layer)));
        }
    }
    const auto added = std::count_if(verdict.findings.begin(), verdict.findings.end(), [](const Finding& finding) {
        return finding.layer == Layer::rows && finding.level == Level::note;
    });
    if (added > 0) {
        say(fmt::format("{} new", added));
    }
    return text.empty() ? "nothing" : text;
}

void write_baseline(const std::filesystem::path& path, const Results& baseline) {
    std::string text = "{\n\"context\": " + baseline.context.dump(2) + ",\n\"benchmarks\": [\n";
    for (std::size_t i = 0; i < baseline.rows.size(); ++i) {
        text += baseline.rows[i].dump() + (i + 1 < baseline.rows.size() ? ",\n" : "\n");
    }
    base::write_file(path, text + "]\n}\n");
}

}  // namespace bench::gate
