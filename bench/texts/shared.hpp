// Statements of the kernels, as the library compiles them, in the words of a header.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace generate {

/// C++ in the kernel's text and what a header has for it, beside the words that every text shares. Longer ones first
/// where one begins another.
using Words = std::map<std::string, std::string, std::greater<>>;

/// What stands behind "// C99: NAME" in kernels/glsum, up to the next "// C99", in C99 with places (text.hpp):
/// `Sample`, `Coefficient`, `Accumulator` and `Output` are the format's types, `Format::f` the header's @name@_f,
/// GLSUM_ its @NAME@_; `std::`, `typename`, `window.` and the argument `scale` are left out; a static_cast is a cast of
/// C. \param indent  of the first line; the others keep their distance from it \throws std::out_of_range for a name
/// that no kernel has.
[[nodiscard]] std::string shared(std::string_view name, const Words& words = {}, std::size_t indent = 4);

/// Where a text of this name stands in `kernel_sources`; npos if none does.
[[nodiscard]] std::size_t place_of(std::string_view name);

/// The files that have such a text, one behind the other; the build makes it of them.
extern const std::string_view kernel_sources;

}  // namespace generate
