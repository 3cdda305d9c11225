#include "bench/sweep/designs.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "glsum/catalogue.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/fitted.hpp"
#include "glsum/design/integral.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/logmemory/nested.hpp"

namespace bench {
namespace {

// What `make` gives for the key, made once; the result stays where it is.
template <class Key, class Make>
const auto& remembered(const Key& key, Make make) {
    static std::mutex mutex;
    static std::map<Key, std::invoke_result_t<Make>> known;
    const std::lock_guard lock(mutex);
    const auto found = known.find(key);
    return found != known.end() ? found->second : known.emplace(key, make()).first->second;
}

// Which weights, as a kernel sums them.
struct Named {
    Discretisation weights;
    double order;        // v
    bool of_increments;  // then they are of order v - 1
    bool integrates;     // the slowest mode does not decay
    [[nodiscard]] double of_weights() const { return of_increments ? order - 1.0 : order; }
    // a_0 ... a_last.
    [[nodiscard]] std::vector<double> to(std::size_t last) const {
        if (!names_weights(weights)) {
            return glsum::design::weights_to(of_weights(), last);
        }
        std::vector<double> all = named_weights(weights, order, of_increments, last);
        all.insert(all.begin(), 1.0);
        return all;
    }
    auto operator<=>(const Named&) const = default;
};

// An order's own weights are those of v - 1 over increments: the same whoever sums them.
Named named_of(const std::string& kernel, double order, Discretisation weights) {
    const double of_weights = order_of_weights(kernel, order);
    const bool integrates = bench::has_integrator(kernel);
    return names_weights(weights) ? Named{weights, order, of_weights != order, integrates}
                                  : Named{Discretisation::gl, of_weights, false, integrates};
}

glsum::design::Approximation approximation_of(const Named& named, std::size_t samples, std::size_t near_taps,
                                              std::size_t modes) {
    namespace design = glsum::design;
    return named.integrates ? design::approximate_integral(named.to(samples), named.of_weights(), near_taps, modes)
           : names_weights(named.weights)
               ? design::approximate_fitted(named.to(samples), named.of_weights(), near_taps, modes)
               : design::approximate({named.of_weights(), samples}, near_taps, modes);
}

// The shortest design for an error; empty if there is none.
std::optional<Length> shortest(const Named& named, std::size_t samples, double error) {
    return remembered(std::tuple(named, samples, error), [&]() -> std::optional<Length> {
        const auto found =
            named.integrates ? glsum::design::design_integral(named.to(samples), named.of_weights(), error)
            : names_weights(named.weights) ? glsum::design::design_fitted(named.to(samples), named.of_weights(), error)
                                           : glsum::design::design_modes({named.of_weights(), samples}, error);
        return found ? std::optional(Length{found->length(), false, found->modes.size()}) : std::nullopt;
    });
}

}  // namespace

const glsum::CatalogueEntry& facts_of(const std::string& kernel) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    if (entry == nullptr) {
        throw std::out_of_range("no kernel " + kernel);
    }
    return *entry;
}

bool has_modes(const std::string& kernel) { return facts_of(kernel).modes; }

bool has_integrator(const std::string& kernel) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    return entry != nullptr && entry->integrator;
}

bool has_blocks(const std::string& kernel) { return facts_of(kernel).blocks; }

double order_of_weights(const std::string& kernel, double order) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    return entry != nullptr && entry->forgotten == glsum::Forgotten::increments ? order - 1.0 : order;
}

bool serves(const std::string& kernel, double order) {
    const glsum::CatalogueEntry& entry = facts_of(kernel);
    return entry.takes_order(order) && (!entry.integrator || glsum::design::is_integral(order));
}

bool truncates(const std::string& kernel) {
    return facts_of(kernel).forgotten == glsum::Forgotten::zero && !has_modes(kernel) && !has_blocks(kernel);
}

Length length_with_modes(const std::string& kernel, double order, std::size_t taps) {
    return {taps, false,
            has_integrator(kernel) ? glsum::design::integral_modes_within(order, taps)
                                   : glsum::design::modes_within(order, taps)};
}

Length length_with_blocks(double order, std::size_t taps, std::size_t samples) {
    const glsum::Blocks blocks = remembered(std::tuple(order, taps, samples), [&] {
        return glsum::design::design_blocks({order, samples}, taps).blocks;
    });
    return {taps, false, {}, blocks};
}

Length length_of(const std::string& kernel, double order, std::size_t taps, std::size_t samples) {
    return has_blocks(kernel)  ? length_with_blocks(order_of_weights(kernel, order), taps, samples)
           : has_modes(kernel) ? length_with_modes(kernel, order_of_weights(kernel, order), taps)
                               : Length{taps};
}

Length as_counted(const std::string& kernel, const Length& read) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    const bool blocks = entry != nullptr && entry->blocks;
    return blocks && read.modes ? Length{read.taps - *read.modes, false, {}, glsum::Blocks{*read.modes, 1}} : read;
}

glsum::Design design_of(const std::string& kernel, double order, const Length& length, std::size_t samples,
                        Discretisation weights) {
    glsum::Design design{order, length.taps};
    design.blocks = length.blocks.value_or(glsum::Blocks{});
    const Named named = named_of(kernel, order, weights);
    if (const std::size_t modes = length.modes.value_or(0); modes > 0) {
        const std::size_t near_taps = length.taps - 2 * modes;
        design.modes = remembered(std::tuple(named, samples, length.taps, modes),
                                  [&] { return approximation_of(named, samples, near_taps, modes).modes; });
    }
    if (names_weights(weights)) {
        const std::size_t count = glsum::reach_of(design) - 1;
        design.weights = remembered(std::tuple(named, count),
                                    [&] { return named_weights(weights, order, named.of_increments, count); });
    }
    return design;
}

double design_error(const std::string& kernel, double order, const glsum::Design& design, std::size_t samples) {
    if (!design.modes.empty()) {
        const double of_weights = order_of_weights(kernel, order);
        const double largest = of_weights != order ? 2.0 : 1.0;  // of what is kept
        return largest * glsum::design::error_of(
                             glsum::design::weights_to(of_weights, samples), design.taps - 2 * design.modes.size(),
                             {design.modes.begin(), design.modes.end()}, std::numeric_limits<double>::infinity());
    }
    return has_blocks(kernel) ? glsum::design::design_blocks({order, samples}, design.taps).error : 0.0;
}

std::string named(const Length& length, const glsum::Design& design) {
    const bool integrates = !design.modes.empty() && design.modes.front().decay == 0.0;
    return (length.blocks ? "blocks " : integrates ? "integrator " : "") + length.text();
}

std::vector<Length> lengths_of(const Sweep& sweep, const std::string& kernel, double order) {
    if (!serves(kernel, order) || !why_not_served(kernel, sweep.weights).empty()) {
        return {};
    }
    const bool with_modes = has_modes(kernel);
    std::vector<Length> lengths;
    if (has_blocks(kernel)) {
        for (const Length& length : sweep.lengths) {
            if (length.window() && !length.full) {
                lengths.push_back(length_of(kernel, order, length.taps, sweep.samples));
            }
        }
        return lengths;
    }
    std::copy_if(sweep.lengths.begin(), sweep.lengths.end(), std::back_inserter(lengths),
                 [&](const Length& length) { return length.modes.has_value() == with_modes; });
    if (!with_modes) {
        return lengths;
    }
    const double of_weights = order_of_weights(kernel, order);
    if (!has_integrator(kernel) && !glsum::design::has_tail(of_weights)) {
        return {};
    }
    if (lengths.empty()) {
        for (const double error : sweep.design_errors) {
            if (const auto found = shortest(named_of(kernel, order, sweep.weights), sweep.samples, error)) {
                lengths.push_back(*found);
            }
        }
    }
    const auto key = [](const Length& length) { return std::tuple(length.taps, length.modes); };
    std::sort(lengths.begin(), lengths.end(), [&](const Length& a, const Length& b) { return key(a) < key(b); });
    lengths.erase(
        std::unique(lengths.begin(), lengths.end(), [&](const Length& a, const Length& b) { return key(a) == key(b); }),
        lengths.end());
    return lengths;
}

}  // namespace bench
