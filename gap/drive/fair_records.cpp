#include "gap/drive/fair_records.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"

namespace gap {

void check_split(const std::string& asked, double split_s, const std::vector<Record>& records) {
    constexpr std::size_t least = 32;
    for (const Record& record : records) {
        const auto before = static_cast<std::size_t>(
            std::count_if(record.time_s.begin(), record.time_s.end(), [&](double t) { return t < split_s; }));
        if (before < least || record.size() - before < least) {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                fmt::format("{}: expected {} samples or more on both sides, found {} of {} before it in {}", asked,
                            least, before, record.size(), record.name));
        }
    }
}

void check_unseen(const std::vector<Record>& train, const std::vector<Record>& validate) {
    for (const Record& record : validate) {
        for (const Record& trained : train) {
            if (record.input == trained.input && record.output == trained.output) {
                throw glsum::Failure(
                    glsum::Exit::bad_input,
                    fmt::format("{}: expected a log that is not fitted, found the training log itself; "
                                "without --validate, parts of each log are kept aside",
                                record.name));
            }
        }
    }
}

}  // namespace gap
