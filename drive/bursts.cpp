#include "drive/bursts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace drive {
namespace {

// A straight line reaches over so many bursts on both sides: long enough to even out how they were packed, short enough
// to follow a clock that drifts.
constexpr std::size_t neighbours = 8;

// A longer interval, in usual ones, is a gap, as `order_stamps` has it.
constexpr double gap = 1.75;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The stamp of the burst `at` on a line of stamps against samples through the bursts from `from` to before `to`.
double on_line(std::span<const Burst> bursts, std::size_t at, std::size_t from, std::size_t to) {
    double samples = 0.0;
    double time_s = 0.0;
    const auto count = static_cast<double>(to - from);
    const auto sample = [&](std::size_t i) {
        return static_cast<double>(bursts[i].first) - static_cast<double>(bursts[at].first);
    };
    const auto later_s = [&](std::size_t i) { return bursts[i].time_s - bursts[at].time_s; };
    for (std::size_t i = from; i < to; ++i) {
        samples += sample(i) / count;
        time_s += later_s(i) / count;
    }
    double squares = 0.0;
    double products = 0.0;
    for (std::size_t i = from; i < to; ++i) {
        squares += (sample(i) - samples) * (sample(i) - samples);
        products += (sample(i) - samples) * (later_s(i) - time_s);
    }
    return bursts[at].time_s + time_s - (squares > 0.0 ? products / squares : 0.0) * samples;
}

// Where each burst begins, evened out between gaps; as stamped where that would move one by more than an interval.
std::vector<double> beginnings(std::span<const Burst> bursts, double usual_s) {
    std::vector<double> stamped;
    for (const Burst& burst : bursts) {
        stamped.push_back(burst.time_s);
    }
    std::vector<double> evened = stamped;
    for (std::size_t from = 0; from < bursts.size();) {
        std::size_t to = from + 1;
        while (to < bursts.size() && stamped[to] - stamped[to - 1] <= gap * usual_s) {
            ++to;
        }
        for (std::size_t i = from; i < to; ++i) {
            evened[i] =
                on_line(bursts, i, std::max(from, i - std::min(i, neighbours)), std::min(to, i + neighbours + 1));
            if (!(std::fabs(evened[i] - stamped[i]) <= usual_s)) {
                return stamped;
            }
        }
        from = to;
    }
    const bool rises = std::adjacent_find(evened.begin(), evened.end(), std::greater_equal<>()) == evened.end();
    return rises ? evened : stamped;
}

}  // namespace

std::vector<Burst> bursts_of(std::span<const double> time_s) {
    std::vector<Burst> bursts;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        if (bursts.empty() || time_s[i] != bursts.back().time_s) {
            bursts.push_back({i, 0, time_s[i]});
        }
        ++bursts.back().size;
    }
    return bursts;
}

std::vector<double> spread(std::span<const Burst> bursts) {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < bursts.size(); ++i) {
        intervals.push_back(bursts[i].time_s - bursts[i - 1].time_s);
    }
    const double usual_s = median(intervals);
    const std::vector<double> begins = beginnings(bursts, usual_s);
    std::vector<double> apart;
    for (std::size_t i = 0; i + 1 < bursts.size(); ++i) {
        if (intervals[i] <= gap * usual_s) {
            apart.push_back((begins[i + 1] - begins[i]) / static_cast<double>(bursts[i].size));
        }
    }
    const double usually_apart_s = median(apart);
    std::vector<double> time_s;
    for (std::size_t i = 0; i < bursts.size(); ++i) {
        const auto size = static_cast<double>(bursts[i].size);
        const bool is_last = i + 1 == bursts.size();
        const double to_next_s = is_last ? HUGE_VAL : (begins[i + 1] - begins[i]) / size;
        const double apart_s =
            is_last || intervals[i] > gap * usual_s ? std::min(usually_apart_s, to_next_s) : to_next_s;
        for (std::size_t k = 0; k < bursts[i].size; ++k) {
            time_s.push_back(begins[i] + static_cast<double>(k) * apart_s);
            if (time_s.size() > 1 && !(time_s.back() > time_s[time_s.size() - 2])) {
                return {};
            }
        }
    }
    return time_s;
}

}  // namespace drive
