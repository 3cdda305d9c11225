#include "bench/choose/derivative_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/choose/counted_order.hpp"
#include "bench/choose/kernel_run.hpp"
#include "bench/sweep/designs.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/design/rational.hpp"

namespace choose {

namespace design = glsum::design;

const char* text_of(FilterDesign by) {
    switch (by) {
        case FilterDesign::oustaloup:
            return "Oustaloup's filter, tuned to the band";
        case FilterDesign::charef:
            return "Charef's filter, tuned to the band";
        case FilterDesign::fitted:
            break;
    }
    return "a filter fitted to the derivative";
}

DerivativeErrors::DerivativeErrors(const design::DerivativeGoal& goal, FilterDesign by) : goal_(goal), by_(by) {}

std::string DerivativeErrors::why_no_rational(const Key& key) const {
    // Above order 1 the difference of samples goes before the filter of one order less.
    const auto kind = goal_.order > 1.0 ? design::FilterKind::increments : design::FilterKind::samples;
    return by_ == FilterDesign::fitted                  ? ""
           : key.modes == 0 || key.near_taps != 1       ? "a filter by rule is one tap and modes"
           : key.kind == design::FilterKind::integrator ? "a filter by rule has no running sum"
           : key.kind != kind ? "a filter by rule is of increments above order 1, and of samples below"
                              : "";
}

std::string DerivativeErrors::why_not(const std::string& kernel) {
    const glsum::CatalogueEntry& facts = bench::facts_of(kernel);
    return facts.blocks ? "its blocks' weights change from sample to sample"
           : facts.forgotten != glsum::Forgotten::zero && facts.forgotten != glsum::Forgotten::increments
               ? "the weights of its guessed tail change with the record"
               : "";
}

DerivativeErrors::Key DerivativeErrors::key_of(const std::string& kernel, std::size_t taps) const {
    const std::size_t modes = CountedOrder(goal_.order, true).length(kernel, taps, longest()).modes.value_or(0);
    const bool increments = bench::facts_of(kernel).forgotten == glsum::Forgotten::increments;
    return {
        taps - 2 * modes, modes,
        increments                                   ? design::FilterKind::increments
        : modes > 0 && bench::has_integrator(kernel) ? design::FilterKind::integrator
                                                     : design::FilterKind::samples,
        modes > 0 && bench::facts_of(kernel).floating_point ? design::Poles::one_may_swing : design::Poles::decaying,
        0.0};
}

std::optional<std::vector<std::size_t>> DerivativeErrors::lengths(const std::string& kernel) const {
    const std::size_t last = bench::has_modes(kernel) ? longest_with_modes : longest_window;
    constexpr std::size_t one_by_one = 16;
    std::vector<std::size_t> all = {1};
    while (all.back() < last) {
        const std::size_t taps = all.back();
        all.push_back(bench::has_modes(kernel) || taps < one_by_one ? taps + 1 : std::min(last, taps + taps / 8));
    }
    return all;
}

const design::FittedFilter& DerivativeErrors::filter_of(const std::string& kernel, std::size_t taps) {
    return *judged(kernel, taps).filter;
}

DerivativeErrors::Once& DerivativeErrors::entry_of(const Key& key) {
    const std::lock_guard lock(mutex_);
    auto& entry = fitted_[key];
    if (!entry) {
        entry = std::make_unique<Once>();
    }
    return *entry;
}

const design::FittedFilter& DerivativeErrors::filter_of(const Key& key) {
    Once& once = entry_of(key);
    std::call_once(once.flag, [&] {
        if (by_ != FilterDesign::fitted) {
            const auto rule =
                by_ == FilterDesign::oustaloup ? design::RationalRule::oustaloup : design::RationalRule::charef;
            once.filter =
                design::as_modes(rule, goal_, key.modes, design::tune_rational(rule, goal_, key.modes, key.poles));
            return;
        }
        Key part = key;
        if (key.poles == design::Poles::one_may_swing && design::moving_poles(key.modes, key.kind) > 0) {
            // Kernels without room for a swinging pole ask for the decaying ones.
            part.poles = design::Poles::decaying;
            const design::FittedFilter& decaying = filter_of(part);
            part.poles = design::Poles::one_swings;
            once.filter = design::better_of(decaying, filter_of(part));
        } else {
            once.filter = design::fit_filter(goal_, key.near_taps, key.modes, key.kind, key.poles, key.cost);
        }
    });
    return *once.filter;
}

std::string DerivativeErrors::group(const std::string& kernel) const {
    const Key key = key_of(kernel, longest_with_modes);
    return fmt::format("{} {}", key.modes > 0, static_cast<int>(key.kind));
}

design::DerivativeError DerivativeErrors::certified_error_of(const Key& key, const Held& held) {
    if (!held.as_fitted) {
        return design::certified_error(held.filter, goal_);
    }
    Once& once = entry_of(key);
    std::call_once(once.certified_flag, [&] { once.certified = design::certified_error(held.filter, goal_); });
    return once.certified;
}

DerivativeErrors::Judged DerivativeErrors::judge(const std::string& kernel, std::size_t taps, const Key& key) {
    Judged found;
    found.fault = why_no_rational(key);
    if (!found.fault.empty()) {
        return found;
    }
    found.filter = &filter_of(key);
    const Held held = hold(kernel, taps, goal_, *found.filter);
    found.fault = held.fault;
    if (found.fault.empty() && !(found.filter->factor > 0.0)) {
        found.fault = "its filter begins with no coefficient above 0";
    }
    if (found.fault.empty()) {
        found.error = held.added_to(certified_error_of(key, held));
        found.noise = held.band_noise;
        if (!std::isfinite(found.error.largest())) {
            found.fault = "the derivative is not a finite number";
        }
    }
    return found;
}

const DerivativeErrors::Judged& DerivativeErrors::judged(const std::string& kernel, std::size_t taps) {
    const Key key = key_of(kernel, taps);
    JudgedOnce* once = nullptr;
    {
        const std::lock_guard lock(mutex_);
        auto& entry = judged_[{kernel, taps}];
        if (!entry) {
            entry = std::make_unique<JudgedOnce>();
        }
        once = entry.get();
    }
    std::call_once(once->flag, [&] {
        once->judged = judge(kernel, taps, key);
        if (!once->judged.fault.empty() && key.poles == design::Poles::one_may_swing && by_ == FilterDesign::fitted) {
            // A cascade may have no room for the pole that swings, whose weight tends to have the other sign.
            Key decaying = key;
            decaying.poles = design::Poles::decaying;
            if (Judged other = judge(kernel, taps, decaying); other.fault.empty()) {
                once->judged = std::move(other);
            }
        }
        const bool loud = once->judged.fault.empty() && once->judged.noise > 0.5 * once->judged.error.largest();
        for (const double cost : {1e-3, 3e-3, 1e-2}) {
            if (loud && key.modes > 0 && by_ == FilterDesign::fitted) {
                Key quieter = key;
                quieter.cost = cost;
                Judged other = judge(kernel, taps, quieter);
                if (other.fault.empty() && other.error.largest() < once->judged.error.largest()) {
                    once->judged = std::move(other);
                }
            }
        }
    });
    return once->judged;
}

ErrorAt DerivativeErrors::error(const std::string& kernel, std::size_t taps) {
    ErrorAt found;
    found.fault = why_not(kernel);
    if (goal_.order <= 0.0 && bench::facts_of(kernel).forgotten == glsum::Forgotten::increments) {
        found.fault = "increments keep no level, and an integral is of one";
    }
    if (found.fault.empty()) {
        const Judged& at = judged(kernel, taps);
        found.fault = at.fault;
        if (found.fault.empty()) {
            found.error = at.error.largest();
            found.signal = worst_place(at.error);
        }
    }
    return found;
}

bool DerivativeErrors::meets(const std::string& kernel, std::size_t taps, double limit) {
    const ErrorAt at = error(kernel, taps);
    return at.fault.empty() && at.error <= limit;
}

std::string worst_place(const design::DerivativeError& error) {
    return error.band >= error.step ? fmt::format("{:.3g} Hz", error.band_hz) : fmt::format("{:.3g} s", error.step_s);
}

DerivativeReport report_on(const std::string& kernel, std::size_t taps, const design::DerivativeGoal& goal,
                           const design::FittedFilter& filter) {
    const Held held = hold(kernel, taps, goal, filter);
    return {filter, held.added_to(design::certified_error(held.filter, goal)), run(kernel, taps, goal, filter)};
}

}  // namespace choose
