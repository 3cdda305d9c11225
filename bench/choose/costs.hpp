// What kernels cost on a target, measured where it is asked for and remembered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/choose/counted_order.hpp"
#include "bench/rows/result_file.hpp"
#include "qemu/emulate/firmware.hpp"

namespace choose {

/// A kernel at a length.
using Case = std::pair<std::string, std::size_t>;

struct Cost {
    double value = 0.0;    ///< what is ranked, in `CostSource::unit()` a sample
    double limited = 0.0;  ///< what a limit holds against: cycles on the host, the band's upper end of a model
    double noise = 0.0;    ///< half the spread of `value`; 0 for counts
    double bytes = 0.0;    ///< state and coefficients
    std::string fault;     ///< why the answer is wrong or missing; empty if it is right
};

class CostSource {
public:
    virtual ~CostSource() = default;
    [[nodiscard]] virtual std::string unit() const = 0;          ///< of what is ranked: "instructions"
    [[nodiscard]] virtual std::string limited_unit() const = 0;  ///< of what is limited
    /// Whether equal code and length give equal costs, every time.
    [[nodiscard]] virtual bool exact() const = 0;
    /// Whether a kernel is known to be so costly that a short length should be measured before a long one.
    [[nodiscard]] virtual bool costly(const std::string&) const { return false; }
    [[nodiscard]] virtual std::vector<Cost> costs(const std::vector<Case>& cases) = 0;
};

/// Cycles of a modelled core a sample, or instructions, on the emulated Cortex-M7: the same for every run of the same
/// firmware.
class OnTarget : public CostSource {
public:
    /// \param samples  of the noise on which double precision in software, whose cost depends on the data, is measured
    /// \param core     a file of the board's cores; empty: instructions are counted
    /// \throws glsum::Failure (bad input) for a core that has no file
    OnTarget(qemu::Board board, const CountedOrder& order, std::size_t samples, std::uint64_t seed, unsigned jobs,
             const std::string& core = "");
    void remember(const Case& of, const Cost& cost);

    [[nodiscard]] bool modelled() const { return !timing_.cores.empty(); }
    [[nodiscard]] std::string unit() const override { return modelled() ? "model cycles" : "instructions"; }
    [[nodiscard]] std::string limited_unit() const override {
        return modelled() ? "model cycles, upper end of the band" : unit();
    }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] bool costly(const std::string& kernel) const override;
    /// Each measured call's outputs are held against the host's, bit by bit.
    [[nodiscard]] std::vector<Cost> costs(const std::vector<Case>& cases) override;

    [[nodiscard]] std::size_t measured() const { return measured_; }
    [[nodiscard]] std::size_t remembered() const { return remembered_; }

private:
    qemu::Board board_;
    CountedOrder order_;
    qemu::Signals signals_;
    unsigned jobs_;
    timing::TimingRequest timing_;
    std::map<Case, Cost> known_;
    std::map<Case, Cost> given_;
    std::size_t measured_ = 0;
    std::size_t remembered_ = 0;
};

/// Of one timing's repetitions, which have this `run_name`: as `value` their median time in ns, as `noise` half of what
/// their middle half spans, as `limited` the median of their cycles. Aggregates of them do not count.
[[nodiscard]] Cost cost_of_times(const std::vector<bench::Json>& rows, const std::string& name);

/// Nanoseconds a sample here: all cases of one call in one run, in interleaved repetitions, since times of different
/// runs do not compare. Never taken from a file, and never remembered.
class HostTimes : public CostSource {
public:
    static constexpr unsigned repetitions = 9;  ///< odd, so that the median is one of them
    /// \param samples  of the record that designs with modes are for
    HostTimes(const CountedOrder& order, std::size_t samples) : order_(order), samples_(samples) {}

    [[nodiscard]] std::string unit() const override { return "ns"; }
    [[nodiscard]] std::string limited_unit() const override { return "cycles"; }
    [[nodiscard]] bool exact() const override { return false; }
    [[nodiscard]] std::vector<Cost> costs(const std::vector<Case>& cases) override;
    [[nodiscard]] const std::string& cycle_counter() const { return cycle_counter_; }

private:
    CountedOrder order_;
    std::size_t samples_;
    std::string cycle_counter_;
};

}  // namespace choose
