// The best gains and orders for a wish: tries all over, then NLopt from the best of them.
#pragma once

#include <cstddef>
#include <optional>

#include "drive/tune/flat_phase.hpp"
#include "drive/tune/grid.hpp"
#include "drive/tune/load_error.hpp"
#include "drive/tune/margins.hpp"

namespace tune {

/// What a loop is to have.
struct Wish {
    std::optional<double> crossover;   ///< rad/s; with a margin
    std::optional<double> margin_rad;  ///< of phase, the least of all crossings
    double sensitivity;                ///< largest |S|
    bool flat = true;                  ///< a flat phase, where one can be had
};

/// Whether the sweep, which has the last word, finds what was wished: the margin within 0.01 rad at the crossover
/// within a thousandth, and |S| to half a thousandth.
[[nodiscard]] bool meets(const Wish& wish, const Margins& margins);

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

    struct Trouble {
        double size;    ///< 0: none; else a thousand and more, of instability more, of a sign that is wrong the most
        double excess;  ///< of |S| over the wish, as a part of it
    };
    /// What keeps gains from being an answer. An integral is needed. A little is none: descents go through it.
    /// \param w  rad/s, where gains are weighed against each other
    [[nodiscard]] Trouble trouble_of(const Wish& wish, const drive::Gains& gains, double w) const;

private:
    struct Space;
    [[nodiscard]] std::optional<drive::Gains> gains_at(const Space& space, const double* x) const;
    [[nodiscard]] double score(const Space& space, const double* x) const;
    [[nodiscard]] std::optional<Found> explore(const Space& space, const std::optional<Found>& beside) const;

    const SampledPlant& plant_;
    double filter_s_;
    Grid grid_;
    LoadError load_;
};

}  // namespace tune
