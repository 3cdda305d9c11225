#include "gap/drive/base/signs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "gap/drive/base/find.hpp"
#include "gap/drive/base/part.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/fit.hpp"

namespace gap {

bool may_have_lost_signs(const std::vector<Record>& records) {
    double low = 0.0;
    double high = 0.0;
    bool above = false;
    bool below = false;
    for (const Record& record : records) {
        for (std::size_t i = 0; i < record.size(); ++i) {
            low = std::min(low, record.output[i]);
            high = std::max(high, record.output[i]);
            above = above || record.input[i] > 0.0;
            below = below || record.input[i] < 0.0;
        }
    }
    constexpr double noise_share = 0.05;
    return above && below && low > -noise_share * (high - low);
}

namespace {

// Where the values are least before they rise by so much again.
template <class At>
At first_turn(At begin, At end, double rise) {
    At least = begin;
    for (At at = begin; at != end && *at <= *least + rise; ++at) {
        least = *at < *least ? at : least;
    }
    return least;
}

}  // namespace

std::vector<Record> with_signs(std::vector<Record> records) {
    for (Record& record : records) {
        const double highest = *std::max_element(record.output.begin(), record.output.end());
        double sign = 1.0;
        double driven = 0.0;  // the last sign of the input that is none of 0
        std::size_t from = 0;
        for (std::size_t i = 0; i <= record.size(); ++i) {
            const double now =
                i == record.size() || record.input[i] == 0.0 ? driven : std::copysign(1.0, record.input[i]);
            if (i < record.size() && now == driven) {
                continue;
            }
            // What lies before this change of the input: the sign of the last one, from where the readings first turn.
            const auto begin = record.output.begin() + static_cast<std::ptrdiff_t>(from);
            const auto end = record.output.begin() + static_cast<std::ptrdiff_t>(i);
            const auto turn = first_turn(begin, end, 0.05 * highest);
            for (auto at = begin; at != end; ++at) {
                *at *= driven != 0.0 && at >= turn ? driven : sign;
            }
            sign = driven != 0.0 ? driven : now;
            driven = now;
            from = i;
        }
    }
    return records;
}

namespace {

// From one step of the grid to the next.
constexpr double times_the_lag = 1.75;
constexpr double times_the_period = 1.4;

// Of a lag and an oscillator: the one whose magnitudes the readings are, with the gain that suits them best.
drive::Model shape_of_magnitudes(const std::vector<Record>& records) {
    std::vector<Part> parts;
    std::ranges::transform(records, std::back_inserter(parts), part_of);
    std::vector<Course> courses;
    double length_s = 0.0;
    for (const Part& part : parts) {
        courses.emplace_back(part.record, part.per_interval);
        length_s = std::max(length_s, part.record.time_s.back() - part.record.time_s.front());
    }
    const double shortest_s = records.front().usual_interval_s;
    const double longest_s = 0.1 * length_s;
    drive::Model best;
    double least = std::numeric_limits<double>::infinity();
    const auto rate = [&](const Coefficients& shape) {
        Scenario scenario;
        scenario.model = model_of(form_of(*structure_named("third_order"), shape, true));
        double theirs = 0.0;
        double both = 0.0;
        double mine = 0.0;
        for (const Course& course : courses) {
            const std::vector<double> moved = simulate(scenario, course);
            const std::vector<double>& read = course.record().output;
            for (std::size_t i = 0; i < read.size(); ++i) {
                theirs += read[i] * read[i];
                both += std::fabs(read[i] * moved[i]);
                mine += moved[i] * moved[i];
            }
        }
        const double left = theirs - both * both / mine;
        if (std::isfinite(left) && left < least) {
            least = left;
            best = scenario.model;
            best.gain = both / mine;
        }
    };
    for (double lag_s = shortest_s; lag_s < longest_s; lag_s *= times_the_lag) {
        for (double swing_s = shortest_s; swing_s < longest_s; swing_s *= times_the_period) {
            for (const double damping : {0.1, 0.25, 0.6}) {
                for (const double delay_s : {0.0, 0.5 * swing_s}) {
                    rate(lag_and_oscillator(lag_s, swing_s, damping, delay_s));
                }
            }
        }
    }
    return best;
}

std::vector<Record> with_signs_of(const drive::Model& model, std::vector<Record> records) {
    for (Record& record : records) {
        const Part part = part_of(record);
        Scenario scenario;
        scenario.model = model;
        const std::vector<double> moved = simulate(scenario, Course(record, part.per_interval));
        for (std::size_t i = 0; i < moved.size(); ++i) {
            record.output[i] = std::copysign(record.output[i], moved[i]);
        }
    }
    return records;
}

struct Signed {
    Question question;
    double cost;
};

// Signs of a base that is fitted to the signs before, while they change.
Signed settled(Question question) {
    const Structure& structure = *structure_named("third_order");
    constexpr int rounds = 12;
    double cost = 0.0;
    for (int round = 0; round < rounds; ++round) {
        question.form = starts_of(structure, question.train).whole;
        const Ground ground = prepare(question);
        const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
        cost = fitted.cost;
        bool changed = false;
        const auto take = [&](std::vector<Record>& records, const Study& study, const Candidate& candidate) {
            for (std::size_t r = 0; r < records.size(); ++r) {
                const std::vector<double> left = residuals_of(study, candidate, r);
                for (std::size_t i = 0; i < left.size(); ++i) {
                    double& z = records[r].output[i];
                    const double now = std::copysign(z, z - left[i]);
                    changed = changed || now != z;
                    z = now;
                }
            }
        };
        Question next = question;
        take(next.train, ground.study, fitted);
        if (!question.validate.empty()) {
            take(next.validate, ground.validation, carried_over(ground.validation, fitted, nullptr));
        }
        question.train = std::move(next.train);
        question.validate = std::move(next.validate);
        if (!changed) {
            break;
        }
    }
    return {std::move(question), cost};
}

}  // namespace

Question with_signs_of_a_base(Question question) {
    question.refit = true;
    Question of_input = question;
    of_input.train = with_signs(question.train);
    of_input.validate = with_signs(question.validate);
    const drive::Model shape = shape_of_magnitudes(question.train);
    question.train = with_signs_of(shape, std::move(question.train));
    question.validate = with_signs_of(shape, std::move(question.validate));
    Signed by_input = settled(std::move(of_input));
    Signed by_shape = settled(std::move(question));
    return by_shape.cost < by_input.cost ? std::move(by_shape.question) : std::move(by_input.question);
}

}  // namespace gap
