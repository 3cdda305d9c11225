#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive/bursts.hpp"
#include "drive/log.hpp"
#include "drive/refusal.hpp"

namespace drive {
namespace {

// What is held from its stamp to the next, and what is measured at its stamp: each channel of a log beside that of
// another made from it.
struct Channels {
    struct Pair {
        const std::vector<double>* from;
        std::vector<double>* to;
    };
    std::vector<Pair> held;
    std::vector<Pair> measured;

    Channels(const Log& from, Log& to) {
        to.more_inputs.resize(from.more_inputs.size());
        add(held, from.input, to.input);
        add(held, from.reference, to.reference);
        for (std::size_t i = 0; i < from.more_inputs.size(); ++i) {
            add(held, from.more_inputs[i], to.more_inputs[i]);
        }
        add(measured, from.output, to.output);
        add(measured, from.simulated, to.simulated);
    }
    /// Appends a sample as it is.
    void append(std::size_t sample) const {
        for (const auto* pairs : {&held, &measured}) {
            for (const Pair& pair : *pairs) {
                pair.to->push_back((*pair.from)[sample]);
            }
        }
    }
    /// Makes the last sample one of `count`, of which `sample` is the last.
    void merge(std::size_t sample, std::size_t count) const {
        for (const Pair& pair : measured) {
            pair.to->back() += ((*pair.from)[sample] - pair.to->back()) / static_cast<double>(count);
        }
        for (const Pair& pair : held) {
            pair.to->back() = (*pair.from)[sample];
        }
    }
    [[nodiscard]] bool differ(std::size_t a, std::size_t b) const {
        for (const auto* pairs : {&held, &measured}) {
            for (const Pair& pair : *pairs) {
                if ((*pair.from)[a] != (*pair.from)[b]) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    static void add(std::vector<Pair>& pairs, const std::vector<double>& from, std::vector<double>& to) {
        if (!from.empty()) {
            pairs.push_back({&from, &to});
        }
    }
};

Log empty_as(const Log& log) {
    Log empty;
    empty.name = log.name;
    empty.warnings = log.warnings;
    return empty;
}

// Samples without those stamped before the latest stamp.
Log without_backward(const Log& log, StampReport& report) {
    Log rest = empty_as(log);
    const Channels channels(log, rest);
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        if (!rest.time_s.empty() && log.time_s[i] < rest.time_s.back()) {
            report.first_backward = report.backward++ == 0 ? log.line[i] : report.first_backward;
            continue;
        }
        rest.time_s.push_back(log.time_s[i]);
        rest.line.push_back(log.line[i]);
        channels.append(i);
    }
    return rest;
}

// Whether bursts are what a logger stamped as it received them: most stamps repeat, and their samples differ. Where
// they seldom do, one sample was written several times.
bool were_stamped_when_received(const std::vector<Burst>& bursts, const Channels& channels, std::size_t samples) {
    std::size_t bursts_of_several = 0;
    std::size_t that_differ = 0;
    for (const Burst& burst : bursts) {
        bool differ = false;
        for (std::size_t i = 1; i < burst.size && !differ; ++i) {
            differ = channels.differ(burst.first, burst.first + i);
        }
        bursts_of_several += burst.size > 1 ? 1 : 0;
        that_differ += differ ? 1 : 0;
    }
    return bursts.size() >= 3 && 2 * (samples - bursts.size()) >= samples && 10 * that_differ > bursts_of_several;
}

// One sample for each stamp: the mean of what was measured, the last of what is held.
Log merged(const Log& log, const std::vector<Burst>& bursts) {
    Log result = empty_as(log);
    const Channels channels(log, result);
    for (const Burst& burst : bursts) {
        result.time_s.push_back(burst.time_s);
        result.line.push_back(log.line[burst.first]);
        channels.append(burst.first);
        for (std::size_t i = 1; i < burst.size; ++i) {
            channels.merge(burst.first + i, i + 1);
        }
    }
    return result;
}

}  // namespace

std::string StampReport::text() const {
    std::string said = fmt::format("intervals {:.6g} to {:.6g} s, usually {:.6g} s", smallest_interval_s,
                                   largest_interval_s, usual_interval_s);
    if (repeated > 0) {
        said += fmt::format("; {} repeated stamps, from line {}: {}", repeated, first_repeated,
                            spread ? "stamped in bursts, as received; their samples are spread evenly to the next stamp"
                                   : "their mean output stays");
    }
    if (backward > 0) {
        said += fmt::format("; {} stamps run backward, from line {}: left out", backward, first_backward);
    }
    if (missing > 0) {
        said += fmt::format("; about {} samples missing, from line {}: the gaps are bridged", missing, first_gap);
    }
    return said;
}

StampReport order_stamps(Log& log) {
    StampReport report;
    Log ordered = without_backward(log, report);
    const std::vector<Burst> bursts = bursts_of(ordered.time_s);
    report.repeated = ordered.time_s.size() - bursts.size();
    if (report.repeated > 0) {
        const auto first =
            std::find_if(bursts.begin(), bursts.end(), [](const Burst& burst) { return burst.size > 1; });
        report.first_repeated = ordered.line[first->first + 1];
        Log none;
        std::vector<double> time_s;
        if (were_stamped_when_received(bursts, Channels(ordered, none), ordered.time_s.size())) {
            time_s = spread(bursts);
        }
        report.spread = !time_s.empty();
        if (report.spread) {
            ordered.time_s = std::move(time_s);
        } else {
            ordered = merged(ordered, bursts);
        }
    }
    if (ordered.time_s.size() < 2) {
        refuse(fmt::format("{}: expected at least 2 different stamps, found {}", log.name, ordered.time_s.size()));
    }
    if (report.backward * 10 > log.time_s.size()) {
        refuse(fmt::format("{}:{}: expected stamps that rise; {} of {} run backward", log.name, report.first_backward,
                           report.backward, log.time_s.size()));
    }
    std::vector<double> intervals(ordered.time_s.size() - 1);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        intervals[i] = ordered.time_s[i + 1] - ordered.time_s[i];
    }
    std::vector<double> sorted = intervals;
    std::sort(sorted.begin(), sorted.end());
    report.smallest_interval_s = sorted.front();
    report.largest_interval_s = sorted.back();
    report.usual_interval_s = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        if (intervals[i] > 1.75 * report.usual_interval_s) {
            report.first_gap = report.missing == 0 ? ordered.line[i + 1] : report.first_gap;
            report.missing += static_cast<std::size_t>(std::llround(intervals[i] / report.usual_interval_s)) - 1;
        }
    }
    log = std::move(ordered);
    return report;
}

Resampled resample(Log log, double step_s, Hold hold, End end) {
    Resampled result;
    result.stamps = order_stamps(log);
    const double from = log.time_s.front();
    const double span = log.time_s.back() - from;
    if (!(step_s > 0.0 && std::isfinite(step_s)) || span / step_s >= static_cast<double>(LogLimits::samples)) {
        refuse(fmt::format("{}: expected a step above 0 s that gives at most {} samples over {} s, found {}", log.name,
                           LogLimits::samples, span, step_s));
    }
    const double steps = span / step_s;
    const auto count =
        static_cast<std::size_t>(end == End::within ? std::floor(steps + 1e-9) : std::ceil(steps - 1e-9)) + 1;
    if (count < 2) {
        refuse(fmt::format("{}: expected a step of at most {} s, the length of the log, found {}", log.name, span,
                           step_s));
    }
    Log& out = result.log;
    out = empty_as(log);
    const Channels channels(log, out);
    std::size_t i = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double t = from + static_cast<double>(k) * step_s;
        // A stamp that differs from t by rounding alone counts as reached.
        while (i + 1 < log.time_s.size() && log.time_s[i + 1] <= t + 1e-9 * step_s) {
            ++i;
        }
        out.time_s.push_back(t);
        out.line.push_back(log.line[i]);
        channels.append(i);
        if (hold == Hold::linear && i + 1 < log.time_s.size()) {
            const double part = std::max(0.0, (t - log.time_s[i]) / (log.time_s[i + 1] - log.time_s[i]));
            for (const auto& [measured, resampled] : channels.measured) {
                resampled->back() += part * ((*measured)[i + 1] - (*measured)[i]);
            }
        }
    }
    return result;
}

}  // namespace drive
