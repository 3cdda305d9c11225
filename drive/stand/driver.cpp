#include "drive/stand/driver.hpp"

#include <algorithm>
#include <cmath>

namespace stand {
namespace {

// Constant levels: what the driver wants to put out.
std::vector<Command> targets_of(const Stand& stand, std::span<const Command> commands) {
    std::vector<Command> targets{{0.0, 0.0}};
    const auto put = [&](double time_s, double level) {
        if (targets.back().time_s == time_s) {
            targets.back().duty = level;
        } else if (targets.back().duty != level) {
            targets.push_back({time_s, level});
        }
    };
    const double delay_s = stand.delay_s + stand.extra_delay_s;
    double turns_from_s = unlimited;  // when the motor that is being started begins to turn; unlimited: it is off
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const double from_s = commands[i].time_s + delay_s;
        const double to_s = i + 1 < commands.size() ? commands[i + 1].time_s + delay_s : unlimited;
        const double duty = commands[i].duty;
        if (duty <= 0.0 || duty < stand.threshold) {
            turns_from_s = unlimited;
            put(from_s, 0.0);
            continue;
        }
        if (turns_from_s == unlimited) {
            turns_from_s = from_s + stand.start_up_s;
        }
        if (turns_from_s < to_s) {
            put(std::max(from_s, turns_from_s), std::min(std::max(duty - stand.dead_zone, 0.0), stand.input_limit));
        }
    }
    return targets;
}

}  // namespace

std::vector<Piece> drive_motor(const Stand& stand, std::span<const Command> commands) {
    const std::vector<Command> targets = targets_of(stand, commands);
    std::vector<Piece> pieces;
    double level = 0.0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double from_s = targets[i].time_s;
        const double target = targets[i].duty;
        if (stand.rate_per_s == unlimited) {
            pieces.push_back({from_s, target, 0.0});
            continue;
        }
        const double to_s = i + 1 < targets.size() ? targets[i + 1].time_s : unlimited;
        const double ramp_s = std::fabs(target - level) / stand.rate_per_s;
        if (ramp_s > 0.0) {
            const double slope = std::copysign(stand.rate_per_s, target - level);
            pieces.push_back({from_s, level, slope});
            if (from_s + ramp_s >= to_s) {
                level += slope * (to_s - from_s);
                continue;
            }
        }
        pieces.push_back({from_s + ramp_s, target, 0.0});
        level = target;
    }
    return pieces;
}

}  // namespace stand
