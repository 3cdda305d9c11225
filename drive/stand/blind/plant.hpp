// A linear plant of whole or fractional orders with effects about it: the second source of blind cases, beside the
// stand.
//
//   sum_i a_i D^alpha_i y = gain w(t - delay) - forces
//
// It is stepped on a grid ten times finer than the samples, by Grünwald and Letnikov's weights with the next term of
// their error taken away, (1 - z)^alpha (1 + alpha/2 (1 - z)): of second order in the step. The input enters as its
// mean over the step around each node; forces that depend on the motion are extrapolated from the nodes before, and
// friction is Dahl's, which bends a little before it slips. None of this is code or a formula of the diagnosis.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "drive/stand/stand.hpp"

namespace stand::blind {

struct PlantTerm {
    double coefficient;
    double order;
};

struct Plant {
    double gain = 1.0;
    std::vector<PlantTerm> terms;  ///< orders fall; the last is of order 0
    double delay_s = 0.0;
    double full_input = 1.0;   ///< the input that is thought of as full: fixes the scales below
    double full_output = 1.0;  ///< the output that it holds
};

/// What is in no list of effects; 0: absent. Inputs, outputs and forces in the plant's units.
struct Unlisted {
    double cogging_force = 0.0;  ///< a force that goes round with the output
    double cogging_per_unit = 0.0;
    double hum_force = 0.0;  ///< a force that swings whatever the input does
    double hum_hz = 0.0;
    double near_gain = 0.0;        ///< share by which the input works better near output 0
    double stiffening = 0.0;       ///< force times y^3
    double delay_at_rest_s = 0.0;  ///< more delay at small inputs, falling to none at the full one
    double hysteresis = 0.0;       ///< play of the input
    double damping_growth = 0.0;   ///< per s, of the force times y'
    double input_step = 0.0;       ///< the input is rounded to multiples
    double falling_gain = 0.0;     ///< share by which a falling input works less
    double slip_per_unit = 0.0;    ///< the reading loses a share of the way where the plant is driven hard
};

/// What the plant is given, at rising stamps, and held.
struct Held {
    std::vector<double> time_s;
    std::vector<double> input;
};

/// The reading at `at_s` before offset, noise and encoder, from rest. Of `effects` everything that the diagnosis' table
/// knows between the command and the sensor's lag is taken, not what a stand is made of; `sensor_tau_s` included.
/// \param step_s  of the grid \throws glsum::Failure (check failed) where it does not stay finite.
[[nodiscard]] std::vector<double> respond(const Plant& plant, const Stand& effects, const Unlisted& unlisted,
                                          const Held& held, std::span<const double> at_s, double step_s);

/// The plant's static output for a held input, without effects.
[[nodiscard]] double static_output(const Plant& plant, double input);

/// A stand without any effect.
[[nodiscard]] Stand no_effects();

}  // namespace stand::blind
