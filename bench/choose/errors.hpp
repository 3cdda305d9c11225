// The error of any kernel at any length, measured where it is asked for and remembered.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/choose/records.hpp"
#include "glsum/kernel.hpp"

namespace choose {

/// `error_max` of one kernel at one length: the worst of the signals.
struct ErrorAt {
    double error = std::numeric_limits<double>::infinity();
    std::string signal;  ///< the worst
    std::string fault;   ///< why there is no answer or a wrong one; empty if there is a right one
};

/// Where a search gets its errors from.
class ErrorSource {
public:
    virtual ~ErrorSource() = default;
    /// Taps of full memory: no length is longer.
    [[nodiscard]] virtual std::size_t longest() const = 0;
    /// Rising, the lengths of a kernel that has few; nothing: every length up to the longest.
    [[nodiscard]] virtual std::optional<std::vector<std::size_t>> lengths(const std::string&) const { return {}; }
    /// After so many of `lengths` in a row that came no nearer by a twentieth, none longer is tried.
    [[nodiscard]] virtual std::size_t patience() const { return std::numeric_limits<std::size_t>::max(); }
    /// Kernels of one group share work: asked at once, they wait for each other.
    [[nodiscard]] virtual std::string group(const std::string& kernel) const { return kernel; }
    [[nodiscard]] std::size_t longest_of(const std::string& kernel) const {
        const auto few = lengths(kernel);
        return few ? few->back() : longest();
    }
    /// What truncation alone costs at this length, worst of the signals: a guide, not a measurement.
    [[nodiscard]] virtual double truncation(std::size_t taps) const = 0;
    /// No error at this length or a shorter one is farther from `truncation` than this. Thread-safe.
    [[nodiscard]] virtual double rounding_bound(const std::string& kernel, std::size_t taps) const = 0;
    /// Thread-safe.
    [[nodiscard]] virtual ErrorAt error(const std::string& kernel, std::size_t taps) = 0;
    /// Whether error(kernel, taps) <= limit, measured only as far as the answer needs. Thread-safe.
    [[nodiscard]] virtual bool meets(const std::string& kernel, std::size_t taps, double limit) = 0;
};

/// Measures by running the kernel over every record against the exact sums: the contract's error_max, at any step.
class MeasuredErrors : public ErrorSource {
public:
    MeasuredErrors(double order, std::vector<Record> records);

    /// What another run measured, at the same conditions.
    void remember(const std::string& kernel, std::size_t taps, const std::string& signal, double error);

    [[nodiscard]] std::size_t longest() const override { return truncation_.size(); }
    /// Of a kernel with modes: the designs of `bench::length_of`, for the records. Of one with blocks, and one that
    /// does not take what its window dropped as 0: every length to 128, then to the longest each an eighth longer than
    /// the last.
    [[nodiscard]] std::optional<std::vector<std::size_t>> lengths(const std::string& kernel) const override;
    [[nodiscard]] double truncation(std::size_t taps) const override { return truncation_[taps - 1]; }
    [[nodiscard]] double rounding_bound(const std::string& kernel, std::size_t taps) const override;
    [[nodiscard]] ErrorAt error(const std::string& kernel, std::size_t taps) override;
    [[nodiscard]] bool meets(const std::string& kernel, std::size_t taps, double limit) override;

    [[nodiscard]] std::size_t measured() const { return measured_; }      ///< runs over a record so far
    [[nodiscard]] std::size_t remembered() const { return remembered_; }  ///< answers that another run gave

private:
    // Of one signal; a lower bound when it was only seen to be beyond a limit.
    struct Known {
        double error;
        bool whole;
    };
    Known of_signal(const std::string& kernel, std::size_t taps, std::size_t signal, double limit, std::string& fault);

    [[nodiscard]] glsum::Design design_of(const std::string& kernel, std::size_t taps) const;

    double order_;
    std::vector<Record> records_;
    std::vector<double> truncation_;
    std::mutex mutex_;
    std::map<std::pair<std::string, std::size_t>, std::vector<Known>> known_;
    std::map<std::pair<std::string, std::size_t>, std::vector<double>> given_;
    std::size_t measured_ = 0;
    std::size_t remembered_ = 0;
};

/// Places in `kernels`, the first of each group first, then the second of each: neighbours share no work.
[[nodiscard]] std::vector<std::size_t> turns_of(const ErrorSource& errors, const std::vector<std::string>& kernels);

}  // namespace choose
