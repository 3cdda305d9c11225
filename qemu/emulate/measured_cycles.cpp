#include "qemu/emulate/measured_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "base/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

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

std::vector<MeasuredCycles> parse_measured_cycles(const std::string& content, const std::string& name) {
    std::istringstream in(content);
    std::map<std::string, std::size_t> columns;
    std::size_t width = 0;
    std::vector<MeasuredCycles> rows;
    unsigned number = 0;
    for (std::string text; std::getline(in, text);) {
        ++number;
        if (text.find_first_not_of(" \t\r") == std::string::npos || text.starts_with('#')) {
            continue;
        }
        const std::string place = fmt::format("{}:{}", name, number);
        const std::vector<std::string> cells = split(text);
        if (columns.empty()) {
            width = cells.size();
            if (width > MeasuredLimits::columns) {
                throw Failure(Exit::bad_input, fmt::format("{}: expected at most {} columns, found {}", place,
                                                           MeasuredLimits::columns, width));
            }
            for (std::size_t i = 0; i < width; ++i) {
                if (!columns.emplace(cells[i], i).second) {
                    throw Failure(Exit::bad_input,
                                  fmt::format("{}: expected each column once, found \"{}\" twice", place, cells[i]));
                }
            }
            for (const char* column : {"kernel", "code", "data", "maintenance", "taps", "cycles"}) {
                if (!columns.contains(column)) {
                    throw Failure(Exit::bad_input,
                                  fmt::format("{}: expected the column {}, found \"{}\"", place, column, text));
                }
            }
            continue;
        }
        if (cells.size() != width) {
            throw Failure(Exit::bad_input, fmt::format("{}: expected {} cells, found {}", place, width, cells.size()));
        }
        if (rows.size() == MeasuredLimits::rows) {
            throw Failure(Exit::bad_input, fmt::format("{}: expected at most {} rows", place, MeasuredLimits::rows));
        }
        const auto cell = [&](const char* column) { return cells[columns.at(column)]; };
        rows.push_back({cell("kernel"), one_of(cell("code"), place, "code", {"flash_cached", "flash", "itcm"}),
                        one_of(cell("data"), place, "data", {"dtcm", "axi"}),
                        one_of(cell("maintenance"), place, "maintenance", {"0", "1"}) == "1",
                        to_number<std::uint32_t>(cell("taps"), place, "taps", 1, 1e6),
                        to_number<double>(cell("cycles"), place, "cycles", 1, 1e12), number});
        if (columns.contains("instructions")) {
            rows.back().instructions = to_number<double>(cell("instructions"), place, "instructions", 1, 1e12);
        }
    }
    if (rows.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected rows of measured cycles, found none", name));
    }
    return rows;
}

std::string to_csv(const std::vector<MeasuredCycles>& rows) {
    std::string csv = "kernel,code,data,maintenance,taps,cycles\n";
    for (const MeasuredCycles& row : rows) {
        csv += fmt::format("{},{},{},{},{},{}\n", row.kernel, row.code, row.data, row.maintenance ? 1 : 0, row.taps,
                           row.cycles);
    }
    return csv;
}

}  // namespace qemu
