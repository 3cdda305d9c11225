// What a parser may do with bytes from anywhere: take them, or refuse them in its own words. All else ends the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/failure.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// Runs `use` and swallows a refusal. Any other exception passes, and is a finding.
template <class Use>
void refused_or(Use use) {
    try {
        use();
    } catch (const glsum::Failure& failure) {
        if (*failure.what() == '\0') {
            std::abort();
        }
    }
}

inline void expect(bool holds) {
    if (!holds) {
        std::abort();
    }
}

inline std::string to_text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace fuzz
