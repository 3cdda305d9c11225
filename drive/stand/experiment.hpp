// An experiment on the stand: what is commanded, when it is read, and what the log says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drive/stand/motion.hpp"
#include "drive/stand/stand.hpp"

namespace stand {

/// What is commanded over `until_s`.
struct Experiment {
    std::string name = "pulse";  ///< `step`, `pulse`, `staircase`, `ramp`, `chirp`, `prbs`, `release`
    double duty = 0.27;          ///< of step and pulse; the highest of the others
    double low_duty = 0.0;       ///< the lowest of staircase, ramp, chirp and prbs
    double off_s = 2.6;          ///< when the pulse ends
    double until_s = 5.0;
    int stairs = 4;         ///< equal ones up, and down again
    double from_hz = 0.05;  ///< chirp: swept to `to_hz`, each octave in the same time
    double to_hz = 2.0;
    double bit_s = 0.25;     ///< prbs: from a shift register of 10 bits, which the seed fills
    double angle_rad = 0.7;  ///< release: where the bar is held at first
};

/// \throws glsum::Failure (bad input): no such name, no time, duties outside 0 to 1, more than 10^6 samples.
void check(const Experiment& experiment, double interval_s);

/// A log as the acquisition writes it, and what it could not see.
struct Record {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> duty;
    std::vector<double> angle_rad;  ///< as read
    Motion truth;                   ///< at the same stamps
};

/// The board reads the encoder and sets the duty at each stamp, so the duty is held from stamp to stamp. Stamps are
/// uniform around the even ones, the first at 0. The same seed gives the same record.
[[nodiscard]] Record run(const Stand& stand, const Experiment& experiment, std::uint64_t seed, double charge = 0.0);

/// Series 1 to `count` of the same experiment, one after the other on one battery, as in the paper's Fig. 3: they
/// differ by stamps and noise, by what the battery has lost, and by up to 10 ms in the start-up of the motor. In the
/// last one the second motor blows from 1.5 to 2.1 s, with three tenths of the duty's square.
[[nodiscard]] std::vector<Record> run_series(const Stand& stand, const Experiment& experiment, std::uint64_t seed,
                                             int count = 4);

/// Columns time_s, duty and angle_rad, in shortest numbers that read back exactly; with `truth` also the angle, speed
/// and rotor that nobody measured. The first lines, comments, say what was run.
[[nodiscard]] std::string to_csv(const Record& record, bool truth);

/// For people: how many samples, how high the bar came, how often it hit a stop.
[[nodiscard]] std::string to_text(const Record& record);

}  // namespace stand
