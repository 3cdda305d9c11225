#include "bench/target/count_path.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/sweep/designs.hpp"
#include "glsum/catalogue.hpp"

namespace bench {
namespace {

// visit.operator()<K>() of the kernel with this name.
template <class Visit>
auto of_kernel(const std::string& name, Visit visit) {
    std::optional<decltype(visit.template operator()<glsum::Null>())> result;
    glsum::Registry::for_each([&]<class K>() {
        if (K::name() == name) {
            result = visit.template operator()<K>();
        }
    });
    if (!result) {
        throw std::out_of_range("no kernel " + name);
    }
    return *result;
}

template <class K>
concept has_scale = requires(typename K::State state) {
    state.scale.table_exponent;
    state.scale.output_exponent;
};

}  // namespace

CountPath count_path(const std::string& kernel, const glsum::Design& design) {
    return of_kernel(kernel, [&]<class K>() {
        std::vector<typename K::Coefficient> table(glsum::table_needed<K>(design));
        std::vector<typename K::Sample> past(glsum::past_needed<K>(design));
        typename K::State state{};
        CountPath path{.status = K::prepare(state, design, table, past), .modes = design.modes.size(), .blocks = {}};
        if constexpr (has_scale<K>) {
            path.table_exponent = state.scale.table_exponent;
            path.output_exponent = state.scale.output_exponent;
        }
        if constexpr (requires { state.per_level; }) {
            path.blocks = {design.blocks.count, design.blocks.per_level};
        }
        return path;
    });
}

bool double_in_software(const std::string& kernel) { return facts_of(kernel).in_double; }

}  // namespace bench
