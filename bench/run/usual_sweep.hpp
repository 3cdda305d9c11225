// What a run measures unless it is told otherwise, and which of it can be measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/sweep/sweep.hpp"

namespace bench {

/// Records, orders, lengths and signals of a whole run, or of a quick one. No kernels yet.
[[nodiscard]] Sweep usual_sweep(bool quick);

/// The lengths that words write, rising, each once. \throws glsum::Failure (bad input) naming the word that writes none
[[nodiscard]] std::vector<Length> lengths_of(const std::vector<std::string>& words, std::size_t samples);

/// The kernels and peers whose names match. Times of the host that are to be judged are judged beside code that is not
/// ours: of repetitions some peers are taken in any case.
void take_kernels(Sweep& sweep, const std::vector<std::string>& globs);

/// Takes off the kernels that cannot sum the sweep's weights. \return them, by the reason
std::map<std::string, std::vector<std::string>> leave_out_unserved(Sweep& sweep);

}  // namespace bench
