// From a kernel's name to its type.
#pragma once

#include <stdexcept>
#include <string>

#include "glsum/registry.hpp"

namespace bench {

/// Calls `use.operator()<K>()` for the kernel of this name. \throws std::out_of_range where there is none
template <class Use>
void with_kernel(const std::string& name, Use&& use) {
    if (!glsum::Registry::with(name, use)) {
        throw std::out_of_range("no kernel " + name);
    }
}

}  // namespace bench
