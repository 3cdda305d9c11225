#include "cli/band.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/failure.hpp"
#include "cli/name_value.hpp"

namespace cli {

glsum::design::Band to_band(const char* option, const std::string& text, double step_s) {
    const auto refuse = [&](const std::string& what) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: expected {}", option, what));
    };
    const auto dots = text.find("..");
    const auto low = dots == std::string::npos ? std::nullopt : to_number<double>(text.substr(0, dots));
    const auto high = dots == std::string::npos ? std::nullopt : to_number<double>(text.substr(dots + 2));
    if (!low || !high || !(*low > 0.0) || !(*high >= *low) || !std::isfinite(*high)) {
        refuse(fmt::format("two rising frequencies in Hz, as in 0.05..80, found {}", text));
    }
    if (*high * step_s > 0.5) {
        refuse(fmt::format("at most half the sampling rate, {:g} Hz, found {:g}", 0.5 / step_s, *high));
    }
    if (!(*low * step_s * most_samples >= 1.0)) {
        refuse(fmt::format("a period of at most {:g} samples, found {:g} Hz, {:g} samples", most_samples, *low,
                           1.0 / (*low * step_s)));
    }
    return {*low, *high};
}

}  // namespace cli
