// How a kernel with the history `nested` is best laid out: which near taps and which blocks for so many coefficients.
#pragma once

#include <cstddef>
#include <vector>

#include "glsum/design/modes.hpp"

namespace glsum::design {

/// The first K weights are exact; behind them every block has the mean of its own, and what it does not reach has 0.
struct BlockDesign {
    std::size_t near_taps;  ///< K
    Blocks blocks;
    double error;  ///< the exact sum_{j=K..N} |a_j - weight|: of the output, for |x| <= 1, before h^-v
};

/// sum_{j=K..N} |weights[j] - weight|. \param weights  to index N, and as far as the blocks reach if that is more
[[nodiscard]] double error_of(const std::vector<double>& weights, std::size_t near_taps, const Blocks& blocks,
                              std::size_t horizon);

/// Of the designs of L = K + M coefficients the one of the least error, and of several that with the fewest blocks. For
/// each number B of blocks a level, 1 to 16 and then each an eighth larger, there is one: with the fewest blocks that
/// reach the horizon. B = 1 may also end before it; without blocks there is the window. The same arguments give the
/// same design. \pre taps >= 1
[[nodiscard]] BlockDesign design_blocks(const Tail& tail, std::size_t taps);

}  // namespace glsum::design
