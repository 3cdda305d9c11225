#include "gap/drive/study.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace gap {
namespace {

// How long the model takes to most of its way: the mean of what its terms say.
double time_constant_of(const drive::Model& model, const Record& record) {
    const double constant = drive::constant_coefficient(model.denominator);
    double sum = 0.0;
    double weight = 0.0;
    for (const drive::Term& term : model.denominator) {
        if (term.order > 0.0 && constant != 0.0) {
            sum += std::pow(std::fabs(term.coefficient / constant), 1.0 / term.order);
            weight += 1.0;
        }
    }
    const double length_s = record.time_s.back() - record.time_s.front();
    const double found = weight > 0.0 ? sum / weight : 0.1 * length_s;
    return std::min(std::max(found, 2.0 * record.usual_interval_s), 0.3 * length_s);
}

// A deployed simulation of more steps than this would take longer than the rest of the diagnosis.
constexpr double most_deployed_steps = 12000.0;

double deployed_step_of(const drive::Model& model, const Scales& scales) {
    const bool fractional = std::any_of(model.denominator.begin(), model.denominator.end(),
                                        [](const auto& term) { return term.order != std::floor(term.order); });
    const double step_s = model.sample_time_s.value_or(scales.interval_s);
    return fractional && scales.length_s / step_s <= most_deployed_steps ? step_s : 0.0;
}

// Of the second input. 0: a record has none, or it never acts.
double further_max_of(const std::vector<Record>& records) {
    double largest = 0.0;
    for (const Record& record : records) {
        if (record.more_inputs.empty()) {
            return 0.0;
        }
        for (const double u : record.more_inputs.front()) {
            largest = std::max(largest, std::fabs(u));
        }
    }
    return largest;
}

// What moves the plant where nobody drives it: it falls back from the largest reading, or its inertia carries it on.
double free_force_of(const drive::Model& model, const Scales& scales) {
    const double constant = drive::constant_coefficient(model.denominator);
    if (constant != 0.0) {
        return std::fabs(constant) * scales.output_max;
    }
    const double highest = drive::highest_order(model.denominator);
    double force = 0.0;
    for (const drive::Term& term : model.denominator) {
        if (term.order == highest) {
            force = std::fabs(term.coefficient) * scales.output_span / std::pow(scales.time_constant_s, highest);
        }
    }
    return force;
}

// The median of the jumps that are as high as the readings, beyond what they move to both sides of one.
double turn_of(const std::vector<Record>& records, double output_span) {
    constexpr double high = 0.6;
    constexpr double calm = 0.25;
    std::vector<double> jumps;
    for (const Record& record : records) {
        const std::vector<double>& z = record.output;
        for (std::size_t i = 2; i + 1 < z.size(); ++i) {
            const double before = z[i - 1] - z[i - 2];
            const double after = z[i + 1] - z[i];
            if (std::fabs(z[i] - z[i - 1]) > high * output_span && std::fabs(before) < calm * output_span &&
                std::fabs(after) < calm * output_span) {
                jumps.push_back(std::fabs(z[i] - z[i - 1] - 0.5 * (before + after)));
            }
        }
    }
    if (jumps.empty()) {
        return 0.0;
    }
    const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
    std::nth_element(jumps.begin(), middle, jumps.end());
    return *middle;
}

// Complex poles of 1 + a_1 s + a_2 s^2 + ..., as far as two orders tell.
bool swings(const drive::Model& model) {
    double a[3] = {};
    for (const drive::Term& term : model.denominator) {
        if (term.order == std::floor(term.order) && term.order <= 2.0) {
            a[static_cast<std::size_t>(term.order)] = term.coefficient;
        }
    }
    return a[1] * a[1] < 4.0 * a[0] * a[2] * 0.98;  // equal lags do not
}

}  // namespace

Scales scales_of(const drive::Model& model, const std::vector<Record>& records, const Audit& found) {
    Scales scales{};
    double input_low = 0.0;
    double input_high = 0.0;
    scales.output_low = scales.output_high = records.front().output.front();
    for (const Record& record : records) {
        for (const double u : record.input) {
            input_low = std::min(input_low, u);
            input_high = std::max(input_high, u);
        }
        for (const double z : record.output) {
            scales.output_low = std::min(scales.output_low, z);
            scales.output_high = std::max(scales.output_high, z);
        }
        scales.length_s = std::max(scales.length_s, record.time_s.back() - record.time_s.front());
    }
    scales.output_span = scales.output_high - scales.output_low;
    scales.interval_s = records.front().usual_interval_s;
    scales.time_constant_s = time_constant_of(model, records.front());
    scales.speed_max = scales.output_span / scales.time_constant_s;
    scales.output_max = std::max(std::fabs(scales.output_low), std::fabs(scales.output_high));
    const bool driven = input_low < 0.0 || input_high > 0.0;
    scales.input_max = driven ? std::max(-input_low, input_high) : 1.0;
    scales.force = driven ? std::fabs(model.gain) * scales.input_max : free_force_of(model, scales);
    constexpr double least_share = 0.05;  // of the other sign: less is an offset of the command
    scales.two_signs = std::min(-input_low, input_high) > least_share * scales.input_max;
    std::set<double> orders;
    for (const drive::Term& term : model.denominator) {
        orders.insert(std::max(0.0, term.order));
    }
    scales.orders = orders.size() - orders.count(0.0);
    scales.quantum = found.quantum;
    scales.held_share = found.held_share;
    scales.may_clip = found.may_clip;
    scales.input_levels = found.levels;
    scales.deployed_step_s = deployed_step_of(model, scales);
    scales.driven = is_driven(records);
    scales.swings = swings(model);
    constexpr double first_order = 1.2;
    scales.maybe_speed = drive::highest_order(model.denominator) <= first_order;
    scales.turn = turn_of(records, scales.output_span);
    scales.further_max = further_max_of(records);
    scales.steady = drive::constant_coefficient(model.denominator) != 0.0;
    return scales;
}

drive::Model model_of(const drive::Form& form) { return form.to_model(form.values()); }

std::vector<std::vector<char>> all_count(const std::vector<Record>& records) {
    std::vector<std::vector<char>> counts;
    for (const Record& record : records) {
        counts.emplace_back(record.size(), 1);
    }
    return counts;
}

std::vector<std::vector<char>> part_counts(const std::vector<Record>& records, std::optional<double> split_s,
                                           bool kept_aside) {
    std::vector<std::vector<char>> counts;
    for (const Record& record : records) {
        std::vector<char> count(record.size());
        for (std::size_t i = 0; i < record.size(); ++i) {
            const double share =
                (record.time_s[i] - record.time_s.front()) / (record.time_s.back() - record.time_s.front());
            const bool aside = split_s ? record.time_s[i] >= *split_s : static_cast<int>(share * 10.0) % 3 == 2;
            count[i] = aside == kept_aside ? 1 : 0;
        }
        counts.push_back(std::move(count));
    }
    return counts;
}

double over_noise(const Study& study, double rms) { return rms / std::max(study.noise, study.least_deviation); }

bool is_slow(const Study& study, double rms) {
    constexpr double usual_ratio = 8.0;
    return over_noise(study, rms) > usual_ratio;
}

bool is_driven(const std::vector<Record>& records) {
    return std::any_of(records.begin(), records.end(), [](const Record& record) {
        return std::any_of(record.input.begin(), record.input.end(), [](double u) { return u != 0.0; });
    });
}

double deviation_of(const std::vector<Record>& records) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (const Record& record : records) {
        for (const double z : record.output) {
            sum += z;
            count += 1.0;
        }
    }
    for (const Record& record : records) {
        for (const double z : record.output) {
            squares += (z - sum / count) * (z - sum / count);
        }
    }
    return std::sqrt(squares / count);
}

double rms_of(const Study& study, const std::vector<std::vector<double>>& values) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t r = 0; r < values.size(); ++r) {
        for (std::size_t i = 0; i < values[r].size(); ++i) {
            if (study.counts[r][i] != 0) {
                sum += values[r][i] * values[r][i];
                count += 1.0;
            }
        }
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

double output_deviation(const Study& study) {
    double sum = 0.0;
    double count = 0.0;
    std::vector<std::vector<double>> outputs;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        outputs.push_back(study.courses[r].record().output);
        for (std::size_t i = 0; i < outputs.back().size(); ++i) {
            if (study.counts[r][i] != 0) {
                sum += outputs.back()[i];
                count += 1.0;
            }
        }
    }
    for (auto& output : outputs) {
        for (double& value : output) {
            value -= sum / count;
        }
    }
    return rms_of(study, outputs);
}

}  // namespace gap
