#include "drive/response.hpp"

namespace drive {

std::vector<Change> changes_of(std::span<const double> times_s, std::span<const double> values) {
    std::vector<Change> changes;
    double before = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] != before) {
            changes.push_back({times_s[i], values[i] - before});
            before = values[i];
        }
    }
    return changes;
}

StepResponse::StepResponse(const Model& model)
    : inverse_(
          1,
          [model](std::complex<double> s, std::span<std::complex<double>> values) {
              values[0] = evaluate_without_delay(model, s) / s;
          },
          swings_of(model.denominator)),
      delay_s_(model.delay_s) {}

std::vector<double> respond(StepResponse& step, std::span<const Change> changes, std::span<const double> times_s) {
    std::vector<double> output(times_s.size(), 0.0);
    for (const Change& change : changes) {
        for (std::size_t i = 0; i < times_s.size(); ++i) {
            output[i] += change.size * step(times_s[i] - change.time_s);
        }
    }
    return output;
}

std::vector<double> respond(const Model& model, std::span<const Change> changes, std::span<const double> times_s) {
    StepResponse step(model);
    return respond(step, changes, times_s);
}

}  // namespace drive
