// Simulates a scenario over a record.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "gap/drive/derivative.hpp"
#include "gap/drive/scenario.hpp"

namespace gap {

/// A record with what its simulations share: the grid, the held input on it, the exponentials.
class Course {
public:
    /// \param per_interval  nodes to the usual interval
    Course(const Record& record, double per_interval);
    [[nodiscard]] const Record& record() const { return *record_; }
    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const std::vector<double>& held() const { return held_; }
    /// Of the record's further inputs, likewise.
    [[nodiscard]] const std::vector<std::vector<double>>& more_held() const { return more_held_; }
    [[nodiscard]] const Exponentials& exponentials() const { return exponentials_; }
    /// Values at the nodes, read at the stamps by straight lines.
    [[nodiscard]] std::vector<double> read(std::span<const double> nodes) const;
    /// The output y at the nodes.
    [[nodiscard]] std::vector<double> nodes_of(const Scenario& scenario) const;
    /// Added to every simulated reading: what the steps are off by, for the scenario that the course was made for.
    [[nodiscard]] const std::vector<double>& correction() const { return correction_; }
    void correct(std::vector<double> correction);
    /// What the deployed simulation of a model reads at the stamps. It costs the square of its steps, and candidates
    /// ask for the same ones again and again: lately computed ones are kept. Thread-safe. \param taps  0: all
    [[nodiscard]] std::vector<double> deployed(const drive::Model& model, const Deployed& deployed,
                                               std::size_t taps) const;

private:
    struct Known {
        std::mutex mutex;
        std::map<std::vector<double>, std::vector<double>> readings;
    };
    std::unique_ptr<Known> known_ = std::make_unique<Known>();
    const Record* record_;
    Grid grid_;
    std::vector<double> held_;
    std::vector<std::vector<double>> more_held_;
    Exponentials exponentials_;
    std::vector<double> correction_;
    std::vector<std::size_t> below_;  // the node before each stamp
    std::vector<double> share_;       // of the interval behind it
};

/// The output y at the nodes. Second order in the step; thread-safe.
[[nodiscard]] std::vector<double> move(const Scenario& scenario, const Course& course,
                                       std::vector<double>& effective_input);

/// The readings at the stamps. Not finite where the scenario runs away.
[[nodiscard]] std::vector<double> simulate(const Scenario& scenario, const Course& course);

/// The coarsest course, of 1, 2, 4 or 8 nodes to the interval, whose simulation of the scenario is off by at most
/// `allowed` in rms, as one at twice as many nodes tells; what it is off by is then its correction.
[[nodiscard]] Course make_course(const Record& record, const Scenario& scenario, double allowed);

/// A cheaper course for first looks: of a quarter of a node to the thin record's interval up to as many as `fine` has,
/// the coarsest whose simulation of the scenario differs from `fine`'s by at most `allowed` in rms; by how much it
/// differs is its correction. \param thin  every `every`-th sample of `fine`'s record; outlives the course
[[nodiscard]] Course make_sketch(const Course& fine, const Record& thin, std::size_t every, const Scenario& scenario,
                                 double allowed);

}  // namespace gap
