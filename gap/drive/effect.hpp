// An effect that a simulation may lack: what it does to a scenario, with which parameters.
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "gap/drive/contract.hpp"
#include "gap/drive/scenario.hpp"

namespace gap {

class Course;

/// How large things are in the training records, for bounds and starts, and what their audit found.
struct Scales {
    double input_max;   ///< of |u|; 1 where the input is 0 throughout
    double output_low;  ///< of the readings
    double output_high;
    double output_span;
    double speed_max;  ///< of |dz/dt|
    double force;      ///< of the right-hand side: gain times the input, or in free motion what moves instead
    double length_s;
    double interval_s;
    double time_constant_s;    ///< of the model: how long it takes to most of its way
    double quantum;            ///< readings are multiples of it; 0: of none
    std::size_t orders;        ///< of the model's denominator, different ones above 0
    std::size_t input_levels;  ///< different ones, 0 among them where it occurs; at most 100
    double held_share;         ///< of the readings that repeat the one before; 0 where a quantum explains them
    double deployed_step_s;  ///< of the simulation that ran, where one may have: fractional, given, not too long; or 0
    bool steady;             ///< the model rests somewhere for each input: it does not integrate
    bool two_signs;          ///< the input is above 0 here and below 0 there
    double output_max;       ///< of |z|
    double turn;             ///< readings jump by so much, as they do at the end of a turn; 0: they never do
    bool maybe_speed;        ///< the highest order is about 1: the output may be a speed
    double further_max;      ///< of |u| of the records' second input; 0: one has none
    bool swings = false;     ///< its second order has complex poles, as no flow has
    bool driven = true;      ///< something is put in; free motions otherwise
    bool may_clip = true;    ///< readings end at a limit, or would not show it
    bool drains = true;      ///< its resistance may bend as an outflow's; what moves is braked by drag instead
};

struct EffectParameter {
    std::string name;
    std::string unit;
    double lower;
    double upper;
    double none;                 ///< the value at which the effect is not there
    std::vector<double> starts;  ///< fits begin at each
    bool discrete = false;       ///< stays at its start: a variant, or a value that the audit found
    std::size_t free_starts = std::numeric_limits<std::size_t>::max();  ///< behind so many starts it is discrete
    /// Of a lasting effect: each record has one of its own, which is begun at the best of the starts there. That of all
    /// is the first record's.
    bool of_record = false;
};

/// What an effect is bound to.
enum class Kind {
    lasting,  ///< keeps its fitted parameters in other records
    event,    ///< happens at its own times in each record: located afresh
};

/// Where an effect acts, in the order in which a signal comes by.
enum class Place {
    command,   ///< on its way to the actuator
    actuator,  ///< from u to w
    plant,     ///< in the equation of motion
    output,    ///< between y and the sensor
    sensor,
    logger,
    deployed,  ///< in the simulation that ran
};

[[nodiscard]] const char* name_of(Place place);

/// What a plant is.
enum class Domain { mechanical, thermal, hydraulic, electric };

[[nodiscard]] const std::set<Domain>& all_domains();
[[nodiscard]] const char* name_of(Domain domain);
/// \throws glsum::Failure (bad input) naming those there are
[[nodiscard]] Domain domain_named(const std::string& name);

/// What a first guess may look at.
struct Clue {
    const Course& course;
    const Scenario& scenario;           ///< without the effect
    std::span<const double> residuals;  ///< of it, at the stamps
    const Scales& scales;
};

/// Another effect, at values of its own.
struct Special {
    std::string effect;
    std::vector<double> values;  ///< in the order of its parameters
};

struct Effect {
    std::string name;
    Kind kind;
    /// None: it cannot occur in these records.
    std::vector<EffectParameter> (*parameters)(const Scales& scales);
    /// \param values  in the order of `parameters`
    void (*add_to)(Scenario& scenario, std::span<const double> values);
    /// Effects that are special cases of this one.
    std::vector<std::string> generalises = {};
    /// Effects elsewhere that do the same as long as all moves slowly: a base's dynamics alone part them.
    std::vector<std::string> looks_like = {};
    /// Where the residuals say that it happened: values in the order of `parameters`. For events.
    std::vector<double> (*guess)(const Clue& clue) = nullptr;
    Place place;
    /// What files call its parameters, in the order of `parameters`, which has the same names.
    std::vector<Number> numbers;
    std::set<Domain> domains = all_domains();  ///< in which it can occur
    bool uneven_noise = false;                 ///< it makes noise uneven by nature
    bool of_fitted_base = false;               ///< a base that is fitted has this already
    bool linear = false;  ///< linear, and the same at all times: a base of another form takes it up
    bool hides_base =
        false;  ///< readings under it mislead a base that is fitted without it: both begin at the form's values
    bool leads_base = false;    ///< a fitted base has to follow it before its numbers can be told
    bool only_spreads = false;  ///< moves no reading: found by likelihood, not by the sum of squares
    bool of_time = false;       ///< it grows with time, whatever moves
    bool smooth = false;        ///< a curve, as the first term of a series: it follows other curves, too
    bool rounds = false;        ///< a reading stands for a range of values, within which nothing is missed
    std::vector<Written> (*to_contract)(const Effect& effect, std::span<const Fitted> fitted) = numbers_to_contract;
    std::vector<double> (*from_contract)(const Effect& effect, const Contracted& contracted) = numbers_from_contract;
    /// Why it is linear with these numbers, and so what a fitted base of another form takes up; empty: it is not. None:
    /// it never is.
    std::string (*linear_with)(std::span<const Fitted> fitted, const Scales& scales) = nullptr;
    /// A further start that the residuals of what is there without it tell, for numbers whose basin is narrow: values
    /// in the order of `parameters`. For lasting ones.
    std::vector<double> (*start)(const Clue& clue) = nullptr;
    /// What it adds to the slope of the restoring term at an output, over the base's own, which is 1: a base that was
    /// fitted without it has it in its numbers.
    double (*slope)(std::span<const double> values, double output) = nullptr;
    /// Whether its law counts the output from 0 with these numbers, as a level from an empty tank: a base that was
    /// fitted without it is about another point.
    bool (*from_zero)(std::span<const double> values) = nullptr;
    /// What it is with these numbers, another effect that says as much by a simpler law; none: itself.
    std::optional<Special> (*is_only)(std::span<const double> values) = nullptr;
    /// After how long it comes again by itself with these numbers; none: it does not.
    double (*period_s)(std::span<const double> values) = nullptr;
    /// Whether the other one is a special case of it.
    [[nodiscard]] bool covers(const Effect& other) const;
    /// Whether one of the two looks like the other.
    [[nodiscard]] bool resembles(const Effect& other) const;
};

/// All that there are, in the order of the list (effects.def).
[[nodiscard]] const std::vector<const Effect*>& effects();
/// \throws glsum::Failure (bad input) naming those there are
[[nodiscard]] const Effect& effect_named(const std::string& name);

}  // namespace gap
