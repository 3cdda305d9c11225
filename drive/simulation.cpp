#include "drive/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "drive/fast_memory.hpp"
#include "drive/kernel_sum.hpp"
#include "glsum/catalogue.hpp"
#include "glsum/design/merged.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/gain.hpp"
#include "glsum/registry.hpp"
#include "glsum/weights.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

// u as it acts at the samples: held, delayed, with its derivatives.
std::vector<double> forcing_of(const Model& model, const Scheme& scheme, std::span<const double> input) {
    const double steps = model.delay_s / scheme.step_s;
    const auto delay = static_cast<std::size_t>(std::ceil(steps - 1e-9));
    const std::size_t shift = delay + (scheme.forcing == Forcing::held ? 1 : 0);
    const std::size_t count = input.size();
    std::vector<double> acting(count, 0.0);
    for (std::size_t k = shift; k < count; ++k) {
        acting[k] = model.gain * input[k - shift];
    }
    if (model.numerator == std::vector<Term>{{1.0, 0.0}}) {
        return acting;
    }
    const std::vector<double> weights =
        merged_weights(model.numerator, scheme.step_s, std::min(count, scheme.taps.value_or(count)));
    std::vector<double> padded(count, 0.0);
    std::copy(weights.begin(), weights.end(), padded.begin());
    FastMemory memory(padded);
    std::vector<double> forcing(count);
    for (std::size_t k = 0; k < count; ++k) {
        forcing[k] = padded[0] * acting[k] + memory.past();
        memory.push(acting[k]);
    }
    return forcing;
}

// One merged table in double.
std::vector<double> step_merged(const Model& model, const Scheme& scheme, const std::vector<double>& forcing) {
    const std::size_t count = forcing.size();
    const std::size_t taps = std::min(count, scheme.taps.value_or(count));
    std::vector<double> weights = merged_weights(model.denominator, scheme.step_s, taps, scheme.increments);
    const double constant = constant_coefficient(model.denominator);
    const double newest = weights[0] + (scheme.increments ? constant : 0.0);
    weights.resize(count, 0.0);
    std::vector<double> output(count, 0.0);
    if (taps <= 1024) {
        std::vector<double> stored(count, 0.0);
        for (std::size_t k = 1; k < count; ++k) {
            double past = 0.0;
            for (std::size_t j = std::min(k, taps - 1); j > 0; --j) {
                past += weights[j] * stored[k - j];
            }
            const double before = scheme.increments ? output[k - 1] : 0.0;
            stored[k] = (forcing[k] - past - (scheme.increments ? constant * before : 0.0)) / newest;
            output[k] = before + stored[k];
        }
        return output;
    }
    FastMemory memory(weights);
    memory.push(0.0);
    for (std::size_t k = 1; k < count; ++k) {
        const double before = scheme.increments ? output[k - 1] : 0.0;
        const double stored = (forcing[k] - memory.past() - (scheme.increments ? constant * before : 0.0)) / newest;
        memory.push(stored);
        output[k] = before + stored;
    }
    return output;
}

std::vector<glsum::design::Term> derivatives_of(const std::vector<Term>& terms) {
    std::vector<glsum::design::Term> derivatives;
    for (const Term& term : terms) {
        if (term.order != 0.0 && term.coefficient != 0.0) {
            derivatives.push_back({term.coefficient, term.order});
        }
    }
    return derivatives;
}

// A kernel of the registry, by what a scheme asks of it.
struct SchemeKernel {
    std::string_view name;
    bool single;  // sums are floats
    bool fixed_point;
    bool keeps_increments;
    bool keeps_modes;
    bool has_integrator;
    std::unique_ptr<PastSum> (*sum)(const glsum::Design& design);
    [[nodiscard]] bool is_modes_alone() const { return keeps_modes && !keeps_increments && !has_integrator; }
};

template <class K>
SchemeKernel scheme_kernel() {
    using History = typename K::HistoryPart;
    return {
        K::name(),
        std::is_same_v<typename K::Output, float>,
        !std::is_floating_point_v<typename K::Sample>,
        glsum::keeps_increments<History>,
        glsum::keeps_modes<History>,
        glsum::has_integrator<History>,
        [](const glsum::Design& design) -> std::unique_ptr<PastSum> { return std::make_unique<KernelSum<K>>(design); }};
}

// One sum of the kernel for each order, or one for all; what surrounds them in `Real`.
template <class Real>
Simulated step_kernel(const SchemeKernel& kernel, const Model& model, const Scheme& scheme,
                      const std::vector<double>& forcing) {
    const std::size_t count = forcing.size();
    const std::size_t taps = std::min(count, scheme.taps.value_or(count));
    Simulated simulated;
    double scale = 1.0;
    if (kernel.fixed_point) {
        scale = scheme.full_scale;
        if (scale == 0.0) {
            double peak = 0.0;
            for (const double value : forcing) {
                peak = std::max(peak, std::fabs(value));
            }
            const double steady = std::fabs(constant_coefficient(model.denominator));
            scale = std::exp2(std::ceil(std::log2(2.0 * peak / (steady == 0.0 ? 1.0 : steady))));
        }
        simulated.full_scale = scale;
    }
    std::vector<std::unique_ptr<PastSum>> sums;
    std::vector<Real> factors;
    const auto add_sum = [&](const glsum::Design& design, double factor) {
        sums.push_back(kernel.sum(design));
        if (const glsum::Status status = sums.back()->status(); status != glsum::Status::ok) {
            refuse(fmt::format("{}: no sum of order {} over {} taps: {}", kernel.name, design.order, taps,
                               status == glsum::Status::order_out_of_range
                                   ? (kernel.keeps_increments ? "over increments kernels take orders in (-1, 2]"
                                                              : "kernels take orders in (-2, 2]")
                               : status == glsum::Status::weights_out_of_range
                                   ? "it cannot take the weights of a merged table"
                                   : "its coefficients do not fit the format"));
        }
        factors.push_back(static_cast<Real>(factor));
    };
    // With modes a length of taps is parted as a design of so many has them.
    const bool with_modes = kernel.is_modes_alone();
    if (kernel.has_integrator) {
        refuse(fmt::format(
            "{}: expected a kernel modes_...: an integrator is for integrals, and a plant's orders are above 0",
            kernel.name));
    }
    if (kernel.keeps_increments && kernel.keeps_modes) {
        refuse(fmt::format("{}: expected increments and a kernel modes_..., which is the same sum", kernel.name));
    }
    if (with_modes && !scheme.taps) {
        refuse(fmt::format("{}: expected a number of taps: with modes all of a record is remembered by a few",
                           kernel.name));
    }
    const auto constant = static_cast<Real>(constant_coefficient(model.denominator));
    Real newest = 0;
    if (scheme.merged) {
        std::size_t near_taps = taps;
        std::vector<glsum::Mode> modes;
        if (with_modes) {
            // The parting of an order in (0, 1), as increments leave them; the table has one tap more than that needs.
            const std::size_t wanted = glsum::design::modes_within(0.5, taps - std::min<std::size_t>(taps, 1));
            near_taps = taps - 2 * wanted;
            if (!scheme.increments || near_taps < 2) {
                refuse(
                    fmt::format("{}: expected increments and at least 2 taps: the modes of a merged table are theirs",
                                kernel.name));
            }
            modes = glsum::design::approximate_merged(derivatives_of(model.denominator), scheme.step_s,
                                                      glsum::design::Discretisation::grunwald_letnikov,
                                                      std::max(count, near_taps), near_taps, wanted)
                        .modes;
        }
        std::vector<double> weights = merged_weights(model.denominator, scheme.step_s, near_taps, scheme.increments);
        const double whole = weights[0] + (scheme.increments ? constant_coefficient(model.denominator) : 0.0);
        newest = static_cast<Real>(whole);
        double factor = 1.0;
        if (kernel.fixed_point) {
            factor = whole;  // fractions
            for (double& weight : weights) {
                weight /= whole;
            }
            for (glsum::Mode& mode : modes) {
                mode.weight /= whole;
            }
        }
        add_sum({0.0, near_taps + 2 * modes.size(), modes, std::span(weights).subspan(1)}, factor);
    } else {
        for (const Term& term : model.denominator) {
            const double factor = term.coefficient * glsum::step_factor(term.order, scheme.step_s);
            newest += static_cast<Real>(factor);
            if (term.order == 0.0 || term.coefficient == 0.0) {
                continue;
            }
            glsum::Design design{term.order - (scheme.increments ? 1.0 : 0.0), taps};
            std::vector<glsum::Mode> modes;
            if (with_modes && glsum::design::has_tail(design.order)) {
                const std::size_t wanted = glsum::design::modes_within(design.order, taps);
                modes = glsum::design::approximate({design.order, count}, taps - 2 * wanted, wanted).modes;
                design.taps = taps - 2 * (wanted - modes.size());
                design.modes = modes;
            }
            add_sum(design, factor);
        }
    }
    Real before = 0;
    for (std::size_t k = 0; k < count; ++k) {
        Real rest = static_cast<Real>(forcing[k]);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            rest -= factors[i] * static_cast<Real>(sums[i]->past() * scale);
        }
        Real stored = 0;
        if (scheme.increments) {
            stored = k == 0 ? Real(0) : (rest - constant * before) / newest;
            before += stored;
        } else {
            stored = k == 0 ? Real(0) : rest / newest;
            before = stored;
        }
        for (const auto& sum : sums) {
            sum->push(static_cast<double>(stored) / scale);
        }
        simulated.output.push_back(before);
    }
    for (const auto& sum : sums) {
        simulated.saturations += sum->saturations();
    }
    return simulated;
}

}  // namespace

std::vector<double> merged_weights(const std::vector<Term>& terms, double step_s, std::size_t count, bool increments) {
    std::vector<double> merged(std::max<std::size_t>(count, 1), 0.0);
    for (const Term& term : terms) {
        if (increments && term.order == 0.0) {
            continue;
        }
        const double factor = term.coefficient * glsum::step_factor(term.order, step_s);
        glsum::Weights weights(term.order - (increments ? 1.0 : 0.0));
        merged[0] += factor;
        for (std::size_t j = 1; j < merged.size(); ++j) {
            weights.next();
            merged[j] += factor * weights.weight();
        }
    }
    return merged;
}

bool delay_fits(const Model& model, double step_s) {
    const double steps = model.delay_s / step_s;
    return std::fabs(steps - std::round(steps)) < 1e-9 * std::max(1.0, steps);
}

Simulated simulate(const Model& model, const Scheme& scheme, std::span<const double> input) {
    if (!(scheme.step_s > 0.0 && std::isfinite(scheme.step_s))) {
        refuse(fmt::format("expected a step above 0 s, found {}", scheme.step_s));
    }
    if (scheme.taps && *scheme.taps == 0) {
        refuse("expected at least 1 tap, found 0");
    }
    const std::vector<double> forcing = forcing_of(model, scheme, input);
    if (scheme.kernel.empty()) {
        return {step_merged(model, scheme, forcing), 0, 0.0};
    }
    std::optional<Simulated> simulated;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {
            if (K::name() == scheme.kernel) {
                const SchemeKernel kernel = scheme_kernel<K>();
                simulated = kernel.single ? step_kernel<float>(kernel, model, scheme, forcing)
                                          : step_kernel<double>(kernel, model, scheme, forcing);
            }
        }
    });
    if (!simulated) {
        refuse(fmt::format("no kernel is called {}; the nearest is {}", scheme.kernel,
                           base::nearest_name(scheme.kernel, glsum::catalogue, &glsum::CatalogueEntry::name)));
    }
    return *simulated;
}

std::vector<double> make_input(const Excitation& excitation, double step_s, double until_s) {
    if (!(step_s > 0.0 && until_s >= step_s && until_s / step_s <= 1e7)) {
        refuse(
            fmt::format("expected a record of 2 to 10^7 samples, found one of {} s in steps of {} s", until_s, step_s));
    }
    const auto count = static_cast<std::size_t>(std::floor(until_s / step_s + 1e-9)) + 1;
    std::vector<double> input(count, excitation.amplitude);
    if (excitation.name == "step") {
        return input;
    }
    if (excitation.name == "pulse") {
        for (std::size_t k = 0; k < count; ++k) {
            input[k] = static_cast<double>(k) * step_s < excitation.off_s - 1e-9 * step_s ? excitation.amplitude : 0.0;
        }
        return input;
    }
    if (excitation.name == "staircase") {
        const std::size_t levels = 2 * std::max<std::size_t>(excitation.stairs, 1);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t level = levels * k / count + 1;
            input[k] = excitation.amplitude * static_cast<double>(std::min(level, levels - level)) /
                       static_cast<double>(levels / 2);
        }
        return input;
    }
    refuse(fmt::format("expected the input step, pulse or staircase, found {}", excitation.name));
}

Log make_log(const Excitation& excitation, double step_s, double until_s) {
    Log log;
    log.name = excitation.name;
    log.input = make_input(excitation, step_s, until_s);
    for (std::size_t k = 0; k < log.input.size(); ++k) {
        log.time_s.push_back(static_cast<double>(k) * step_s);
    }
    return log;
}

}  // namespace drive
