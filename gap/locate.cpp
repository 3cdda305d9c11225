#include "gap/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace gap {
namespace {

constexpr std::size_t most_segments = 16;
constexpr std::size_t levels = 5;

// Squares of the residuals; ones where all are zero, so that shares exist.
std::vector<std::vector<double>> squares_of(const std::vector<std::vector<double>>& residuals) {
    double sum = 0.0;
    std::vector<std::vector<double>> squares = residuals;
    for (auto& record : squares) {
        for (double& value : record) {
            value *= value;
            sum += value;
        }
    }
    if (!(sum > 0.0)) {
        for (auto& record : squares) {
            std::fill(record.begin(), record.end(), 1.0);
        }
    }
    return squares;
}

void normalise(std::vector<Share>& shares) {
    double sum = 0.0;
    for (const Share& share : shares) {
        sum += share.share;
    }
    for (Share& share : shares) {
        share.share /= sum;
    }
}

// Parts of a record between the large changes of its input; even parts where there are too many or none.
std::vector<Share> segments_of(const Record& record, const std::vector<double>& squares) {
    const auto [low, high] = std::minmax_element(record.input.begin(), record.input.end());
    const double large = 0.1 * (*high - *low);
    std::vector<std::pair<double, std::string>> starts = {{record.time_s.front(), "start"}};
    for (std::size_t i = 1; i < record.size(); ++i) {
        const double by = record.input[i] - record.input[i - 1];
        if (std::fabs(by) > large && by != 0.0) {
            starts.emplace_back(record.time_s[i],
                                fmt::format("input {:.4g} -> {:.4g}", record.input[i - 1], record.input[i]));
        }
    }
    if (starts.size() > most_segments || starts.size() < 3) {
        starts.clear();
        const double length_s = record.time_s.back() - record.time_s.front();
        for (int part = 0; part < 10; ++part) {
            starts.emplace_back(record.time_s.front() + 0.1 * part * length_s, "");
        }
    }
    std::vector<Share> shares;
    std::size_t i = 0;
    for (std::size_t s = 0; s < starts.size(); ++s) {
        const bool last = s + 1 == starts.size();
        Share share{starts[s].first, last ? record.time_s.back() : starts[s + 1].first, 0.0, starts[s].second};
        for (; i < record.size() && (last || record.time_s[i] < share.to); ++i) {
            share.share += squares[i];
        }
        shares.push_back(share);
    }
    return shares;
}

// Octaves below half the sampling rate, the lowest down to 0; by Parseval's equation their energies are the squares'
// sum.
void add_bands(std::vector<Share>& bands, const Record& record, std::vector<double> residuals) {
    const double rate_hz = 1.0 / record.usual_interval_s;
    if (bands.empty()) {
        constexpr int octaves = 8;
        for (int octave = octaves; octave >= 1; --octave) {
            bands.push_back({octave == octaves ? 0.0 : 0.5 * rate_hz * std::ldexp(1.0, -octave),
                             0.5 * rate_hz * std::ldexp(1.0, 1 - octave), 0.0, ""});
        }
    }
    if (std::all_of(residuals.begin(), residuals.end(), [](double value) { return value == 0.0; })) {
        residuals.front() = 1.0;  // as much of each frequency
    }
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> spectrum;
    fft.fwd(spectrum, residuals);
    const std::size_t size = residuals.size();
    for (std::size_t k = 0; k < size; ++k) {
        const double hz = rate_hz * static_cast<double>(std::min(k, size - k)) / static_cast<double>(size);
        auto band = std::find_if(bands.begin(), bands.end(), [&](const Share& share) { return hz < share.to; });
        (band == bands.end() ? bands.back() : *band).share += std::norm(spectrum[k]) / static_cast<double>(size);
    }
}

template <class Values>
std::vector<Share> by_level(const std::vector<Record>& records, const std::vector<std::vector<double>>& squares,
                            const Values& values) {
    double low = values(records.front()).front();
    double high = low;
    for (const Record& record : records) {
        for (const double value : values(record)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (!(high > low)) {
        return {{low, high, 1.0, ""}};
    }
    std::vector<Share> shares;
    for (std::size_t level = 0; level < levels; ++level) {
        const auto edge = [&](std::size_t at) { return low + (high - low) * static_cast<double>(at) / levels; };
        shares.push_back({edge(level), edge(level + 1), 0.0, ""});
    }
    for (std::size_t r = 0; r < records.size(); ++r) {
        for (std::size_t i = 0; i < records[r].size(); ++i) {
            const double place = (values(records[r])[i] - low) / (high - low) * levels;
            shares[std::min<std::size_t>(levels - 1, static_cast<std::size_t>(place))].share += squares[r][i];
        }
    }
    normalise(shares);
    return shares;
}

}  // namespace

Where locate(const std::vector<Record>& records, const std::vector<std::vector<double>>& residuals) {
    const std::vector<std::vector<double>> squares = squares_of(residuals);
    Where where;
    for (std::size_t r = 0; r < records.size(); ++r) {
        for (Share& share : segments_of(records[r], squares[r])) {
            share.what = records.size() > 1 ? records[r].name + ": " + share.what : share.what;
            where.time.push_back(share);
        }
        add_bands(where.frequency, records[r], residuals[r]);
    }
    normalise(where.time);
    normalise(where.frequency);
    where.input_level =
        by_level(records, squares, [](const Record& record) -> const std::vector<double>& { return record.input; });
    where.output_level =
        by_level(records, squares, [](const Record& record) -> const std::vector<double>& { return record.output; });
    double sum = 0.0;
    for (std::size_t r = 0; r < records.size(); ++r) {
        const Record& record = records[r];
        const auto [low, high] = std::minmax_element(record.output.begin(), record.output.end());
        // Over about a fiftieth of the record the output must have moved by a hundredth of its range.
        const std::size_t reach = std::max<std::size_t>(1, record.size() / 100);
        for (std::size_t i = 0; i < record.size(); ++i) {
            const std::size_t from = i < reach ? 0 : i - reach;
            const std::size_t to = std::min(record.size() - 1, i + reach);
            const double moved = record.output[to] - record.output[from];
            double& direction = std::fabs(moved) < 0.01 * (*high - *low) ? where.still
                                : moved > 0.0                            ? where.rising
                                                                         : where.falling;
            direction += squares[r][i];
            sum += squares[r][i];
        }
    }
    where.rising /= sum;
    where.falling /= sum;
    where.still /= sum;
    return where;
}

}  // namespace gap
