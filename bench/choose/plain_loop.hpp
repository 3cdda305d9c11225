// What a plain loop over every kernel and every length chooses, and the budgets on which a search is held against it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "bench/choose/candidate.hpp"

namespace choose {

/// Everything about one kernel at one length.
struct Entry {
    std::string kernel;
    std::size_t taps;
    std::vector<double> errors;  ///< of each signal; infinite where there is no answer
    Cost cost;
};

struct Budget {
    std::vector<std::size_t> signals;  ///< by index
    Limits limits;
};

/// Of the budget's signals the worst.
[[nodiscard]] double error_of(const Entry& entry, const Budget& budget);

/// \param nearest  if nothing fits, the least factor by which one limit must be relaxed; infinite if no one limit is
/// enough
/// \return the cheapest entry that fits, of these the smallest, of these the most accurate; null if nothing fits
[[nodiscard]] const Entry* best_of(const std::vector<Entry>& entries, const Budget& budget, double& nearest);

/// Budgets at random, of one seed always the same: limits near those of a random entry, so that some can be met and
/// some cannot.
class Budgets {
public:
    explicit Budgets(std::uint64_t seed) : generator_(seed) {}
    /// One of three is for one signal, the others for all. Each limit is the entry's own value times a random factor:
    /// the error's 0.7 to 3; of every other budget the cost's, and so the bytes', 0.6 to 2. Of an entry without an
    /// error, or of none, the limit is 1e-6 to 1.
    [[nodiscard]] Budget next(const std::vector<Entry>& entries, std::size_t signals);

private:
    double unit();
    std::size_t below(std::size_t count);
    double between(double low, double high);

    std::mt19937_64 generator_;
};

}  // namespace choose
