// What files of measured cycles have in common: comment lines, a header, a row a line; commas part the cells.
#pragma once

#include <charconv>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace qemu {

struct MeasuredLimits {
    static constexpr std::size_t bytes = 64u << 20;
    static constexpr std::size_t rows = 100'000;
    static constexpr std::size_t columns = 100;
};

class MeasuredTable {
public:
    /// \param name     of the file; begins every message
    /// \param columns  that must be there; others may
    /// \throws glsum::Failure (bad input) with file and line for a column that is missing or there twice, a ragged row,
    ///         too many rows or columns, and a file without rows
    MeasuredTable(const std::string& text, std::string name, const std::vector<std::string>& columns);

    /// Whether a file's first line that is no comment names a column: by it kinds of files are told apart.
    [[nodiscard]] static bool has_header_with(const std::string& text, const std::string& column);

    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] bool has(const std::string& column) const { return columns_.contains(column); }
    /// Of the file, from 1.
    [[nodiscard]] unsigned line(std::size_t row) const { return rows_[row].line; }
    /// "file:line: column", with which a message about a cell begins.
    [[nodiscard]] std::string place(std::size_t row, const std::string& column) const;

    [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const {
        return rows_[row].cells[columns_.at(column)];
    }
    /// \throws glsum::Failure (bad input) for another word than these
    [[nodiscard]] const std::string& one_of(std::size_t row, const std::string& column,
                                            const std::vector<std::string>& words) const;
    /// \throws glsum::Failure (bad input) for what is no number of this type, or out of range
    template <class Number>
    [[nodiscard]] Number number(std::size_t row, const std::string& column, double lowest, double highest) const {
        const std::string& cell = text(row, column);
        Number number{};
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
        if (error != std::errc{} || end != cell.data() + cell.size() || !(static_cast<double>(number) >= lowest) ||
            !(static_cast<double>(number) <= highest)) {
            refuse_number(row, column, lowest, highest);
        }
        return number;
    }

private:
    struct Row {
        unsigned line;
        std::vector<std::string> cells;
    };
    void read_header(const std::vector<std::string>& cells, const std::vector<std::string>& expected,
                     const std::string& place, const std::string& text);
    [[noreturn]] void refuse_number(std::size_t row, const std::string& column, double lowest, double highest) const;

    std::string name_;
    std::map<std::string, std::size_t> columns_;
    std::vector<Row> rows_;
};

}  // namespace qemu
