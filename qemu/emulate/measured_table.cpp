#include "qemu/emulate/measured_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "base/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

std::vector<std::string> cells_of(const std::string& line) {
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

bool is_comment(const std::string& line) {
    return line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#');
}

}  // namespace

bool MeasuredTable::has_header_with(const std::string& text, const std::string& column) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (!is_comment(line)) {
            const std::vector<std::string> cells = cells_of(line);
            return std::find(cells.begin(), cells.end(), column) != cells.end();
        }
    }
    return false;
}

MeasuredTable::MeasuredTable(const std::string& text, std::string name, const std::vector<std::string>& columns)
    : name_(std::move(name)) {
    std::istringstream in(text);
    unsigned number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (is_comment(line)) {
            continue;
        }
        const std::string place = fmt::format("{}:{}", name_, number);
        std::vector<std::string> cells = cells_of(line);
        if (columns_.empty()) {
            read_header(cells, columns, place, line);
            continue;
        }
        if (cells.size() != columns_.size()) {
            throw Failure(Exit::bad_input,
                          fmt::format("{}: expected {} cells, found {}", place, columns_.size(), cells.size()));
        }
        if (rows_.size() == MeasuredLimits::rows) {
            throw Failure(Exit::bad_input, fmt::format("{}: expected at most {} rows", place, MeasuredLimits::rows));
        }
        rows_.push_back({number, std::move(cells)});
    }
    if (rows_.empty()) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected rows of measured cycles, found none", name_));
    }
}

void MeasuredTable::read_header(const std::vector<std::string>& cells, const std::vector<std::string>& expected,
                                const std::string& place, const std::string& text) {
    if (cells.size() > MeasuredLimits::columns) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected at most {} columns, found {}", place,
                                                   MeasuredLimits::columns, cells.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!columns_.emplace(cells[i], i).second) {
            throw Failure(Exit::bad_input,
                          fmt::format("{}: expected each column once, found \"{}\" twice", place, cells[i]));
        }
    }
    for (const std::string& column : expected) {
        if (!has(column)) {
            throw Failure(Exit::bad_input,
                          fmt::format("{}: expected the column {}, found \"{}\"", place, column, text));
        }
    }
}

std::string MeasuredTable::place(std::size_t row, const std::string& column) const {
    return fmt::format("{}:{}: {}", name_, rows_[row].line, column);
}

const std::string& MeasuredTable::one_of(std::size_t row, const std::string& column,
                                         const std::vector<std::string>& words) const {
    const std::string& cell = text(row, column);
    if (std::find(words.begin(), words.end(), cell) == words.end()) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: expected {}, found \"{}\"", place(row, column), fmt::join(words, ", "), cell));
    }
    return cell;
}

void MeasuredTable::refuse_number(std::size_t row, const std::string& column, double lowest, double highest) const {
    throw Failure(Exit::bad_input, fmt::format("{}: expected a number from {} to {}, found \"{}\"", place(row, column),
                                               lowest, highest, text(row, column)));
}

}  // namespace qemu
