#include "drive/stand/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"
#include "drive/stand/chance.hpp"

namespace stand {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

enum Stream : std::uint64_t {
    stamps_stream = 1,
    noise_stream,
    jitter_stream,
    dropped_stream,
    bits_stream,
    series_stream
};

class Bits {
public:
    explicit Bits(std::uint64_t seed) : state_(static_cast<unsigned>(Chance(seed, bits_stream).word() % 1023U) + 1U) {}
    bool next() {
        const unsigned bit = ((state_ >> 9U) ^ (state_ >> 6U)) & 1U;  // x^10 + x^7 + 1: a period of 1023
        state_ = ((state_ << 1U) | bit) & 1023U;
        return bit != 0;
    }

private:
    unsigned state_;
};

std::vector<double> duties_of(const Experiment& experiment, const std::vector<double>& time_s, std::uint64_t seed) {
    const double low = experiment.low_duty;
    const double high = experiment.duty;
    const double until = experiment.until_s;
    std::vector<double> duty;
    Bits bits(seed);
    bool bit = false;
    double next_bit_s = 0.0;
    for (const double t : time_s) {
        double value = high;
        if (experiment.name == "pulse") {
            value = t < experiment.off_s - 1e-9 ? high : 0.0;
        } else if (experiment.name == "staircase") {
            const int levels = 2 * experiment.stairs;
            const int level = std::min(static_cast<int>(levels * t / until), levels - 1) + 1;
            value = low + (high - low) * std::min(level, levels - level) / experiment.stairs;
        } else if (experiment.name == "ramp") {
            const double share = 1.0 - std::fabs(2.0 * t / until - 1.0);
            value = low + (high - low) * std::max(share, 0.0);  // the last stamp may lie behind its end
        } else if (experiment.name == "chirp") {
            const double octaves = std::log(experiment.to_hz / experiment.from_hz);
            const double turns = experiment.from_hz * until / octaves * std::expm1(octaves * t / until);
            value = 0.5 * (low + high) - 0.5 * (high - low) * std::cos(2.0 * std::numbers::pi * turns);
        } else if (experiment.name == "prbs") {
            while (t >= next_bit_s - 1e-9) {
                bit = bits.next();
                next_bit_s += experiment.bit_s;
            }
            value = bit ? high : low;
        } else if (experiment.name == "release") {
            value = 0.0;
        }
        duty.push_back(value);
    }
    return duty;
}

}  // namespace

void check(const Experiment& experiment, double interval_s) {
    static const std::vector<std::string> names{"step", "pulse", "staircase", "ramp", "chirp", "prbs", "release"};
    if (std::find(names.begin(), names.end(), experiment.name) == names.end()) {
        refuse(fmt::format("expected the experiment step, pulse, staircase, ramp, chirp, prbs or release, found {}",
                           experiment.name));
    }
    if (!(experiment.until_s >= interval_s && experiment.until_s / interval_s <= 1e6)) {
        refuse(
            fmt::format("expected a record of 2 to 10^6 samples, found {} s at {} s", experiment.until_s, interval_s));
    }
    if (!(experiment.low_duty >= 0.0 && experiment.duty > experiment.low_duty && experiment.duty <= 1.0)) {
        refuse(
            fmt::format("expected duties 0 <= low < high <= 1, found {} and {}", experiment.low_duty, experiment.duty));
    }
    if (experiment.stairs < 1 || !(experiment.bit_s >= interval_s) ||
        !(experiment.from_hz > 0.0 && experiment.to_hz > experiment.from_hz && experiment.to_hz < 0.5 / interval_s)) {
        refuse(fmt::format(
            "expected at least 1 stair, bits of at least {} s and frequencies 0 < from < to < {} Hz, found "
            "{}, {} s, {} and {} Hz",
            interval_s, 0.5 / interval_s, experiment.stairs, experiment.bit_s, experiment.from_hz, experiment.to_hz));
    }
}

Record run(const Stand& stand, const Experiment& experiment, std::uint64_t seed, double charge) {
    check(stand, "stand");
    check(experiment, stand.interval_s);
    Record record;
    record.name = fmt::format("{}, seed {}", experiment.name, seed);
    Chance stamps(seed, stamps_stream);
    const auto count = static_cast<std::size_t>(std::floor(experiment.until_s / stand.interval_s + 1e-9)) + 1;
    for (std::size_t k = 0; k < count; ++k) {
        const double spread = stamps.around(stand.spread_s);
        // Microseconds, as the board's timer counts.
        record.time_s.push_back(k == 0 ? 0.0
                                       : std::round((static_cast<double>(k) * stand.interval_s + spread) * 1e6) / 1e6);
    }
    record.duty = duties_of(experiment, record.time_s, seed);

    Chance jitter(seed, jitter_stream);
    std::vector<double> taken_s;
    for (const double t : record.time_s) {
        taken_s.push_back(std::max(0.0, t + jitter.around(stand.jitter_s)));
    }
    std::vector<double> all_s = record.time_s;
    all_s.insert(all_s.end(), taken_s.begin(), taken_s.end());
    std::sort(all_s.begin(), all_s.end());
    std::vector<Command> commands;
    for (std::size_t k = 0; k < count; ++k) {
        if (commands.empty() || commands.back().duty != record.duty[k]) {
            commands.push_back({record.time_s[k], record.duty[k]});
        }
    }
    const bool released = experiment.name == "release";
    Motion motion = move(
        stand, drive_motor(stand, commands),
        {released ? experiment.angle_rad : std::clamp(0.0, stand.lower_stop_rad, stand.upper_stop_rad), charge}, all_s);
    const auto at = [&](double t) {
        return *std::lower_bound(motion.points.begin(), motion.points.end(), t,
                                 [](const Point& point, double time_s) { return point.time_s < time_s; });
    };

    Chance noise(seed, noise_stream);
    Chance dropped(seed, dropped_stream);
    for (std::size_t k = 0; k < count; ++k) {
        double z = at(taken_s[k]).reading_rad + stand.offset_rad + stand.drift_rad_per_s * taken_s[k];
        z += stand.noise_rad * noise.normal();
        z = std::clamp(z, -stand.sensor_limit_rad, stand.sensor_limit_rad);
        const double step = stand.encoder_step_rad;
        z = step > 0.0 ? step * std::round(z / step) : z;
        if (stand.missed_counts != 0.0 && taken_s[k] >= stand.missed_at_s) {
            z -= stand.missed_counts * (step > 0.0 ? step : 1.0);
        }
        const bool drops = dropped.share() < stand.dropped_rate;
        record.angle_rad.push_back(drops && k > 0 ? record.angle_rad.back() : z);
        record.truth.points.push_back(at(record.time_s[k]));
    }
    record.truth.events = std::move(motion.events);
    return record;
}

std::vector<Record> run_series(const Stand& stand, const Experiment& experiment, std::uint64_t seed, int count) {
    Chance chance(seed, series_stream);
    std::vector<Record> records;
    double charge = 0.0;
    for (int i = 1; i <= count; ++i) {
        Stand today = stand;
        if (today.start_up_s > 0.0) {
            today.start_up_s = std::max(0.0, today.start_up_s + chance.around(0.01));
        }
        if (i == count && count > 1) {
            today.disturbance_from_s = 1.5;
            today.disturbance_to_s = 2.1;
            today.disturbance_size = 0.3 * experiment.duty * experiment.duty;
        }
        records.push_back(run(today, experiment, seed * 1000 + static_cast<std::uint64_t>(i), charge));
        records.back().name = fmt::format("series {}, {}", i, records.back().name);
        charge = records.back().truth.points.back().charge;
    }
    return records;
}

std::string to_csv(const Record& record, bool truth) {
    std::string text = fmt::format("# virtual stand: {}\ntime_s,duty,angle_rad{}\n", record.name,
                                   truth ? ",true_angle_rad,true_speed_rad_per_s,rotor" : "");
    for (std::size_t k = 0; k < record.time_s.size(); ++k) {
        text += fmt::format("{},{},{}", record.time_s[k], record.duty[k], record.angle_rad[k]);
        if (truth) {
            const Point& point = record.truth.points[k];
            text += fmt::format(",{},{},{}", point.angle_rad, point.speed_rad_per_s, point.rotor);
        }
        text += '\n';
    }
    return text;
}

std::string to_text(const Record& record) {
    const auto& events = record.truth.events;
    const auto impacts =
        std::count_if(events.begin(), events.end(), [](const Event& event) { return event.kind == EventKind::impact; });
    return fmt::format("{} samples, up to {:.4f} rad, {} impacts on a stop", record.time_s.size(),
                       *std::max_element(record.angle_rad.begin(), record.angle_rad.end()), impacts);
}

}  // namespace stand
