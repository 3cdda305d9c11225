// A line of samples under Google Benchmark's clock: what its type gives. The rest is compiled once.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "glsum/kernel.hpp"

namespace bench {

/// Samples that every line is fed with, again from the first behind the last: a power of two, so that the index needs
/// no division; long enough that no branch predictor learns the data.
inline constexpr std::size_t stream_samples = 1 << 14;

/// White noise of `stream_samples`, with peak `signal_peak`.
[[nodiscard]] const std::vector<double>& stream();

/// What a sample costs whatever the clock says. Bytes are of the buffers and the state.
struct LineSizes {
    std::size_t macs;
    std::size_t coefficient_bytes;
    std::size_t state_bytes;
};

class TimedLine {
public:
    virtual ~TimedLine() = default;
    /// The loop that is timed: feeds `count` samples of the stream from sample `from` on.
    /// \param count  at least 1
    /// \return the last output, as a real
    virtual double feed(std::size_t from, std::size_t count) = 0;
    /// Forgets all samples, where the sum does not forget them by itself.
    virtual void rest() {}
    /// How far the output may be from the exact sum of `terms` terms.
    [[nodiscard]] virtual double bound(std::size_t terms) const = 0;
    /// None of a line that sums nothing.
    [[nodiscard]] virtual std::optional<LineSizes> sizes() const { return std::nullopt; }
    /// Unless it is ok, the line cannot be fed.
    [[nodiscard]] virtual glsum::Status status() const { return glsum::Status::ok; }
};

}  // namespace bench
