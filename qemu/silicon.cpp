#include "qemu/silicon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "qemu/elf.hpp"
#include "qemu/failure.hpp"
#include "qemu/scratch.hpp"
#include "qemu/timed_program.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr unsigned calls_of_a_row = 12;  // as targets/firmware/silicon.cpp makes them
constexpr std::uint32_t most_taps = 128;

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) {
        const auto first = cell.find_first_not_of(" \t\r");
        const auto last = cell.find_last_not_of(" \t\r");
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    if (line.ends_with(',')) {
        cells.emplace_back();
    }
    return cells;
}

template <class Number>
Number to_number(const std::string& cell, const std::string& place, const char* column, double lowest, double highest) {
    Number number{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc{} || end != cell.data() + cell.size() || !(static_cast<double>(number) >= lowest) ||
        !(static_cast<double>(number) <= highest)) {
        throw Failure(Exit::bad_input, fmt::format("{}: {}: expected a number from {} to {}, found \"{}\"", place,
                                                   column, lowest, highest, cell));
    }
    return number;
}

std::string one_of(const std::string& cell, const std::string& place, const char* column,
                   const std::vector<std::string>& words) {
    if (std::find(words.begin(), words.end(), cell) == words.end()) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: {}: expected {}, found \"{}\"", place, column, fmt::join(words, ", "), cell));
    }
    return cell;
}

}  // namespace

std::vector<MeasuredCycles> read_measured_cycles(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) {
        throw Failure(Exit::bad_input, fmt::format("{}: cannot read", file.string()));
    }
    std::map<std::string, std::size_t> columns;
    std::size_t width = 0;
    std::vector<MeasuredCycles> rows;
    unsigned number = 0;
    for (std::string text; std::getline(in, text);) {
        ++number;
        if (text.find_first_not_of(" \t\r") == std::string::npos || text.starts_with('#')) {
            continue;
        }
        const std::string place = fmt::format("{}:{}", file.string(), number);
        const std::vector<std::string> cells = split(text);
        if (columns.empty()) {
            for (std::size_t i = 0; i < cells.size(); ++i) {
                columns[cells[i]] = i;
            }
            width = cells.size();
            for (const char* column : {"kernel", "code", "data", "maintenance", "taps", "cycles"}) {
                if (!columns.contains(column)) {
                    throw Failure(Exit::bad_input,
                                  fmt::format("{}: expected the column {}, found \"{}\"", place, column, text));
                }
            }
            continue;
        }
        if (cells.size() != width) {
            throw Failure(Exit::bad_input,
                          fmt::format("{}: expected {} cells, found {}", place, width, cells.size()));
        }
        const auto cell = [&](const char* column) { return cells[columns.at(column)]; };
        rows.push_back({cell("kernel"), one_of(cell("code"), place, "code", {"flash_cached", "flash", "itcm"}),
                        one_of(cell("data"), place, "data", {"dtcm", "axi"}),
                        one_of(cell("maintenance"), place, "maintenance", {"0", "1"}) == "1",
                        to_number<std::uint32_t>(cell("taps"), place, "taps", 1, 1e6),
                        to_number<double>(cell("cycles"), place, "cycles", 1, 1e12), number});
    }
    if (rows.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected rows of measured cycles, found none", file.string()));
    }
    return rows;
}

std::vector<PredictedCycles> predict(const SiliconProgram& program, const std::filesystem::path& file,
                                     const std::vector<MeasuredCycles>& rows, const std::string& core,
                                     const std::vector<std::string>& without) {
    const Elf elf(program.elf);
    // Each placement is a core of its own; each kernel and length is run once.
    std::vector<std::pair<std::string, std::string>> placements;
    std::vector<std::pair<std::string, std::uint32_t>> plan;
    std::set<std::uint32_t> entries;
    const auto index_in = [](auto& list, const auto& value) {
        const auto found = std::find(list.begin(), list.end(), value);
        if (found == list.end()) {
            list.push_back(value);
            return list.size() - 1;
        }
        return static_cast<std::size_t>(found - list.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> of_row;  // placement, plan
    for (const MeasuredCycles& row : rows) {
        const auto entry = elf.symbol("glsum_silicon_" + row.kernel);
        if (!entry) {
            throw Failure(Exit::bad_input, fmt::format("{}:{}: no probe for the kernel {}", file.string(), row.line,
                                                       row.kernel));
        }
        if (row.taps > most_taps) {
            throw Failure(Exit::bad_input, fmt::format("{}:{}: taps: the probes take 1 to {}, found {}", file.string(),
                                                       row.line, most_taps, row.taps));
        }
        entries.insert(*entry);
        of_row.emplace_back(index_in(placements, std::pair(row.code, row.data)),
                            index_in(plan, std::pair(row.kernel, row.taps)));
    }
    timing::TimingRequest request;
    request.cores_folder = program.cores_folder.string();
    request.without = without;
    for (const auto& [code, data] : placements) {
        request.cores.push_back({core, code == "itcm" ? "itcm" : "flash", data, code != "flash"});
    }
    const std::vector<timing::CoreFile> cores = timing::cores_of(request);

    const Scratch scratch;
    {
        std::ofstream out(scratch.file("plan"));
        for (std::size_t i = 0; i < plan.size(); ++i) {
            out << (i > 0 ? "\n" : "") << plan[i].first << ' ' << plan[i].second;
        }
    }
    const timing::TimingLog log = time_program(program.emulator, program.plugin, program.elf,
                                               {scratch.file("plan").string()}, {entries.begin(), entries.end()},
                                               request, {});
    // The last call of each row of the plan.
    std::vector<const timing::TimedCall*> settled;
    std::uint64_t calls = 0;
    for (const timing::TimedRun& run : log.runs) {
        calls += run.calls;
        while (settled.size() < plan.size() && calls >= (settled.size() + 1) * calls_of_a_row) {
            settled.push_back(&run.call);
        }
    }
    if (settled.size() != plan.size() || calls != plan.size() * calls_of_a_row) {
        throw Failure(Exit::check_failed, fmt::format("{}: {} calls were seen, {} expected", program.elf.string(), calls,
                                                      plan.size() * calls_of_a_row));
    }
    std::vector<PredictedCycles> predictions;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto [placement, planned] = of_row[i];
        const auto& half_cycles = settled[planned]->cores[placement].half_cycles;
        const timing::Figures& figures = cores[placement].sets[0].figures;
        const auto more = static_cast<double>(figures.measurement_counter_reads +
                                              (rows[i].maintenance ? figures.measurement_maintenance : 0));
        const auto cycles = [&](std::int64_t half) { return static_cast<double>(half) / 2.0 + more; };
        predictions.push_back({cycles(half_cycles[0]), cycles(*std::min_element(half_cycles.begin(), half_cycles.end())),
                               cycles(*std::max_element(half_cycles.begin(), half_cycles.end()))});
    }
    return predictions;
}

Line fit_line(const std::vector<double>& taps, const std::vector<double>& cycles) {
    const auto n = static_cast<double>(taps.size());
    double sx = 0;
    double sy = 0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        sx += taps[i] / n;
        sy += cycles[i] / n;
    }
    double sxx = 0;
    double sxy = 0;
    for (std::size_t i = 0; i < taps.size(); ++i) {
        sxx += (taps[i] - sx) * (taps[i] - sx);
        sxy += (taps[i] - sx) * (cycles[i] - sy);
    }
    const double slope = sxx > 0 ? sxy / sxx : 0;
    return {slope, sy - slope * sx};
}

}  // namespace qemu
