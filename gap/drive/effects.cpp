#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"
#include "gap/drive/effect.hpp"

namespace gap {

#define EFFECT(name) const Effect& name();
#include "gap/drive/effects.def"
#undef EFFECT

const std::set<Domain>& all_domains() {
    static const std::set<Domain> all = {Domain::mechanical, Domain::thermal, Domain::hydraulic, Domain::electric};
    return all;
}

const char* name_of(Place place) {
    switch (place) {
        case Place::command:
            return "command";
        case Place::actuator:
            return "actuator";
        case Place::plant:
            return "plant";
        case Place::output:
            return "output";
        case Place::sensor:
            return "sensor";
        case Place::logger:
            return "logger";
        case Place::deployed:
            return "deployed";
    }
    return "plant";
}

const char* name_of(Domain domain) {
    switch (domain) {
        case Domain::mechanical:
            return "mechanical";
        case Domain::thermal:
            return "thermal";
        case Domain::hydraulic:
            return "hydraulic";
        case Domain::electric:
            return "electric";
    }
    return "mechanical";
}

Domain domain_named(const std::string& name) {
    std::vector<std::string> known;
    for (const Domain domain : all_domains()) {
        if (name == name_of(domain)) {
            return domain;
        }
        known.emplace_back(name_of(domain));
    }
    throw glsum::Failure(glsum::Exit::bad_input,
                         fmt::format("expected one of the domains {}, found {}", fmt::join(known, ", "), name));
}

bool Effect::covers(const Effect& other) const {
    return std::find(generalises.begin(), generalises.end(), other.name) != generalises.end();
}

bool Effect::resembles(const Effect& other) const {
    const auto says = [](const Effect& one, const Effect& like) {
        return std::ranges::find(one.looks_like, like.name) != one.looks_like.end();
    };
    return says(*this, other) || says(other, *this);
}

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
