// Fractional derivatives of a sampled signal, second order in the step, at a cost that does not grow with its past.
//
// On increments e_k = y_k - y_(k-1) the weights of D^v are those of h^-v (1-z)^(v-1) ((3-z)/2)^v [Lubich1986, BDF2]: a
// few near ones are kept, the rest is a sum of exponentials whose decays are the same for all orders, so that a change
// of order or coefficient costs one small least-squares solution and every order shares one set of states.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace gap {

/// A table on increments: near weights, newest first, and one weight for each shared exponential.
struct Table {
    Eigen::VectorXd near;
    Eigen::VectorXd far;
};

/// The exponentials that all tables over one horizon share, and the tables that were asked for lately. Thread-safe.
class Exponentials {
public:
    static constexpr Eigen::Index near_count = 14;

    /// \param horizon  the longest past in samples
    explicit Exponentials(std::size_t horizon);
    [[nodiscard]] std::size_t horizon() const { return horizon_; }
    /// Of each sample: r, in (0, 1).
    [[nodiscard]] const Eigen::ArrayXd& ratios() const { return ratios_; }
    /// The places in the past, in samples, at which tables are fitted: 5 % apart, so that a longer past costs little.
    [[nodiscard]] const std::vector<std::size_t>& fitted_at() const { return indices_; }
    /// D^v without its factor h^-v. \param order  v in (0, 3]
    [[nodiscard]] Table table(double order) const;

private:
    static constexpr std::size_t most_tables = 64;
    [[nodiscard]] Table make_table(double order) const;

    std::size_t horizon_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    mutable std::map<double, Table> tables_;
    Eigen::ArrayXd ratios_;
    std::vector<std::size_t> indices_;
    Eigen::ArrayXd row_weights_;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

/// sum_j m_j e_(k-j) as samples come, of whole orders alone: few weights and no exponentials, so that no step waits for
/// memory.
class ShortPast {
public:
    /// Whether a table has no more than this can hold.
    [[nodiscard]] static bool holds(const Table& table);
    explicit ShortPast(const Table& table);
    /// The part of the sum that does not need e_k: the oldest first, as the last increment is known last.
    [[nodiscard]] double known() const {
        return weights_[4] * e5_ + weights_[3] * e4_ + weights_[2] * e3_ + weights_[1] * e2_ + weights_[0] * e1_;
    }
    /// The weight of e_k.
    [[nodiscard]] double newest() const { return newest_; }
    void push(double increment) {
        e5_ = e4_;
        e4_ = e3_;
        e3_ = e2_;
        e2_ = e1_;
        e1_ = increment;
    }
    /// What the past looks like before the first sample: increments that were all the same.
    void fill_near(double increment) { e1_ = e2_ = e3_ = e4_ = e5_ = increment; }

private:
    static constexpr std::size_t most = 5;  // behind the newest one, of the third order

    double newest_;
    std::array<double, most> weights_{};
    // e_(k-1) and so on, one by one: a compiler moves a row of them through memory.
    double e1_ = 0.0;
    double e2_ = 0.0;
    double e3_ = 0.0;
    double e4_ = 0.0;
    double e5_ = 0.0;
};

/// The same of any orders.
class Past {
public:
    Past(const Exponentials& exponentials, Table table);
    [[nodiscard]] double known() const { return table_.near(1) * near_(head_) + older_; }
    [[nodiscard]] double newest() const { return table_.near(0); }
    void push(double increment);
    void fill_near(double increment);

private:
    [[nodiscard]] double without_last() const;

    const Exponentials* exponentials_;
    Table table_;
    Eigen::VectorXd near_;  // newest first, twice as long as needed
    Eigen::Index head_ = 0;
    Eigen::ArrayXd states_;
    double older_ = 0.0;  // of known(), all but the last increment's, which a step waits for
};

/// What `run` gives for the past that a table needs.
template <class Run>
auto with_past(const Exponentials& exponentials, const Table& table, const Run& run) {
    return ShortPast::holds(table) ? run(ShortPast(table)) : run(Past(exponentials, table));
}

}  // namespace gap
