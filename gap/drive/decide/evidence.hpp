// What rules decide by: the ranking and what can be asked of it.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "gap/drive/ranking.hpp"
#include "gap/drive/residuals/disturbance.hpp"
#include "gap/drive/residuals/flexible.hpp"

namespace gap {

/// What takes simulations to find out, by place in the ranking: found out when it is asked for.
struct FoundOut {
    std::map<std::size_t, std::string> objections;
    std::map<std::size_t, Flexible> remainders;
    std::map<std::size_t, bool> open;
};

class Evidence {
public:
    /// All of them outlive this. \param ranking  the best first, `none` among them
    /// \param whitener  of the ranking's likelihoods \param same_records  validation is a part of the fitted ones
    /// \param known  need not be found out again
    Evidence(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study, const Study& validation,
             bool same_records, FoundOut known = {});

    const std::vector<Ranked>& ranking;
    const Study& study;
    const Study& validation;
    const bool same_records;

    [[nodiscard]] std::size_t none() const;
    /// The best of a size that can be named.
    [[nodiscard]] std::optional<std::size_t> best_of(std::size_t size) const;
    /// Why a candidate cannot be named, whatever its likelihood: training leaves it open, or its events are no events.
    /// Empty: it can.
    [[nodiscard]] const std::string& objection(std::size_t i) const;
    /// Whether training, fitted without one of a candidate's effects beside a fitted form, is missed by many times the
    /// squares: an interval is a straight line's, and of readings within their steps no line tells.
    [[nodiscard]] bool training_needs(std::size_t i, const Effect& effect) const;
    /// Whether other numbers of a candidate's effects would leave the same, with another base.
    [[nodiscard]] bool is_open(std::size_t i) const;
    [[nodiscard]] double gap(std::size_t i) const { return ranking[i].gap_after; }
    [[nodiscard]] bool beside_form() const { return study.base.refit; }
    /// A gap over what differs from sample to sample.
    [[nodiscard]] double over_noise(double gap) const;
    /// Whether a gap is more than a sensor's noise: that is seldom so coloured.
    [[nodiscard]] bool is_no_noise(double gap) const { return over_noise(gap) > usual_ratio; }
    /// Whether a gap is noise, and a twentieth of the base's at most: no event follows a form's misfit so far.
    [[nodiscard]] bool leaves_noise_alone(double gap) const;
    /// Whether a gap is so little that it may be a fitted form's own misfit.
    [[nodiscard]] bool is_small_of_a_form(double gap) const;
    /// What a model without physics still takes off a candidate's residuals on the validation.
    [[nodiscard]] const Flexible& remainder(std::size_t i) const;
    /// Of the squared gap of a fitted base alone: what its operating point has moved by since it was fitted.
    [[nodiscard]] double level_share(std::size_t i) const;
    /// Whether a candidate of a fitted base leaves what it left where it was fitted, stationary, and neither input nor
    /// output foresee it.
    [[nodiscard]] bool leaves_a_disturbance(std::size_t i) const;

    static constexpr double usual_ratio = 7.0;
    /// What differs from sample to sample, so many times, is more than the noise of most sensors, if not of all.
    static constexpr double most_sensors = 4.0;

private:
    [[nodiscard]] std::string objection_to_events(const Candidate& trained, Candidate judged, double gap) const;

    const Whitener& whitener_;
    mutable FoundOut known_;
};

/// Whether a candidate has all effects of another.
[[nodiscard]] bool contains(const Candidate& wider, const Candidate& narrower);
/// The same, or wider ones in their stead (Effect::covers).
[[nodiscard]] bool goes_beyond(const Candidate& wider, const Candidate& narrower);

[[nodiscard]] bool is_clear(const Interval& over);
/// A fitted form that leaves less than so much of the deviation, two thousandths of the variance, has all that matters
/// where noise hides what it leaves,
constexpr double small_gap_of_a_form = 0.0447;
/// and less than that, an eightieth of the deviation, where clean readings show it.
constexpr double small_gap_of_clean_readings = 0.0125;
/// A cause may still be told in it; in 0.7 % it is the log's.
constexpr double gap_without_causes = 0.007;

}  // namespace gap
