// The best gains and orders for a wish: tries all over, then NLopt from the best of them.
#pragma once

#include <cstddef>
#include <optional>

#include "drive/tune/flat_phase.hpp"
#include "drive/tune/grid.hpp"
#include "drive/tune/load_error.hpp"

namespace tune {

/// What a loop is to have.
struct Wish {
    std::optional<double> crossover;   ///< rad/s; with a margin
    std::optional<double> margin_rad;  ///< of phase, the least of all crossings
    double sensitivity;                ///< largest |S|
    bool flat = true;                  ///< a flat phase, where one can be had
};

enum class Orders { integer, fractional };

struct Found {
    drive::Gains gains;
    bool flat = false;  ///< the phase's slope at the wished crossover is 0
    double iae;         ///< of a load, as `LoadError`
    std::size_t tries;
};

/// The space of both is what the loop is at one frequency (`Target`), and the orders, from 0.2 to 1. The integer PID
/// has them fixed at 1: its grid of tries is finer, its descents are as many. A fractional answer is never worse than
/// the integer one beside which it is looked for.
class Search {
public:
    Search(const SampledPlant& plant, double filter_s, double horizon_s);

    /// Least IAE of a load within the wish. With a crossover: with a flat phase where one can be had, else without.
    /// Gains have the plant's sign, and the loop is stable. Nothing where no try is all of that.
    /// \param beside  gains to begin at, too
    [[nodiscard]] std::optional<Found> best(const Wish& wish, Orders orders,
                                            const std::optional<Found>& beside = {}) const;
    /// Whether a coarse search finds any controller for the wish. \pre it has a crossover
    [[nodiscard]] bool reachable(const Wish& wish, Orders orders) const;

private:
    struct Space;
    [[nodiscard]] std::optional<drive::Gains> gains_at(const Space& space, const double* x) const;
    [[nodiscard]] double score(const Space& space, const double* x) const;
    // What keeps gains from being an answer: 0, or how bad that is; and how far |S| is above the wish, as a part of it.
    struct Trouble {
        double size;
        double excess;
    };
    [[nodiscard]] Trouble trouble_of(const Wish& wish, const drive::Gains& gains, double w) const;
    [[nodiscard]] std::optional<Found> explore(const Space& space, const std::optional<Found>& beside) const;

    const SampledPlant& plant_;
    double filter_s_;
    Grid grid_;
    LoadError load_;
};

}  // namespace tune
