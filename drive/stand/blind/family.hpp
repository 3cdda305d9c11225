// A family of plants for cases without a model: what can be wrong with a plant of it, and how such a plant is read.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/profile.hpp"

namespace stand::blind {

/// An effect that is there, with its numbers.
struct Fault {
    std::string effect;
    Parameters parameters;
};

/// A plant that was drawn, with its sensor.
class Rig {
public:
    virtual ~Rig() = default;

    std::string plant;   ///< what it is, for the sealed file
    std::string input;   ///< column
    std::string output;  ///< column
    double tau_s = 1.0;  ///< its slowest time constant
    double full_input = 1.0;
    Clock clock;
    bool remembers = false;  ///< of fractional order: no state tells its past, so that records begin at rest

    /// Numbers of an effect of the family's lists; of an event without its place. \param one_level  as
    /// `draw_parameters`
    [[nodiscard]] virtual Parameters draw(const std::string& effect, EffectSize size, bool one_level,
                                          Chance& chance) const = 0;

    /// What the logger reads at the stamps. \param noise  added before what the sensor does to values; empty: none
    /// \throws glsum::Failure (check failed) where the plant leaves every bound.
    [[nodiscard]] virtual std::vector<double> read(std::span<const Fault> faults, const Held& held,
                                                   const std::vector<double>& noise, std::uint64_t seed) const = 0;
};

struct Family {
    const char* domain;                 ///< what the judge is told
    std::vector<std::string> listed;    ///< that no linear base takes up
    std::vector<std::string> unlisted;  ///< that no table has
    std::vector<std::string> taken_up;  ///< that a fitted linear base takes up
    std::vector<std::string> bends;     ///< listed, but a gain under one level
    std::unique_ptr<Rig> (*draw)(const std::vector<std::string>& effects, Chance& chance);
};

[[nodiscard]] const Family& mechanical_family();
[[nodiscard]] const Family& thermal_family();
[[nodiscard]] const Family& hydraulic_family();
/// These three, in this order.
[[nodiscard]] std::span<const Family* const> families();

}  // namespace stand::blind
