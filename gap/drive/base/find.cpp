#include "gap/drive/base/find.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "gap/drive/base/filtered.hpp"
#include "gap/drive/base/in_order.hpp"
#include "gap/drive/base/leftover.hpp"
#include "gap/drive/base/part.hpp"
#include "gap/drive/base/refined.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/fit.hpp"

namespace gap {
namespace {

// How long ago what was read is no longer quick, over a record's length.
constexpr double quick_share = 0.03;
// One that leaves so much of what is quick in the other's stead is looked at, too.
constexpr double worth_a_quick_one = 0.97;
// Less than this over the noise is noise: descriptions that go so far go equally far.
constexpr double above_noise = 1.2;

double longest_s(const std::vector<Record>& records) {
    double length_s = 0.0;
    for (const Record& record : records) {
        length_s = std::max(length_s, record.time_s.back() - record.time_s.front());
    }
    return length_s;
}

std::vector<Course> rough_courses(const std::vector<Part>& parts) {
    std::vector<Course> courses;
    for (const Part& part : parts) {
        courses.emplace_back(part.record, part.per_interval);
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

// Fractional ones of as long, of some orders: a coefficient is a time to the power of its order.
std::vector<Coefficients> of_some_orders(const std::vector<Coefficients>& whole) {
    std::vector<Coefficients> all;
    for (const Coefficients& one : whole) {
        for (const double share : {0.5, 0.75, 1.0}) {
            Coefficients fractional = one;
            for (std::size_t i = 0; i < one.denominator.size(); ++i) {
                const double order = std::max(share * static_cast<double>(i + 1), lowest_order(i + 1));
                fractional.orders.push_back(order);
                fractional.denominator[i] = std::pow(one.denominator[i], order / static_cast<double>(i + 1));
            }
            all.push_back(std::move(fractional));
        }
    }
    return all;
}

bool fits_in(const Structure& structure, bool driven) {
    return driven || (structure.integrators == 0 && structure.zeros == 0 && !structure.fractional);
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
    alone.past_ends = true;
    alone.jobs = 1;
    if (question.split_s && question.validate.empty()) {
        for (Record& record : alone.train) {
            record = up_to(record, *question.split_s);
        }
    }
    return alone;
}

Described described(const Structure& structure, const Question& alone, Question asked) {
    const Ground part = prepare(alone);
    const Candidate of_part = fit(part.study, {}, part.base, nullptr);
    asked.form = with_values(alone.form, of_part);
    asked.from_no_input = alone.from_no_input;
    const Ground whole = prepare(asked);
    const Candidate fitted = fit(whole.study, {}, whole.base, nullptr);
    const Candidate judged = whole.same_records ? fitted : carried_over(whole.validation, fitted, nullptr);
    return {structure.name,
            structure.meaning,
            with_values(asked.form, fitted),
            gap_of(part.validation, of_part),
            gap_of(whole.validation, judged),
            structure.numbers(),
            structure.integrators,
            alone.from_no_input};
}

// As fitted to what is quick, and kept near it: whole residuals would make it slow again. Beside a drag it is the slope
// at rest, some five times as slow as at speed, and has to get there.
drive::Form quick_form(Question alone, double quick_s) {
    constexpr double about = 4.0;
    constexpr double near = 8.0;
    alone.form = held_near(alone.form, about);
    const Ground part = prepare(alone);
    Whitener differences;
    differences.coefficients = {std::exp(-part.study.scales.interval_s / quick_s)};
    differences.deviation = std::max(part.study.noise, part.study.least_deviation);
    differences.stationary_deviation = output_deviation(part.study);
    return held_near(with_values(alone.form, fit(part.study, {}, part.base, &differences)), near);
}

bool starts_in_motion(const std::vector<Record>& records) {
    return std::any_of(records.begin(), records.end(),
                       [](const Record& record) { return record.input.front() != 0.0; });
}

// From each start; none: there is nothing of this structure, and others go on.
std::vector<Described> describe(const Structure& structure, Question alone, const Question& asked) {
    std::vector<Described> found;
    const auto take = [&](const drive::Form& form) {
        alone.form = form;
        Described one = described(structure, alone, asked);
        if (std::isfinite(one.aside) && std::isfinite(one.validation)) {
            found.push_back(std::move(one));
        }
    };
    try {
        const Starts starts = starts_of(structure, alone.train);
        take(starts.whole);
        // What was put in before a log that begins in motion nobody says: over a dead time it leads a fit to one end or
        // another, and which of them goes far elsewhere is asked as of any start.
        if (starts_in_motion(alone.train)) {
            alone.from_no_input = true;
            take(starts.whole);
            alone.from_no_input = false;
        }
        for (const drive::Form& form : starts.elsewhere) {
            take(form);
        }
        if (starts.quick) {
            alone.form = *starts.quick;
            take(quick_form(alone, starts.quick_s));
        }
    } catch (const glsum::Failure&) {
    }
    return found;
}

// A start, and what it leaves.
struct Tried {
    double squares;
    Coefficients start;
};

// Of so many lags a fit has several ends: those of the starts that leave least and lie apart.
std::vector<Coefficients> apart(std::vector<Tried> tried) {
    constexpr std::size_t most = 3;
    constexpr double times_the_squares = 3.0;
    constexpr double times_the_lags = 1.5;
    std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.squares < b.squares; });
    const auto lags_s = [](const Coefficients& of) { return of.denominator.empty() ? 0.0 : of.denominator.front(); };
    std::vector<Coefficients> kept;
    for (const Tried& one : tried) {
        if (kept.size() == most || one.squares > times_the_squares * tried.front().squares) {
            break;
        }
        const bool near_one = std::any_of(kept.begin(), kept.end(), [&](const Coefficients& other) {
            const double a = lags_s(one.start) + one.start.delay_s;
            const double b = lags_s(other) + other.delay_s;
            return std::max(a, b) < times_the_lags * std::min(a, b) &&
                   std::abs(one.start.delay_s - other.delay_s) < 0.2 * std::max(a, b);
        });
        if (!near_one) {
            kept.push_back(one.start);
        }
    }
    return kept;
}

}  // namespace

drive::Form form_to_find() { return {drive::Kind::fopdt, drive::make_fopdt(1.0, 1.0, 0.0)}; }

Starts starts_of(const Structure& structure, const std::vector<Record>& records) {
    const bool driven = is_driven(records);
    const double length_s = longest_s(records);
    const double quick_s = quick_share * length_s;
    std::vector<Coefficients> starts = filtered_estimates(structure, records, driven);
    const std::vector<Coefficients> even = even_lags(structure, records.front().usual_interval_s, length_s, driven);
    starts.insert(starts.end(), even.begin(), even.end());
    if (structure.fractional) {
        starts = of_some_orders(starts);
    }
    std::vector<Part> parts;
    std::ranges::transform(records, std::back_inserter(parts), part_of);
    const std::vector<Course> courses = rough_courses(parts);
    Leftovers whole;  // of the start that leaves least, and
    Leftovers quick;  // of the one that leaves least of what is quick
    std::vector<Tried> tried;
    std::optional<drive::Form> quick_best;
    const auto rate = [&](Coefficients start) {
        start.gain = 1.0;
        const Leftovers left = leftovers_of(model_of(form_of(structure, start, driven)), courses, driven, quick_s);
        if (std::isfinite(left.whole.squares)) {
            start.gain = left.whole.gain;
            tried.push_back({left.whole.squares, start});
        }
        whole = left.whole.squares < whole.whole.squares ? left : whole;
        if (left.quick.squares < quick.quick.squares) {
            quick = left;
            start.gain = left.quick.gain;
            quick_best = form_of(structure, start, driven);
        }
    };
    std::ranges::for_each(starts, rate);
    if (driven) {
        for (const Coefficients& start : apart(tried)) {
            if (const std::optional<Coefficients> better = refined(structure, records, start)) {
                rate(*better);
            }
        }
    }
    if (tried.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: no {} ({}) explains anything of it: do input and output belong together?",
                                         records.front().name, structure.name, structure.meaning));
    }
    const bool lags_alone =
        driven && !structure.fractional && structure.integrators == 0 && structure.zeros == 0 && structure.order <= 2;
    const bool quick_apart = lags_alone && quick.quick.squares < worth_a_quick_one * whole.quick.squares;
    const bool winding = driven && (structure.order > 2 || structure.zeros > 0);
    std::vector<drive::Form> forms;
    for (const Coefficients& start : apart(std::move(tried))) {
        forms.push_back(form_of(structure, start, driven));
    }
    return {forms.front(),
            winding ? std::vector<drive::Form>(forms.begin() + 1, forms.end()) : std::vector<drive::Form>{},
            quick_apart ? quick_best : std::nullopt, quick_s};
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
    std::vector<std::vector<Described>> found(tried.size());
    const Question alone = of_training(question);
    Question asked = question;
    asked.refit = true;
    asked.past_ends = true;
    asked.jobs = 1;
    base::parallel_for(tried.size(), question.jobs,
                       [&](std::size_t i) { found[i] = describe(*tried[i], alone, asked); });
    std::vector<Described> all;
    for (std::vector<Described>& of_structure : found) {
        std::move(of_structure.begin(), of_structure.end(), std::back_inserter(all));
    }
    keep_in_order(all, longest_s(question.train), above_noise * audit(alone.train).noise / deviation_of(alone.train));
    if (all.empty()) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: no linear description explains anything of it: do input and output belong "
                        "together?",
                        question.train.front().name));
    }
    return all;
}

}  // namespace gap
