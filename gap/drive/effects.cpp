#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/nearest_name.hpp"
#include "gap/drive/effect.hpp"
#include "qemu/failure.hpp"

namespace gap {

#define EFFECT(name) const Effect& name();
#include "gap/drive/effects.def"
#undef EFFECT

const std::vector<const Effect*>& effects() {
    static const std::vector<const Effect*> all = {
#define EFFECT(name) &name(),
#include "gap/drive/effects.def"
#undef EFFECT
    };
    return all;
}

const Effect& effect_named(const std::string& name) {
    std::vector<std::string> known;
    for (const Effect* effect : effects()) {
        if (effect->name == name) {
            return *effect;
        }
        known.push_back(effect->name);
    }
    throw glsum::Failure(glsum::Exit::bad_input, fmt::format("no effect {}; the nearest is {}, of {}", name,
                                                             base::nearest_name(name, known), fmt::join(known, ", ")));
}

}  // namespace gap
