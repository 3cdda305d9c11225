#include "bench/host/timed_kernels.hpp"

#include <type_traits>

#include <benchmark/benchmark.h>

#include "bench/host/placed.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

template <class K>
constexpr bool sums = !std::is_same_v<K, glsum::Null>;

template <class K>
class KernelLine : public TimedLine {
public:
    explicit KernelLine(const glsum::Design& design) : design_(design), line_(design, Places::all().placement()) {
        samples_.reserve(stream().size());
        for (const double x : stream()) {
            samples_.push_back(K::from_real(x));
        }
    }
    double feed(std::size_t from, std::size_t count) override {
        HostLine<K>& line = *line_;
        typename K::Output newest{};
        const auto* samples = samples_.data();
        for (std::size_t k = from; k < from + count; ++k) {
            // A copy: GCC may lose what the statement may change, and newer benchmark libraries refuse a constant.
            const typename K::Output output = line.step(samples[k % stream_samples]);
            typename K::Output kept = output;
            benchmark::DoNotOptimize(kept);
            newest = output;
        }
        return K::to_real(line.state(), newest);
    }
    void rest() override {
        if constexpr (sums<K>) {
            K::reset((*line_).state());
        }
    }
    [[nodiscard]] double bound(std::size_t terms) const override {
        if constexpr (sums<K>) {
            return glsum::error_bound<K>(design_, (*line_).state(), signal_peak, terms);
        } else {
            return 1e-7;  // one rounding to single precision
        }
    }
    [[nodiscard]] std::optional<LineSizes> sizes() const override {
        if constexpr (sums<K>) {
            return LineSizes{K::multiplications(design_.taps), (*line_).coefficient_bytes(), (*line_).state_bytes()};
        } else {
            return std::nullopt;
        }
    }
    [[nodiscard]] glsum::Status status() const override { return (*line_).status(); }

private:
    glsum::Design design_;
    Placed<HostLine<K>> line_;
    std::vector<typename K::Sample> samples_;
};

template <class K>
std::unique_ptr<TimedLine> make(const glsum::Design& design) {
    return std::make_unique<KernelLine<K>>(design);
}

}  // namespace

std::vector<TimedKernel> timed_kernels() {
    std::vector<TimedKernel> all;
    glsum::Registry::for_each([&]<class K>() { all.push_back({K::name(), sums<K>, make<K>}); });
    return all;
}

}  // namespace bench
