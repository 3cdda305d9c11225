#include "gap/drive/base/find.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/parallel.hpp"
#include "gap/drive/base/filtered.hpp"
#include "gap/drive/base/leftover.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/fit.hpp"
#include "qemu/failure.hpp"

namespace gap {
namespace {

constexpr double most_nodes = 1500.0;  // of a record while starts are compared
// A further number takes so much of what is left where it was not fitted, or it follows something else than lags.
constexpr double worth_a_number = 0.08;
// A record that has not settled looks like an integrator's: it must be clearly better.
constexpr double worth_an_integrator = 0.3;
// Less than this over the noise is noise: descriptions that go so far go equally far.
constexpr double above_noise = 1.2;

std::vector<Course> rough_courses(const std::vector<Record>& records) {
    std::vector<Course> courses;
    for (const Record& record : records) {
        courses.emplace_back(record, std::min(1.0, most_nodes / static_cast<double>(record.size())));
    }
    return courses;
}

// As many equal lags as the structure has, of each of some sizes: where noise or nonlinearity leaves the filtered
// equations without a solution.
std::vector<Coefficients> even_lags(const Structure& structure, double shortest_s, double length_s, bool driven) {
    constexpr int sizes = 9;
    std::vector<Coefficients> all;
    for (int i = 0; i < sizes; ++i) {
        const double lag_s = 0.3 * length_s * std::pow(shortest_s / (0.3 * length_s), static_cast<double>(i) / sizes);
        for (const double share : {0.0, 0.3, 1.0, 2.0, 4.0}) {
            if ((share > 0.0 && !driven) || share * lag_s > 0.3 * length_s) {
                continue;
            }
            Coefficients one;
            one.delay_s = share * lag_s;
            const int lags = structure.order - structure.integrators;
            double binomial = 1.0;
            for (int power = 1; power <= lags; ++power) {
                binomial *= static_cast<double>(lags - power + 1) / power;
                one.denominator.push_back(binomial * std::pow(lag_s, power));
            }
            one.numerator.assign(static_cast<std::size_t>(structure.zeros), 0.5 * lag_s);
            all.push_back(std::move(one));
        }
    }
    return all;
}

bool fits_in(const Structure& structure, bool driven) {
    return driven || (structure.integrators == 0 && structure.zeros == 0);
}

double gap_of(const Study& study, const Candidate& candidate) {
    const double gap = rms_of(study, all_residuals(study, candidate)) / output_deviation(study);
    return std::isfinite(gap) ? gap : std::numeric_limits<double>::infinity();
}

// The training records up to the split, of which some blocks are kept aside: which description is best is asked where
// they were taken. Elsewhere nonlinearity decides, and whatever follows nothing is as good as any.
Question of_training(const Question& question) {
    Question alone = question;
    alone.validate.clear();
    alone.split_s.reset();
    alone.refit = true;
    alone.jobs = 1;
    if (question.split_s && question.validate.empty()) {
        for (Record& record : alone.train) {
            record = up_to(record, *question.split_s);
        }
    }
    return alone;
}

std::optional<Described> describe(const Structure& structure, Question alone, Question asked) {
    try {
        alone.form = start_of(structure, alone.train);
    } catch (const glsum::Failure&) {
        return std::nullopt;  // nothing of this structure; others go on
    }
    const Ground part = prepare(alone);
    const Candidate of_part = fit(part.study, {}, part.base, nullptr);
    asked.form = with_values(alone.form, of_part);
    const Ground whole = prepare(asked);
    const Candidate fitted = fit(whole.study, {}, whole.base, nullptr);
    const Candidate judged = whole.same_records ? fitted : carried_over(whole.validation, fitted, nullptr);
    Described found{structure.name,
                    structure.meaning,
                    with_values(asked.form, fitted),
                    gap_of(part.validation, of_part),
                    gap_of(whole.validation, judged),
                    structure.numbers(),
                    structure.integrators};
    return std::isfinite(found.aside) && std::isfinite(found.validation) ? std::optional(found) : std::nullopt;
}

}  // namespace

drive::Form form_to_find() { return {drive::Kind::fopdt, drive::make_fopdt(1.0, 1.0, 0.0)}; }

drive::Form start_of(const Structure& structure, const std::vector<Record>& records) {
    const bool driven = is_driven(records);
    double length_s = 0.0;
    for (const Record& record : records) {
        length_s = std::max(length_s, record.time_s.back() - record.time_s.front());
    }
    std::vector<Coefficients> starts = filtered_estimates(structure, records, driven);
    const std::vector<Coefficients> even = even_lags(structure, records.front().usual_interval_s, length_s, driven);
    starts.insert(starts.end(), even.begin(), even.end());
    const std::vector<Course> courses = rough_courses(records);
    double least = std::numeric_limits<double>::infinity();
    Coefficients best;
    for (Coefficients& start : starts) {
        start.gain = 1.0;
        const drive::Form form = form_of(structure, start, driven);
        if (const Leftover left = leftover_of(model_of(form), courses, driven); left.squares < least) {
            least = left.squares;
            best = start;
            best.gain = left.gain;
        }
    }
    if (!std::isfinite(least)) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: no {} ({}) explains anything of it: do input and output belong together?",
                                         records.front().name, structure.name, structure.meaning));
    }
    return form_of(structure, best, driven);
}

std::vector<Described> find_base(const Question& question, const std::function<void(const std::string&)>& say) {
    const bool driven = is_driven(question.train);
    std::vector<const Structure*> tried;
    for (const Structure& structure : structures()) {
        if (fits_in(structure, driven)) {
            tried.push_back(&structure);
        }
    }
    say(fmt::format("looking for the base: {} linear descriptions", tried.size()));
    std::vector<std::optional<Described>> found(tried.size());
    const Question alone = of_training(question);
    Question asked = question;
    asked.refit = true;
    asked.jobs = 1;
    bench::parallel_for(tried.size(), question.jobs,
                        [&](std::size_t i) { found[i] = describe(*tried[i], alone, asked); });
    std::vector<Described> all;
    for (std::optional<Described>& one : found) {
        if (one) {
            all.push_back(std::move(*one));
        }
    }
    if (all.empty()) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: no linear description explains anything of it: do input and output belong "
                        "together?",
                        question.train.front().name));
    }
    const double floor = above_noise * audit(alone.train).noise / deviation_of(alone.train);
    const auto size_of = [&](double gap) { return std::log(std::max({gap, floor, 1e-6})); };
    const auto price = [&](const Described& one) {
        return 0.5 * (size_of(one.aside) + size_of(one.validation)) + worth_a_number * one.numbers +
               (one.integrators > 0 ? worth_an_integrator : 0.0);
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Described& a, const Described& b) { return price(a) < price(b); });
    return all;
}

}  // namespace gap
