#include "gap/drive/base/idle.hpp"

#include <algorithm>
#include <cmath>

namespace gap {
namespace {

void count_from(std::vector<Record>& records, double level) {
    for (Record& record : records) {
        for (double& u : record.input) {
            u -= level;
        }
    }
}

// Off: readings rest at 0 as long as the record's first level is held.
bool begins_off(const Record& record, double idle, double near, double largest_output) {
    constexpr double at_rest = 0.02;
    std::size_t held = 0;
    while (held < record.size() && std::fabs(record.input[held] - idle) <= near) {
        if (std::fabs(record.output[held]) > at_rest * largest_output) {
            return false;
        }
        ++held;
    }
    return held > 0;
}

}  // namespace

double idle_input_of(const std::vector<Record>& train, const std::vector<Record>& validate) {
    double low = train.front().input.front();
    double high = low;
    double largest_output = 0.0;
    for (const auto* records : {&train, &validate}) {
        for (const Record& record : *records) {
            const auto [least, most] = std::minmax_element(record.input.begin(), record.input.end());
            low = std::min(low, *least);
            high = std::max(high, *most);
            for (const double z : record.output) {
                largest_output = std::max(largest_output, std::fabs(z));
            }
        }
    }
    const double idle = low > 0.0 ? low : high < 0.0 ? high : 0.0;
    const double most = std::max(std::fabs(low), std::fabs(high));
    constexpr double least_share = 0.05;
    constexpr double near_share = 0.02;
    const double near = near_share * (high - low);
    const bool off = std::all_of(train.begin(), train.end(),
                                 [&](const Record& record) { return begins_off(record, idle, near, largest_output); });
    return std::fabs(idle) > least_share * most && high > low && off ? idle : 0.0;
}

Question counted_from_idle(Question question) {
    question.idle_input = idle_input_of(question.train, question.validate);
    count_from(question.train, question.idle_input);
    count_from(question.validate, question.idle_input);
    return question;
}

std::vector<Record> as_logged(std::vector<Record> records, double idle_input) {
    count_from(records, -idle_input);
    return records;
}

}  // namespace gap
