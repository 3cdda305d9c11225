// What the firmware answers to a plan, line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "qemu/emulate/firmware.hpp"

namespace qemu {

/// Checks that the answer is complete and in order. Lines that do not begin with `row` or `end` are the emulator's own
/// words, told when it fails.
class Answers {
public:
    explicit Answers(std::size_t rows) : rows_(rows) {}

    /// `row <n> <status> <hash>`: of a replay. Empty for a line that is no row.
    /// \throws glsum::Failure (check failed) for a row out of turn or damaged.
    std::optional<ReplayedRow> take_replayed(const std::string& line);

    /// `row <n> <status> <hash> <stack bytes> <state bytes> <coefficient bytes>`: of a measurement, the counts still
    /// zero. Likewise.
    std::optional<MeasuredRow> take_measured(const std::string& line);

    /// \throws glsum::Failure (check failed) unless all rows and the end were taken.
    void check_complete() const;

private:
    std::size_t rows_;
    std::size_t taken_ = 0;
    bool ended_ = false;
    template <class Row, class Read>
    std::optional<Row> take(const std::string& line, Read read);
};

}  // namespace qemu
