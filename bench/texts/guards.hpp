// What a C header of ours begins with: against being taken for another, and against arithmetic that is not IEEE's.
#pragma once

#include <string>

namespace generate {

/// Against reordered, fused and wider arithmetic: what a floating-point header begins with. It defines `<NAME>_KEEP`,
/// for single precision, which lets nobody fuse what made its argument. \param name  of the header
[[nodiscard]] std::string floating_guard(const std::string& name);

/// What a header begins with, which ends with #endif: another of this name that says something else is an error and not
/// left out in silence. \param design  on one line \param identity  its `fingerprint`
[[nodiscard]] std::string include_guard(const std::string& name, const std::string& design,
                                        const std::string& identity);

}  // namespace generate
