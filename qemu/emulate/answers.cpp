#include "qemu/emulate/answers.hpp"

#include <fmt/format.h>

#include "base/failure.hpp"
#include "base/words.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

// Puts the next word into `value`. \return whether it is a number.
template <class Number>
bool read_number(base::Words& words, Number& value, int base = 10) {
    const auto number = words.number<Number>(base);
    value = number.value_or(0);
    return number.has_value();
}

}  // namespace

// read(words, row) -> whether what follows a good status is whole.
template <class Row, class Read>
std::optional<Row> Answers::take(const std::string& line, Read read) {
    base::Words words(line);
    const std::string_view kind = words.next();
    if (kind == "end") {
        ended_ = words.number<std::size_t>() == rows_ && taken_ == rows_ && words.done();
    }
    if (kind != "row") {
        return std::nullopt;
    }
    if (words.number<std::size_t>() != taken_ || taken_ == rows_ || ended_) {
        throw Failure(Exit::check_failed, "the firmware answered out of turn: " + line);
    }
    ++taken_;
    const auto status = words.number<unsigned>();
    Row row{};
    row.status = static_cast<glsum::Status>(status.value_or(0));
    const bool known = status && *status <= static_cast<unsigned>(glsum::Status::blocks_out_of_range);
    if (!known || (row.status == glsum::Status::ok && !read(words, row)) || !words.done()) {
        throw Failure(Exit::check_failed, "the firmware answered a damaged row: " + line);
    }
    return row;
}

std::optional<ReplayedRow> Answers::take_replayed(const std::string& line) {
    return take<ReplayedRow>(line,
                             [](base::Words& words, ReplayedRow& row) { return read_number(words, row.hash, 16); });
}

std::optional<MeasuredRow> Answers::take_measured(const std::string& line) {
    return take<MeasuredRow>(line, [](base::Words& words, MeasuredRow& row) {
        return read_number(words, row.hash, 16) && read_number(words, row.stack_bytes) &&
               read_number(words, row.state_bytes) && read_number(words, row.coefficient_bytes);
    });
}

void Answers::check_complete() const {
    if (!ended_) {
        throw Failure(Exit::check_failed,
                      fmt::format("the firmware answered {} rows of {} and stopped", taken_, rows_));
    }
}

}  // namespace qemu
