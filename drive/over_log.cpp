#include "drive/over_log.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace drive {

Log from_start(Log log) {
    const double first_s = log.time_s.front();
    for (double& t : log.time_s) {
        t -= first_s;
    }
    return log;
}

Log on_steps(const Log& log, double step_s) {
    return from_start(resample(log, step_s, Hold::zero_order, End::behind).log);
}

Log at_own_stamps(Log log, const Log& simulated) {
    log.output.clear();
    for (const double stamp_s : log.time_s) {
        const double t = stamp_s - log.time_s.front();
        const auto next = std::lower_bound(simulated.time_s.begin(), simulated.time_s.end(), t);
        const auto k = static_cast<std::size_t>(std::distance(simulated.time_s.begin(), next));
        if (k == 0 || k == simulated.time_s.size()) {
            log.output.push_back(k == 0 ? simulated.output.front() : simulated.output.back());
            continue;
        }
        const double part = (t - simulated.time_s[k - 1]) / (simulated.time_s[k] - simulated.time_s[k - 1]);
        log.output.push_back(std::lerp(simulated.output[k - 1], simulated.output[k], part));
    }
    return log;
}

}  // namespace drive
