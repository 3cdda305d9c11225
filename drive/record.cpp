#include "drive/record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"
#include "drive/closed_loop.hpp"
#include "drive/over_log.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

}  // namespace

Record to_record(const Log& log, const std::optional<Model>& controller) {
    Record record;
    record.name = log.name;
    record.output = log.output;
    if (record.output.size() < 8) {
        refuse(
            fmt::format("{}: expected at least 8 samples to identify from, found {}", log.name, record.output.size()));
    }
    record.time_s = from_start(log).time_s;
    record.controller = controller;
    if (controller) {
        record.reference = log.reference.empty() ? recover_reference(*controller, record.time_s, log.input, log.output)
                                                 : log.reference;
    }
    record.changes = changes_of(record.time_s, controller ? record.reference : log.input);
    if (record.changes.empty()) {
        refuse(fmt::format("{}: the {} is 0 throughout: nothing can be identified from it", log.name,
                           controller ? "reference" : "input"));
    }
    if (std::all_of(record.output.begin(), record.output.end(), [&](double y) { return y == record.output.front(); })) {
        refuse(fmt::format("{}: the output is {} throughout: nothing can be identified from it", log.name,
                           record.output.front()));
    }
    return record;
}

std::vector<double> respond_to(const Model& model, const Record& record, double offset) {
    std::vector<double> output =
        record.controller ? run_loop(model, *record.controller, record.time_s, record.reference, offset).output
                          : respond(model, record.changes, record.time_s);
    for (double& value : output) {
        value += offset;
    }
    return output;
}

}  // namespace drive
