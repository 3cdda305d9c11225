// A fractional PID controller in real time: u = kp e + ki D^-lambda e + kd D^mu e, all of its orders in one kernel.
//
// In velocity form, (1 - z) u, the orders 0, -lambda and mu become 1, 1 - lambda and 1 + mu, whose weights fade and sum
// to 0, and one merged table c_j holds them:
//
//   u_k = u_(k-1) + c_0 S_k,   S_k = e_k + sum_{j>=1} (c_j/c_0) e_(k-j)         one kernel call, one product, one sum
//
// The integrator is u itself: nothing leaks, and where u meets a limit it stops, so that nothing winds up. In floating
// point u carries what its additions lost ([Dekker1971]): an error too small to move u is not forgotten.
//
// Range, error: as the kernel's; what the table leaves out is its design's.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "glsum/registry.hpp"

namespace glsum {

/// A controller as numbers, in double, computed once on the host.
struct ControllerDesign {
    double first = 1.0;                ///< c_0
    std::span<const double> ratios;    ///< c_1/c_0, c_2/c_0, ...
    std::span<const Mode> modes = {};  ///< of a kernel with modes: of what lies behind these, over c_0
    double low = -std::numeric_limits<double>::infinity();  ///< limits of u
    double high = std::numeric_limits<double>::infinity();
    /// What the kernel is prepared for.
    [[nodiscard]] Design design() const { return {0.0, ratios.size() + 1 + 2 * modes.size(), modes, ratios}; }
};

template <class K>
class Controller {
    static_assert(is_registered<K>, "no such kernel: glsum/registry.def lists those that the library has");
    static_assert(!K::FormatPart::fixed_point, "u has no scale of its own");

public:
    using Sample = typename K::Sample;
    using Coefficient = typename K::Coefficient;

    struct State {
        typename K::State sum;
        Sample first;
        Sample low;
        Sample high;
        Sample output;
        Sample lost;  // of the output, by its last addition
    };

    /// Fills the state and clears the past. \pre design.ratios is not empty. On failure the state is undefined.
    static Status prepare(State& state, const ControllerDesign& design, std::span<Coefficient> table,
                          std::span<Sample> past);
    /// u_k for the next error e_k.
    [[gnu::noinline]] static Sample step(State& state, Sample error);
};

/// The kernels that controllers are stepped with.
using ControllerKernels =
    KernelList<Sum<Ring, Oldest, F64>, Sum<Mirror, Multi, F32>, Sum<Modes, Plain, F32>, Sum<Modes, Compensated, F32>>;

}  // namespace glsum
