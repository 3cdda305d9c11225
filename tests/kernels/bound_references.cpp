#include "tests/kernels/bound_references.hpp"

#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string>

#include "bench/sweep/signals.hpp"
#include "glsum/design/bdf.hpp"
#include "reference/bdf.hpp"

namespace test {
namespace {

using reference::Dropped;
using reference::Exact;
using reference::Real;
using reference::Sums;

// Exact sums one behind the other: computed and written, or read in the same order.
class Store {
public:
    Store(const std::filesystem::path& path, bool writes)
        : path_(path),
          writes_(writes),
          file_(path, std::ios::binary | (writes ? std::ios::out | std::ios::trunc : std::ios::in)) {}

    template <class Compute>
    Sums sums(std::size_t samples, Compute compute) {
        Sums sums = writes_ ? compute() : Sums(samples, Exact(Real(0)));
        for (Exact& exact : sums) {
            double words[] = {exact.high, exact.low};
            writes_ ? void(file_.write(reinterpret_cast<const char*>(words), sizeof words))
                    : void(file_.read(reinterpret_cast<char*>(words), sizeof words));
            exact.high = words[0];
            exact.low = words[1];
        }
        check();
        return sums;
    }

    // Nothing may be left over.
    void end() {
        writes_ ? void(file_.flush()) : void(file_.peek());
        if (writes_ ? !file_ : !file_.eof()) {
            fail();
        }
    }

private:
    void check() {
        if (!file_) {
            fail();
        }
    }
    [[noreturn]] void fail() { throw std::runtime_error(path_.string() + ": expected the exact sums of this build"); }

    std::filesystem::path path_;
    bool writes_;
    std::fstream file_;
};

std::vector<BoundReference> bound_references(const std::filesystem::path& folder, Dropped dropped, bool writes) {
    Store store(folder / ("bound-" + std::to_string(static_cast<int>(dropped))), writes);
    std::vector<BoundReference> made;
    constexpr std::size_t samples = 400;
    constexpr std::size_t lengths[] = {1, 7, 50, 150, samples};
    for (const double order : {0.2, 0.5, 0.9, 0.98319, 1.0, 1.5, 1.9909, 2.0, -0.5, -1.5}) {
        for (const std::string_view signal : bench::signal_names) {
            const auto record = bench::make_signal(signal, samples, 1);
            for (const std::size_t taps : lengths) {
                made.push_back({order, taps, record, store.sums(samples, [&] {
                                    return reference::sums_of(dropped, {order, taps}, record);
                                })});
            }
        }
    }
    store.end();
    return made;
}

std::vector<HigherOrderReference> higher_order_references(const std::filesystem::path& folder, bool increments,
                                                          bool writes) {
    Store store(folder / (increments ? "higher-increments" : "higher"), writes);
    std::vector<HigherOrderReference> made;
    constexpr std::size_t samples = 300;
    for (unsigned steps = 2; steps <= 4; ++steps) {
        for (const double order : {0.2, 0.5, 0.98319, 1.5, 1.9909, -0.5}) {
            auto named = increments ? glsum::design::bdf_increment_weights(steps, order, samples)
                                    : glsum::design::bdf_weights(steps, order, samples);
            named.erase(named.begin());
            const auto weights = writes ? reference::bdf_weights(steps, Real(order), samples) : std::vector<Real>();
            for (const std::size_t taps : {7U, 50U, 150U}) {
                for (const std::string_view signal : {"step", "sine50", "noise"}) {
                    const auto record = bench::make_signal(signal, samples, 1);
                    made.push_back({steps, order, taps, named, record, store.sums(samples, [&] {
                                        // Of increments the differences of the weights' sums, which end with the taps.
                                        std::vector<Real> near(weights.begin(),
                                                               weights.begin() + static_cast<std::ptrdiff_t>(taps));
                                        if (increments) {
                                            near.push_back(-std::accumulate(near.begin(), near.end(), Real(0)));
                                        }
                                        const std::size_t reach[] = {near.size()};
                                        return reference::sums(near, record, reach).front();
                                    })});
                }
            }
        }
    }
    store.end();
    return made;
}

}  // namespace

std::vector<BoundReference> read_bound_references(const std::filesystem::path& folder, Dropped dropped) {
    return bound_references(folder, dropped, false);
}

std::vector<HigherOrderReference> read_higher_order_references(const std::filesystem::path& folder, bool increments) {
    return higher_order_references(folder, increments, false);
}

void write_bound_references(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const Dropped dropped : {Dropped::zero, Dropped::increments, Dropped::held, Dropped::line}) {
        (void)bound_references(folder, dropped, true);
    }
    for (const bool increments : {false, true}) {
        (void)higher_order_references(folder, increments, true);
    }
}

}  // namespace test
