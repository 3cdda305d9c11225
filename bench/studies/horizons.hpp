// What an error over a longer and longer past costs, with a window, with blocks and with modes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/studies/study.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

struct Horizons {
    std::vector<std::size_t> horizons;                     ///< samples, 100 to 10000000; rising
    std::vector<double> orders{0.2, 0.5, 0.9, 1.5, -0.5};  ///< in (-1, 2), not whole
    std::vector<qemu::Board> boards = {};  ///< whose machines' usual cores are modelled; none: multiplications alone
};

/// Rows `horizon/<kernel>/order:<v>/error:<e>/samples:<N>`, and a picture: a panel for each order and error.
[[nodiscard]] Study measure_horizons(const Horizons& wanted);

}  // namespace bench
