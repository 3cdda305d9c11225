#include "bench/host/timed_peers.hpp"

#include <benchmark/benchmark.h>

#include "bench/host/peer_numbers.hpp"
#include "bench/host/placed.hpp"

namespace bench {
namespace {

template <class Dot>
class TimedPeer : public TimedLine {
public:
    using Sample = typename Dot::Sample;
    TimedPeer(MakeDot<Dot> make, const std::vector<reference::Real>& weights)
        : table_(weights), numbers_(table_), line_(make, coefficients(), skipped()) {
        samples_.reserve(stream().size());
        for (const double x : stream()) {
            samples_.push_back(numbers_.sample(x));
        }
    }
    double feed(std::size_t from, std::size_t count) override {
        PeerLine<Dot>& line = *line_;
        typename Dot::Sum newest{};
        const auto* samples = samples_.data();
        for (std::size_t k = from; k < from + count; ++k) {
            // A copy: GCC may lose what the statement may change, and newer benchmark libraries refuse a constant.
            const typename Dot::Sum output = line.step(samples[k % stream_samples]);
            typename Dot::Sum kept = output;
            benchmark::DoNotOptimize(kept);
            newest = output;
        }
        return numbers_.real(newest);
    }
    [[nodiscard]] double bound(std::size_t) const override { return numbers_.bound(table_); }
    [[nodiscard]] std::optional<LineSizes> sizes() const override {
        const std::size_t taps = table_.coefficients.size();
        return LineSizes{taps, taps * sizeof(Sample), 2 * taps * sizeof(Sample)};
    }

private:
    [[nodiscard]] std::vector<Sample> coefficients() const {
        std::vector<Sample> all;
        for (const double coefficient : table_.coefficients) {
            all.push_back(numbers_.coefficient(coefficient));
        }
        return all;
    }
    static std::size_t skipped() { return Places::all().next() * Placement::line_bytes / sizeof(Sample); }

    PeerTable table_;
    PeerNumbers<Dot> numbers_;
    Placed<PeerLine<Dot>> line_;
    std::vector<Sample> samples_;
};

template <class Dot>
std::unique_ptr<TimedLine> line_of(MakeDot<Dot> make, const std::vector<reference::Real>& weights) {
    return std::make_unique<TimedPeer<Dot>>(make, weights);
}

}  // namespace

std::unique_ptr<TimedLine> timed_peer(const Peer& peer, const std::vector<reference::Real>& weights) {
    return std::visit([&](auto make) { return line_of(make, weights); }, peer.make);
}

}  // namespace bench
