#include "gap/drive/residuals/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "drive/real_transform.hpp"

namespace gap {
namespace {

constexpr std::size_t neighbours = 15;  // on each side
constexpr std::size_t own_lines = 2;    // a window's width on each side: no neighbours
constexpr std::size_t least_waves = 6;

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Spectrum {
    std::vector<double> squares;  // by line
    double all;                   // of them, without the mean's
    double length_s;
};

// Squared, of the values without their mean under von Hann's window. Line m is m waves in the record.
Spectrum spectrum_of(const Record& record, std::span<const double> values) {
    double mean = 0.0;
    for (const double value : values) {
        mean += value / static_cast<double>(values.size());
    }
    std::vector<double> windowed;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(values.size());
        windowed.push_back((values[i] - mean) * (0.5 - 0.5 * std::cos(turn)));
    }
    drive::RealTransform::Buffer buffer(windowed.size(), windowed);
    drive::RealTransform::of(windowed.size()).forward(buffer);
    Spectrum spectrum{{}, 0.0, record.time_s.back() - record.time_s.front() + record.usual_interval_s};
    for (const std::complex<double> one : std::as_const(buffer).spectrum()) {
        spectrum.squares.push_back(std::norm(one));
        spectrum.all += spectrum.squares.size() > 1 ? spectrum.squares.back() : 0.0;
    }
    return spectrum;
}

Wave line_of(const Spectrum& spectrum, std::size_t line) {
    std::vector<double> below;
    std::vector<double> above;
    double own = 0.0;
    const std::size_t last = std::min(line + neighbours, spectrum.squares.size() - 1);
    for (std::size_t m = line > neighbours ? line - neighbours : 1; m <= last; ++m) {
        const std::size_t away = m > line ? m - line : line - m;
        if (away <= own_lines) {
            own += spectrum.squares[m];
        } else {
            (m < line ? below : above).push_back(spectrum.squares[m]);
        }
    }
    // The louder side: what falls with the frequency is no line.
    const double usual = std::max(below.empty() ? 0.0 : median_of(below), above.empty() ? 0.0 : median_of(above));
    return {static_cast<double>(line) / spectrum.length_s, usual > 0.0 ? spectrum.squares[line] / usual : 0.0,
            spectrum.all > 0.0 ? own / spectrum.all : 0.0};
}

bool is_too_short(const Spectrum& spectrum) { return spectrum.squares.size() < least_waves + neighbours + 1; }

}  // namespace

Burst loudest_burst(const Record& record, std::span<const double> residuals, std::span<const char> counts,
                    double stretch_s, double least_square) {
    const auto samples = std::max<std::size_t>(10, static_cast<std::size_t>(stretch_s / record.usual_interval_s));
    std::vector<double> squares;
    Burst loudest;
    double most = 0.0;
    for (std::size_t from = 0; from + samples <= residuals.size(); from += samples) {
        double sum = 0.0;
        bool whole = true;
        for (std::size_t i = from; i < from + samples; ++i) {
            sum += residuals[i] * residuals[i];
            whole = whole && counts[i] != 0 && std::isfinite(residuals[i]);
        }
        if (!whole) {
            continue;
        }
        squares.push_back(std::max(least_square, sum / static_cast<double>(samples)));
        if (squares.back() > most) {
            most = squares.back();
            loudest.at_s = record.time_s[from];
        }
    }
    constexpr std::size_t fewest = 8;
    if (squares.size() >= fewest) {
        loudest.ratio = most / median_of(squares);
    }
    return loudest;
}

Wave clearest_wave(const Record& record, std::span<const double> values) {
    const Spectrum spectrum = spectrum_of(record, values);
    Wave clearest;
    if (is_too_short(spectrum)) {
        return clearest;
    }
    for (std::size_t line = least_waves; line < spectrum.squares.size(); ++line) {
        const Wave wave = line_of(spectrum, line);
        clearest = wave.over_neighbours > clearest.over_neighbours ? wave : clearest;
    }
    return clearest;
}

Wave wave_at(const Record& record, std::span<const double> values, double hz) {
    const Spectrum spectrum = spectrum_of(record, values);
    Wave clearest;
    if (is_too_short(spectrum)) {
        return clearest;
    }
    const double place = hz * spectrum.length_s;
    for (const double line : {std::floor(place), std::ceil(place)}) {
        if (line >= 1.0 && line < static_cast<double>(spectrum.squares.size())) {
            const Wave wave = line_of(spectrum, static_cast<std::size_t>(line));
            clearest = wave.over_neighbours > clearest.over_neighbours ? wave : clearest;
        }
    }
    return clearest;
}

}  // namespace gap
