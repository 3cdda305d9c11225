// Where the data of a timing lie.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <random>
#include <utility>
#include <vector>

#include "bench/sweep/host_line.hpp"

namespace bench {

/// Where the data of a timing lie decides up to a tenth of its time (which stores and loads share the low bits of their
/// addresses, for one), and a process would keep one draw for all of its repetitions. So each repetition draws anew,
/// and what placement does shows as the repetitions' spread instead of as a difference between runs.
class Places {
public:
    /// \return cache lines, below `Placement::lines`
    std::size_t next() { return generator_() % Placement::lines; }
    Placement placement() {
        const std::size_t table = next();
        return {table, next()};
    }
    static Places& all() {
        static Places places;
        return places;
    }

private:
    std::mt19937_64 generator_{1};
};

/// An object that begins at a drawn place.
template <class T>
class Placed {
public:
    template <class... Arguments>
    explicit Placed(Arguments&&... arguments) : memory_(sizeof(T) + (Placement::lines + 1) * Placement::line_bytes) {
        void* place = memory_.data() + Places::all().next() * Placement::line_bytes;
        std::size_t space = sizeof(T) + Placement::line_bytes;
        object_ =
            new (std::align(Placement::line_bytes, sizeof(T), place, space)) T(std::forward<Arguments>(arguments)...);
    }
    Placed(const Placed&) = delete;
    Placed& operator=(const Placed&) = delete;
    ~Placed() { object_->~T(); }
    T& operator*() { return *object_; }
    const T& operator*() const { return *object_; }

private:
    std::vector<std::byte> memory_;
    T* object_;
};

}  // namespace bench
