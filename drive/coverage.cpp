#include "drive/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <random>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "drive/quantiles.hpp"

namespace drive {
namespace {

double uniform(std::mt19937_64& random) { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; }

// Box and Muller's, not the library's: the same log everywhere.
double normal(std::mt19937_64& random) {
    const double radius = std::sqrt(-2.0 * std::log(uniform(random)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(random));
}

// Of a set of logs each its own, and another one in every set: the seed of a set is no log's.
std::uint64_t seed_of(std::uint64_t set, std::size_t run) {
    std::seed_seq words{set & 0xFFFFFFFFU, set >> 32U, static_cast<std::uint64_t>(run)};
    std::array<std::uint32_t, 2> mixed{};
    words.generate(mixed.begin(), mixed.end());
    return std::uint64_t{mixed[0]} << 32U | mixed[1];
}

// Of what a model leaves of some records.
double sum_of_squares(const Model& model, const std::vector<Record>& records) {
    double sum = 0.0;
    for (const Record& record : records) {
        const std::vector<double> output = respond_to(model, record);
        for (std::size_t k = 0; k < output.size(); ++k) {
            sum += (output[k] - record.output[k]) * (output[k] - record.output[k]);
        }
    }
    return sum;
}

}  // namespace

Log take_log(const Model& model, const Acquisition& acquisition, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Log log;
    log.name = "seed " + std::to_string(seed);
    log.input = make_input(acquisition.excitation, acquisition.interval_s, acquisition.until_s);
    for (std::size_t k = 0; k < log.input.size(); ++k) {
        const double even = static_cast<double>(k) * acquisition.interval_s;
        log.time_s.push_back(k == 0 ? 0.0 : even + acquisition.jitter_s * (2.0 * uniform(random) - 1.0));
        log.line.push_back(k + 2);
    }
    log.output = respond(model, changes_of(log.time_s, log.input), log.time_s);
    for (double& value : log.output) {
        value += acquisition.noise * normal(random);
        if (acquisition.quantum > 0.0) {
            value = std::round(value / acquisition.quantum) * acquisition.quantum;
        }
    }
    return log;
}

Fit fit_from_nothing(Kind kind, const std::vector<Record>& records, const FitOptions& options,
                     const std::function<void(Form&)>& prepare) {
    const auto last = [&](Form form) {
        if (prepare) {
            prepare(form);
        }
        return fit(form, records, options);
    };
    if (kind == Kind::fopdt || kind == Kind::sopdt) {
        return last(Form(kind, search_start(kind, records)));
    }
    FitOptions first = options;
    first.prediction_error = false;
    first.profile = false;
    first.accepted_error = 0.0;
    first.starts_if_poor = 0;  // of what swings it is poor by its form
    const Model damped = fit(Form(Kind::sopdt, search_start(Kind::sopdt, records)), records, first).model;
    // Two equal time constants cannot swing: a descent from there ends in the first valley of a plant that does.
    const Model swinging = search_start(Kind::niopdt, records);
    return last(Form(kind, sum_of_squares(swinging, records) < sum_of_squares(damped, records) ? swinging : damped));
}

Coverage measure_coverage(const Model& truth, Kind kind, const Acquisition& acquisition, std::size_t runs,
                          std::uint64_t set, unsigned jobs, const std::function<void()>& done) {
    const Form form(kind, truth);
    Coverage coverage;
    coverage.runs = runs;
    for (const Parameter& parameter : form.parameters()) {
        if (!parameter.fixed) {
            coverage.names.push_back(parameter.name);
            coverage.truth.push_back(parameter.value);
        }
    }
    const std::size_t free = coverage.names.size();
    coverage.inside.assign(free, 0);
    coverage.claimed.assign(free, 0.0);
    std::vector<std::vector<double>> estimates(free);
    const auto jointly_holds = [&](const Fit& found, const Record& record) {
        const double sum = sum_of_squares(truth, {record});
        const auto parameters = static_cast<double>(free);
        const double freedom = static_cast<double>(record.output.size()) - parameters;
        const double variance = found.sum_of_squares / freedom;
        return (sum - found.sum_of_squares) / (parameters * variance) <= fisher_f_quantile(parameters, freedom, 0.95);
    };
    std::mutex mutex;
    base::parallel_for(runs, jobs, [&](std::size_t run) {
        try {
            const Record record = to_record(take_log(truth, acquisition, seed_of(set, run)));
            const Fit found = fit_from_nothing(kind, {record}, {.profile = true});
            const bool jointly = jointly_holds(found, record);
            const std::lock_guard lock(mutex);
            coverage.jointly_inside += jointly ? 1 : 0;
            std::size_t at = 0;
            for (const Estimate& estimate : found.parameters) {
                if (!estimate.fixed) {
                    coverage.inside[at] +=
                        estimate.low <= coverage.truth[at] && coverage.truth[at] <= estimate.high ? 1 : 0;
                    coverage.claimed[at] += estimate.deviation;
                    estimates[at++].push_back(estimate.value);
                }
            }
        } catch (const glsum::Failure&) {
            const std::lock_guard lock(mutex);
            ++coverage.failed;
        }
        if (done) {
            done();
        }
    });
    for (std::size_t i = 0; i < free; ++i) {
        const auto count = static_cast<double>(std::max<std::size_t>(estimates[i].size(), 1));
        double mean = 0.0;
        for (const double value : estimates[i]) {
            mean += value / count;
        }
        double square = 0.0;
        for (const double value : estimates[i]) {
            square += (value - mean) * (value - mean);
        }
        coverage.mean.push_back(mean);
        coverage.spread.push_back(std::sqrt(square / std::max(1.0, count - 1.0)));
        coverage.claimed[i] /= count;
    }
    return coverage;
}

}  // namespace drive
