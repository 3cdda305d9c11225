#include "gap/drive/residuals/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <unsupported/Eigen/FFT>

namespace gap {
namespace {

constexpr std::size_t most_segments = 16;
constexpr std::size_t levels = 5;        // where there are many
constexpr std::size_t most_levels = 12;  // that stand for themselves

// What residuals are shared out by, of each record: their squares and, of the same sum by Parseval's equation, those of
// their spectrum.
struct Squares {
    std::vector<std::vector<double>> in_time;
    std::vector<std::vector<double>> by_frequency;
};

std::vector<double> squared_spectrum_of(const std::vector<double>& residuals) {
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> spectrum;
    fft.fwd(spectrum, residuals);
    std::vector<double> squares;
    for (const std::complex<double>& line : spectrum) {
        squares.push_back(std::norm(line) / static_cast<double>(residuals.size()));
    }
    return squares;
}

// Ones where no record has a gap, so that shares exist.
Squares squares_of(const std::vector<std::vector<double>>& residuals) {
    double sum = 0.0;
    Squares all{residuals, {}};
    for (auto& record : all.in_time) {
        for (double& value : record) {
            value *= value;
            sum += value;
        }
    }
    if (!(sum > 0.0)) {
        for (auto& record : all.in_time) {
            std::fill(record.begin(), record.end(), 1.0);
        }
        all.by_frequency = all.in_time;
        return all;
    }
    for (const auto& record : residuals) {
        all.by_frequency.push_back(squared_spectrum_of(record));
    }
    return all;
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

// Where the input leaves a stretch that it had rested in: within a fiftieth of its span, so that steps of 5 % are
// moves, and a ramp is one.
std::vector<std::pair<std::size_t, std::string>> level_moves_of(const Record& record) {
    const std::vector<double>& input = record.input;
    const auto [low, high] = std::minmax_element(input.begin(), input.end());
    const double small = 0.02 * (*high - *low) * (1.0 - 1e-9);
    const std::size_t quiet = std::max<std::size_t>(3, record.size() / 200);
    std::vector<std::pair<std::size_t, std::string>> moves;
    std::optional<double> rest;
    for (std::size_t i = 0; i < record.size();) {
        std::size_t end = i;
        while (end < record.size() && std::fabs(input[end] - input[i]) < small) {
            ++end;
        }
        if (end - i < quiet) {
            ++i;
            continue;
        }
        if (rest && std::fabs(input[i] - *rest) >= small) {
            moves.back().second = fmt::format("input {:.4g} -> {:.4g}", *rest, input[i]);
        }
        rest = input[i];
        if (end < record.size()) {
            moves.emplace_back(end, fmt::format("input leaves {:.4g}", *rest));
        }
        i = end;
    }
    return moves;
}

// Parts of a record: what follows each move of its input, in pieces that are no longer than a fifth of the record;
// even parts where nothing moves, or all the time.
std::vector<Share> segments_of(const Record& record, const std::vector<double>& squares) {
    const double length_s = record.time_s.back() - record.time_s.front();
    std::vector<std::pair<double, std::string>> starts = {{record.time_s.front(), "start"}};
    for (const auto& [at, what] : level_moves_of(record)) {
        starts.emplace_back(record.time_s[at], what);
    }
    if (starts.size() > most_segments || starts.size() < 2) {
        starts = {{record.time_s.front(), ""}};
    }
    std::vector<Share> shares;
    std::size_t i = 0;
    for (std::size_t s = 0; s < starts.size(); ++s) {
        const double from_s = starts[s].first;
        const double to_s = s + 1 == starts.size() ? record.time_s.back() : starts[s + 1].first;
        const double most_s = starts.size() == 1 ? 0.1 * length_s : 0.2 * length_s;
        const int pieces = std::max(1, static_cast<int>(std::ceil((to_s - from_s) / most_s - 1e-9)));
        for (int piece = 0; piece < pieces; ++piece) {
            const bool last = s + 1 == starts.size() && piece + 1 == pieces;
            const auto edge_s = [&](int at) { return at == pieces ? to_s : from_s + (to_s - from_s) * at / pieces; };
            Share share{edge_s(piece), edge_s(piece + 1), 0.0, starts[s].second};
            for (; i < record.size() && (last || record.time_s[i] < share.to); ++i) {
                share.share += squares[i];
            }
            shares.push_back(share);
        }
    }
    return shares;
}

// Samples a second, in the mean: the length of a record, not its usual interval, tells its lowest frequency.
double rate_of(const Record& record) {
    return static_cast<double>(record.size() - 1) / (record.time_s.back() - record.time_s.front());
}

// What is constant, and then half-decades, about, from one period in the longest record to half the highest rate.
std::vector<Share> bands_of(const std::vector<Record>& records) {
    double lowest_hz = std::numeric_limits<double>::infinity();
    double highest_hz = 0.0;
    for (const Record& record : records) {
        const double rate_hz = rate_of(record);
        lowest_hz = std::min(lowest_hz, rate_hz / static_cast<double>(record.size()));
        highest_hz = std::max(highest_hz, 0.5 * rate_hz);
    }
    // A period in each record lies above the constant's band, whatever is rounded.
    lowest_hz *= 1.0 - 1e-9;
    const int count = static_cast<int>(std::lround(2.0 * std::log10(highest_hz / lowest_hz)));
    std::vector<Share> bands = {{0.0, lowest_hz, 0.0, ""}};
    for (int band = 1; band <= count; ++band) {
        const double to_hz = band == count
                                 ? highest_hz
                                 : lowest_hz * std::pow(highest_hz / lowest_hz, static_cast<double>(band) / count);
        bands.push_back({bands.back().to, to_hz, 0.0, ""});
    }
    return bands;
}

void add_bands(std::vector<Share>& bands, const Record& record, const std::vector<double>& squares) {
    const std::size_t size = squares.size();
    for (std::size_t k = 0; k < size; ++k) {
        const double hz = rate_of(record) * static_cast<double>(std::min(k, size - k)) / static_cast<double>(size);
        auto band = std::find_if(bands.begin(), bands.end(), [&](const Share& share) { return hz < share.to; });
        (band == bands.end() ? bands.back() : *band).share += squares[k];
    }
}

// Values in groups that lie within a two-hundredth of the span; none where there are more of them than a few.
std::vector<Share> few_levels(std::vector<double> values, double span) {
    std::sort(values.begin(), values.end());
    std::vector<Share> found;
    for (const double value : values) {
        if (found.empty() || value - found.back().from > 0.005 * span) {
            found.push_back({value, value, 0.0, ""});
            if (found.size() > most_levels) {
                return {};
            }
        }
        found.back().to = value;
    }
    return found;
}

std::vector<Share> even_levels(double low, double high) {
    std::vector<Share> shares;
    for (std::size_t level = 0; level < levels; ++level) {
        const auto edge = [&](std::size_t at) { return low + (high - low) * static_cast<double>(at) / levels; };
        shares.push_back({edge(level), edge(level + 1), 0.0, ""});
    }
    return shares;
}

template <class Values>
std::vector<Share> by_level(const std::vector<Record>& records, const std::vector<std::vector<double>>& squares,
                            const Values& values) {
    std::vector<double> all;
    for (const Record& record : records) {
        all.insert(all.end(), values(record).begin(), values(record).end());
    }
    const auto [low, high] = std::minmax_element(all.begin(), all.end());
    std::vector<Share> shares = few_levels(all, *high - *low);
    if (shares.empty()) {
        shares = even_levels(*low, *high);
    }
    for (std::size_t r = 0; r < records.size(); ++r) {
        auto square = squares[r].begin();
        for (const double at : values(records[r])) {
            const auto above = std::upper_bound(shares.begin(), shares.end(), at,
                                                [](double value, const Share& share) { return value < share.from; });
            std::prev(above)->share += *square++;
        }
    }
    normalise(shares);
    return shares;
}

// To what counts, where that is one stretch; elsewhere the rest is 0.
void cut(Record& record, std::vector<double>& residuals, const std::vector<char>& counts) {
    const auto from = std::find_if(counts.begin(), counts.end(), [](char count) { return count != 0; });
    const auto to = std::find(from, counts.end(), 0);
    const bool one_stretch = to - from >= 32 && std::all_of(to, counts.end(), [](char count) { return count == 0; });
    if (!one_stretch) {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            residuals[i] = counts[i] != 0 ? residuals[i] : 0.0;
        }
        return;
    }
    for (std::vector<double>* values : {&record.time_s, &record.input, &record.output, &residuals}) {
        *values = {values->begin() + (from - counts.begin()), values->begin() + (to - counts.begin())};
    }
}

// Without its folders.
std::string file_name(const std::string& name) { return name.substr(name.find_last_of('/') + 1); }

}  // namespace

Where locate(std::vector<Record> records, std::vector<std::vector<double>> residuals,
             const std::vector<std::vector<char>>& counts) {
    for (std::size_t r = 0; r < counts.size(); ++r) {
        cut(records[r], residuals[r], counts[r]);
    }
    const auto [squares, by_frequency] = squares_of(residuals);
    Where where;
    where.frequency = bands_of(records);
    for (std::size_t r = 0; r < records.size(); ++r) {
        for (Share& share : segments_of(records[r], squares[r])) {
            if (records.size() > 1) {
                share.what = file_name(records[r].name) + (share.what.empty() ? "" : ": ") + share.what;
            }
            where.time.push_back(share);
        }
        add_bands(where.frequency, records[r], by_frequency[r]);
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
            const std::size_t from = i - std::min(i, reach);
            const std::size_t to = std::min(record.size() - 1, i + reach);
            const double moved = record.output[to] - record.output[from];
            const bool still = moved == 0.0 || std::fabs(moved) < 0.01 * (*high - *low);
            double& direction = still ? where.still : moved > 0.0 ? where.rising : where.falling;
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
