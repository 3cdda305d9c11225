// From a plant and a wish to a fractional PID, beside the best integer PID for the same wish.
#pragma once

#include <optional>
#include <string>

#include "drive/controller_file.hpp"
#include "drive/tune/margins.hpp"
#include "drive/tune/search.hpp"
#include "drive/tune/trial.hpp"

namespace tune {

struct Request {
    std::optional<double> margin_deg;   ///< with `crossover`
    std::optional<double> crossover;    ///< rad/s
    std::optional<double> sensitivity;  ///< largest |S|, above 1
    std::optional<double> filter_s;  ///< else a tenth of the crossover's time, or of the plant's scale; never below h
    double sample_time_s = 0.0;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    double setpoint_weight = 1.0;
    double setpoint = 1.0;
    std::optional<double> load;     ///< else half of the input that holds the set point; 0.5 of an integrating plant
    std::optional<double> until_s;  ///< of set point and of load; else 20 over the crossover, or over the plant's scale
};

/// One controller, held against everything that is known of it.
struct Design {
    drive::Fopid controller;
    bool flat = false;  ///< the phase has no slope at the crossover
    Margins margins;
    double weak_deg = 0.0;    ///< phase margin where the plant's gain is 0.8 of the model's
    double strong_deg = 0.0;  ///< and 1.25
    double load_iae = 0.0;    ///< of a load of 1 without limits
    std::size_t tries = 0;    ///< of the search
    Course course;
};

struct Tuned {
    drive::Model plant;
    Request request;
    Wish wish;
    Trial trial;
    std::optional<Design> fractional;  ///< nothing: the wish cannot be met
    std::optional<Design> integer;
    std::optional<Design> steep;  ///< where the integer PID's phase is flat: the best one that need not be
    std::string nearest;          ///< where neither is there: what could be reached
    /// The part of the integer PID's load error that the fraction saves, limits included. \pre both are there
    [[nodiscard]] double saving() const;
};

/// What a fraction must save to be worth its memory.
inline constexpr double worthwhile_saving = 0.03;

/// \param name  begins messages about the plant
/// \throws glsum::Failure (bad input) for wishes or limits that contradict themselves or the plant
[[nodiscard]] Tuned tune(const drive::Model& plant, const Request& request, const std::string& name);

}  // namespace tune
