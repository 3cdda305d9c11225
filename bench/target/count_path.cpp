#include "bench/target/count_path.hpp"

#include <vector>

#include "bench/sweep/designs.hpp"
#include "bench/sweep/with_kernel.hpp"
#include "glsum/catalogue.hpp"

namespace bench {
namespace {

template <class K>
concept has_scale = requires(typename K::State state) {
    state.scale.table_exponent;
    state.scale.output_exponent;
};

}  // namespace

CountPath count_path(const std::string& kernel, const glsum::Design& design) {
    CountPath path;
    with_kernel(kernel, [&]<class K>() {
        std::vector<typename K::Coefficient> table(glsum::table_needed<K>(design));
        std::vector<typename K::Sample> past(glsum::past_needed<K>(design));
        typename K::State state{};
        path.status = K::prepare(state, design, table, past);
        path.modes = design.modes.size();
        if constexpr (has_scale<K>) {
            path.table_exponent = state.scale.table_exponent;
            path.output_exponent = state.scale.output_exponent;
        }
        if constexpr (requires { state.per_level; }) {
            path.blocks = {design.blocks.count, design.blocks.per_level};
        }
    });
    return path;
}

bool double_in_software(const std::string& kernel) { return facts_of(kernel).in_double; }

}  // namespace bench
