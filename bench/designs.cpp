#include "bench/designs.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "glsum/registry.hpp"
#include "modes/design.hpp"

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

// The shortest design for an error; empty if there is none.
std::optional<Length> shortest(double order, std::size_t samples, double error) {
    return remembered(std::tuple(order, samples, error), [&]() -> std::optional<Length> {
        const auto found = glsum::modes::design({order, samples}, error);
        return found ? std::optional(Length{found->cost(), false, found->modes.size()}) : std::nullopt;
    });
}

}  // namespace

bool has_modes(const std::string& kernel) {
    std::optional<bool> found;
    glsum::Registry::for_each([&]<class K>() {
        if (K::name() == kernel) {
            if constexpr (requires { typename K::HistoryPart; }) {
                found = std::is_same_v<typename K::HistoryPart, glsum::Modes>;
            } else {
                found = false;
            }
        }
    });
    if (!found) {
        throw std::out_of_range("no kernel " + kernel);
    }
    return *found;
}

Length length_with_modes(double order, std::size_t taps) {
    return {taps, false, glsum::modes::modes_within(order, taps)};
}

Length length_of(const std::string& kernel, double order, std::size_t taps) {
    return has_modes(kernel) ? length_with_modes(order, taps) : Length{taps};
}

glsum::Design design_of(double order, const Length& length, std::size_t samples) {
    glsum::Design design{order, length.taps};
    if (const std::size_t modes = length.modes.value_or(0); modes > 0) {
        design.modes = remembered(std::tuple(order, samples, length.taps, modes), [&] {
            return glsum::modes::approximate({order, samples}, length.taps - 2 * modes, modes).modes;
        });
    }
    return design;
}

std::vector<Length> lengths_of(const Sweep& sweep, const std::string& kernel, double order) {
    const bool with_modes = has_modes(kernel);
    std::vector<Length> lengths;
    std::copy_if(sweep.lengths.begin(), sweep.lengths.end(), std::back_inserter(lengths),
                 [&](const Length& length) { return length.modes.has_value() == with_modes; });
    if (!with_modes) {
        return lengths;
    }
    if (!glsum::modes::has_tail(order)) {
        return {};
    }
    if (lengths.empty()) {
        for (const double error : sweep.design_errors) {
            if (const auto found = shortest(order, sweep.samples, error)) {
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
