// The fields of a run's context that belong to one emulated machine.
#pragma once

#include <string>
#include <string_view>

#include "base/machines.hpp"
#include "bench/rows/row.hpp"

namespace bench {

/// How a context names a field of a machine: plainly that of the first of the run, those of the others behind their
/// word.
[[nodiscard]] inline std::string target_field(std::string_view field, const base::Machine& machine, bool first) {
    return (first ? std::string() : std::string(machine.word) + '_') + std::string(field);
}

/// The name under which a context has a field of a machine that it has rows of.
[[nodiscard]] inline std::string target_field_in(const Json& context, std::string_view field,
                                                 const base::Machine& machine) {
    const std::string own = target_field(field, machine, false);
    return target_field(field, machine, !context.contains(own));
}

}  // namespace bench
