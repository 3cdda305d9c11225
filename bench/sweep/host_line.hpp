// A kernel with buffers of run-time size, on the host.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>

#include "glsum/kernel.hpp"

namespace bench {

/// Where buffers begin: so many cache lines behind the start of their memory, below `lines`.
struct Placement {
    static constexpr std::size_t line_bytes = 64;
    static constexpr std::size_t lines =
        4096 / line_bytes;  ///< a page: what stores and loads are told apart by at first
    std::size_t table = 0;
    std::size_t past = 0;
};

template <class K>
class HostLine {
public:
    /// Buffers for `design.taps`, at the start of a cache line; `status` says how `prepare` went.
    explicit HostLine(const glsum::Design& design, const Placement& placement = {})
        : taps_(design.taps),
          table_(glsum::table_needed<K>(design), placement.table),
          past_(glsum::past_needed<K>(design), placement.past) {
        status_ = K::prepare(state_, design, table_.span(), past_.span());
    }
    [[nodiscard]] glsum::Status status() const { return status_; }
    typename K::Output step(typename K::Sample sample) { return K::step(state_, sample); }
    double step_real(double sample) { return K::to_real(state_, K::step(state_, K::from_real(sample))); }
    [[nodiscard]] typename K::State& state() { return state_; }
    [[nodiscard]] const typename K::State& state() const { return state_; }

    [[nodiscard]] std::size_t coefficient_bytes() const { return table_.span().size_bytes(); }
    [[nodiscard]] std::size_t state_bytes() const { return sizeof state_ + past_.span().size_bytes(); }
    /// Taps up to the last coefficient that is not zero, a_0 included.
    [[nodiscard]] std::size_t effective_taps() const {
        std::size_t effective = 1;
        for (std::size_t j = 1; j < taps_ && j <= table_.span().size(); ++j) {
            effective = table_.span()[j - 1] != 0 ? j + 1 : effective;
        }
        return effective;
    }

private:
    template <class T>
    class Buffer {
    public:
        Buffer(std::size_t count, std::size_t lines)
            : memory_(static_cast<std::byte*>(::operator new (count * sizeof(T) + (lines + 1) * Placement::line_bytes,
                                                              std::align_val_t{Placement::line_bytes}))),
              data_(reinterpret_cast<T*>(memory_.get() + lines * Placement::line_bytes)),
              count_(count) {
            std::uninitialized_value_construct_n(data_, count);
        }
        [[nodiscard]] std::span<T> span() const { return {data_, count_}; }

    private:
        struct Release {
            void operator()(std::byte* memory) const {
                ::operator delete (memory, std::align_val_t{Placement::line_bytes});
            }
        };
        std::unique_ptr<std::byte, Release> memory_;
        T* data_;
        std::size_t count_;
    };

    std::size_t taps_;
    Buffer<typename K::Coefficient> table_;
    Buffer<typename K::Sample> past_;
    typename K::State state_{};
    glsum::Status status_ = glsum::Status::ok;
};

}  // namespace bench
