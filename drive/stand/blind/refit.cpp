#include "drive/stand/blind/refit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drive/stand/blind/simplex.hpp"

namespace stand::blind {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

Matrix3 product(const Matrix3& a, const Matrix3& b) {
    const auto of = [&](std::size_t i, std::size_t j) {
        return a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    };
    return {{{of(0, 0), of(0, 1), of(0, 2)}, {of(1, 0), of(1, 1), of(1, 2)}, {of(2, 0), of(2, 1), of(2, 2)}}};
}

// Place, speed (times T) and held input one step on: the exponential, by Taylor's terms of a small part, squared.
Matrix3 one_step(double time_s, double damping, double step_s) {
    constexpr int squarings = 12;
    const double small = step_s / time_s / std::pow(2.0, squarings);
    const Matrix3 rate{{{0.0, small, 0.0}, {-small, -2.0 * damping * small, small}, {0.0, 0.0, 0.0}}};
    Matrix3 term{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    Matrix3 sum = term;
    for (int n = 1; n <= 6; ++n) {
        term = product(term, rate);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                term[i][j] /= n;
                sum[i][j] += term[i][j];
            }
        }
    }
    for (int n = 0; n < squarings; ++n) {
        sum = product(sum, sum);
    }
    return sum;
}

// A record's input through the two poles, without delay.
struct Through {
    std::vector<double> place;
    std::vector<double> speed;
};

std::vector<Through> filter(std::span<const EvenRecord> records, double time_s, double damping, double step_s) {
    const Matrix3 step = one_step(time_s, damping, step_s);
    std::vector<Through> all;
    for (const EvenRecord& record : records) {
        Through through;
        double place = 0.0;
        double speed = 0.0;
        for (const double u : record.input) {
            through.place.push_back(place);
            through.speed.push_back(speed);
            const double next = step[0][0] * place + step[0][1] * speed + step[0][2] * u;
            speed = step[1][0] * place + step[1][1] * speed + step[1][2] * u;
            place = next;
        }
        all.push_back(std::move(through));
    }
    return all;
}

// Place and speed a dead time ago, which need not be a whole number of steps: moved on from the step before.
class Delayed {
public:
    Delayed(double time_s, double damping, double delay_s, double step_s)
        : whole_(static_cast<std::size_t>(std::ceil(delay_s / step_s - 1e-9))),
          part_(one_step(time_s, damping, static_cast<double>(whole_) * step_s - delay_s)) {}

    [[nodiscard]] std::array<double, 2> at(const EvenRecord& record, const Through& through, std::size_t k) const {
        if (k < whole_) {
            return {0.0, 0.0};
        }
        const double place = through.place[k - whole_];
        const double speed = through.speed[k - whole_];
        const double u = record.input[k - whole_];
        return {part_[0][0] * place + part_[0][1] * speed + part_[0][2] * u,
                part_[1][0] * place + part_[1][1] * speed + part_[1][2] * u};
    }

private:
    std::size_t whole_;
    Matrix3 part_;
};

// Sums of squares and products of 1, place, speed and output.
struct Sums {
    std::array<std::array<double, 4>, 4> of{};
    void add(double place, double speed, double output) {
        const std::array<double, 4> row{1.0, place, speed, output};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i; j < 4; ++j) {
                of[i][j] += row[i] * row[j];
            }
        }
    }
};

// Gauss' elimination of the normal equations: what is left of the output's square is the sum of squares that remains.
double solve(Sums sums, LinearBase& base) {
    auto& m = sums.of;
    std::array<double, 3> root{};
    for (std::size_t p = 0; p < 3; ++p) {
        const double pivot = m[p][p];
        if (!(pivot > 1e-12)) {
            continue;  // a regressor that adds nothing to those before
        }
        root[p] = pivot;
        for (std::size_t i = p + 1; i < 4; ++i) {
            const double factor = m[p][i] / pivot;
            for (std::size_t j = i; j < 4; ++j) {
                m[i][j] -= factor * m[p][j];
            }
        }
    }
    std::array<double, 3> value{};
    for (std::size_t p = 3; p-- > 0;) {
        double rest = m[p][3];
        for (std::size_t j = p + 1; j < 3; ++j) {
            rest -= m[p][j] * value[j];
        }
        value[p] = root[p] > 0.0 ? rest / root[p] : 0.0;
    }
    base.offset = value[0];
    base.gain = value[1];
    base.lead_gain = value[2];
    return std::max(0.0, m[3][3]);
}

class Search {
public:
    Search(std::span<const EvenRecord> records, double step_s) : records_(records), step_s_(step_s) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const EvenRecord& record : records) {
            for (const double u : record.input) {
                input_ = std::max(input_, std::fabs(u));
            }
            for (std::size_t k = record.from; k < record.output.size(); ++k) {
                low = std::min(low, record.output[k]);
                high = std::max(high, record.output[k]);
            }
        }
        middle_ = 0.5 * (low + high);
        half_ = std::max(0.5 * (high - low), 1e-300);
        input_ = std::max(input_, 1e-300);
    }

    void through(double time_s, double damping) { through_ = filter(records_, time_s, damping, step_s_); }

    // Of output and input in units of their ranges, so that pivots and sums are about 1 a sample.
    double cost(LinearBase& base) const {
        Sums sums;
        const Delayed delayed(base.time_s, base.damping, base.delay_s, step_s_);
        for (std::size_t r = 0; r < records_.size(); ++r) {
            for (std::size_t k = records_[r].from; k < records_[r].output.size(); ++k) {
                const auto [place, speed] = delayed.at(records_[r], through_[r], k);
                sums.add(place / input_, speed / input_, (records_[r].output[k] - middle_) / half_);
            }
        }
        const double left = solve(sums, base);
        base.offset = middle_ + half_ * base.offset;
        base.gain *= half_ / input_;
        base.lead_gain *= half_ / input_;
        return left;
    }

    double cost_anew(LinearBase& base) {
        through(base.time_s, base.damping);
        return cost(base);
    }

private:
    std::span<const EvenRecord> records_;
    double step_s_;
    double middle_ = 0.0;
    double half_ = 1.0;
    double input_ = 0.0;
    std::vector<Through> through_;
};

struct Start {
    double cost;
    LinearBase base;
};

// Of each time constant its best, the best first; the sum of squares has more than one valley.
std::vector<Start> starts_of(Search& search, double tau_s) {
    std::vector<Start> starts;
    for (const double time : {0.15, 0.3, 0.6, 1.0, 1.8}) {
        Start start{std::numeric_limits<double>::infinity(), {}};
        for (const double damping : {0.3, 0.7, 1.2, 2.5}) {
            search.through(time * tau_s, damping);
            for (const double delay : {0.0, 0.1, 0.25, 0.5, 1.0}) {
                LinearBase tried{time * tau_s, damping, delay * tau_s};
                const double cost = search.cost(tried);
                if (cost < start.cost) {
                    start = {cost, tried};
                }
            }
        }
        starts.push_back(start);
    }
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
    return starts;
}

}  // namespace

LinearBase start_of(std::span<const EvenRecord> records, double step_s, double tau_s) {
    Search search(records, step_s);
    return starts_of(search, tau_s).front().base;
}

LinearBase fit_base(std::span<const EvenRecord> records, double step_s, double tau_s) {
    Search search(records, step_s);
    const std::vector<Start> starts = starts_of(search, tau_s);
    LinearBase best = starts.front().base;
    double least = starts.front().cost;
    // In the logarithms of time and damping and in the delay.
    const auto at = [&](const Point3& point) {
        LinearBase tried{tau_s * std::exp(point[0]), std::clamp(std::exp(point[1]), 0.05, 20.0),
                         tau_s * std::max(0.0, point[2])};
        const double cost = search.cost_anew(tried);
        if (cost < least) {
            least = cost;
            best = tried;
        }
        return cost;
    };
    const auto point_of = [&](const LinearBase& base) {
        return Point3{std::log(base.time_s / tau_s), std::log(base.damping), base.delay_s / tau_s};
    };
    constexpr std::size_t valleys = 3;
    for (std::size_t i = 0; i < valleys; ++i) {
        descend_simplex(point_of(starts[i].base), 0.3, at);
    }
    descend_simplex(point_of(best), 0.1, at);
    return best;
}

double misfit(const LinearBase& base, std::span<const EvenRecord> records, double step_s) {
    const auto through = filter(records, base.time_s, base.damping, step_s);
    const Delayed delayed(base.time_s, base.damping, base.delay_s, step_s);
    double square = 0.0;
    double count = 0.0;
    for (std::size_t r = 0; r < records.size(); ++r) {
        for (std::size_t k = records[r].from; k < records[r].output.size(); ++k) {
            const auto [place, speed] = delayed.at(records[r], through[r], k);
            const double left = records[r].output[k] - base.offset - base.gain * place - base.lead_gain * speed;
            square += left * left;
            count += 1.0;
        }
    }
    return std::sqrt(square / std::max(count, 1.0));
}

}  // namespace stand::blind
