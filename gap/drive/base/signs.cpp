#include "gap/drive/base/signs.hpp"

#include <algorithm>
#include <cmath>

#include "gap/drive/base/find.hpp"
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

Question with_signs_of_a_base(Question question) {
    question.train = with_signs(std::move(question.train));
    question.validate = with_signs(std::move(question.validate));
    question.refit = true;
    const Structure& structure = *structure_named("third_order");
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round) {
        question.form = starts_of(structure, question.train).whole;
        const Ground ground = prepare(question);
        const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
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
    return question;
}

}  // namespace gap
