// Chance that a seed fixes. Each use draws from its own stream: one effect more or less leaves the others' draws alone.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stand {

class Chance {
public:
    Chance(std::uint64_t seed, std::uint64_t stream)
        : engine_(seed * 0x9E3779B97F4A7C15U + stream * 0xD1B54A32D192ED03U) {}
    /// Uniform on [0, 1).
    double share() { return uniform_(engine_); }
    double around(double half_width) { return half_width * (2.0 * share() - 1.0); }
    double between(double low, double high) { return low + (high - low) * share(); }
    /// Uniform in the logarithm.
    double scaled(double low, double high) { return low * std::pow(high / low, share()); }
    double normal() { return normal_(engine_); }
    std::uint64_t word() { return engine_(); }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
    bool happens(double probability) { return share() < probability; }

    /// Fisher and Yates'.
    template <class Item>
    void shuffle(std::vector<Item>& items) {
        for (std::size_t i = items.size(); i > 1; --i) {
            std::swap(items[i - 1], items[below(i)]);
        }
    }

private:
    // Boost's: its distributions, unlike the standard library's, give the same numbers everywhere.
    boost::random::mt19937_64 engine_;
    boost::random::uniform_01<double> uniform_;
    boost::random::normal_distribution<double> normal_;
};

}  // namespace stand
