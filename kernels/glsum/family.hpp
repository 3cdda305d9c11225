// What a history says of itself to those that have only its kernel's name: the family that it belongs to, and what it
// takes for the samples that it does not keep. Each says it in its own header; the catalogue collects it. To a
// generated header a history says by `constants(design, state, says)` which numbers of these are constants there:
// says(name, number); by `text` which file NAME.h.in has its statements, where that is not its word; and by `kept`
// which history it wraps, whose statements it has beside its own.
#pragma once

#include <string_view>

namespace glsum {

/// Histories that keep the past in one way: a folder of this library.
struct Family {
    std::string_view word;   ///< the folder's name; empty for `null`, which keeps nothing
    std::string_view keeps;  ///< what it keeps, as `glsum list kernels` says it
    bool operator==(const Family&) const = default;
};

/// What a kernel takes for the samples that it keeps neither as such nor in its averages or blocks.
enum class Forgotten {
    zero,        ///< 0
    increments,  ///< 0 for their increments: as if they had been constant
    held,        ///< the oldest sample kept
    line,        ///< the line from that to the record's first
};

/// What a history says by its `forgotten`, or 0.
template <class History>
[[nodiscard]] constexpr Forgotten forgotten_by() {
    if constexpr (requires { History::forgotten; }) {
        return History::forgotten;
    } else {
        return Forgotten::zero;
    }
}

}  // namespace glsum
