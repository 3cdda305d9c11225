#include "bench/sweep.hpp"

#include <fmt/format.h>

namespace bench {

std::string row_name(const std::string& kernel, double order, const Length& length, const std::string& aspect) {
    return fmt::format("gl/{}/order:{}/taps:{}/{}", kernel, order, length.text(), aspect);
}

}  // namespace bench
