// The registry behind functions. A test of what holds for every kernel is then compiled once, not once a kernel, which
// took a sixth of the whole build; what looks into a kernel's own types is typed (registered.hpp).
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glsum/bound.hpp"
#include "glsum/kernel.hpp"
#include "reference/dropped.hpp"

namespace test {

/// A kernel's state with buffers of its own, and guards around them. Samples and sums are real: a sample is rounded to
/// the format's, and a sum of any format is a double, bit for bit.
class AnyLine {
public:
    virtual ~AnyLine() = default;
    /// How the last `prepare` went.
    [[nodiscard]] virtual glsum::Status status() const = 0;
    /// Once more, in the same buffers but for so many elements at their ends.
    virtual glsum::Status prepare(const glsum::Design& design, std::size_t less_table = 0,
                                  std::size_t less_past = 0) = 0;
    /// What lies in memory that nobody has set: in the state and in both buffers.
    virtual void spoil() = 0;
    virtual void reset() = 0;
    virtual double step(double sample) = 0;
    [[nodiscard]] virtual double bound(const glsum::Design& design, double peak,
                                       std::size_t samples = glsum::longest_record) const = 0;
    /// Whether everything around the buffers is as it was.
    [[nodiscard]] virtual bool guards_hold() const = 0;
};

struct AnyKernel {
    std::string_view name;
    std::string_view technique;
    reference::Dropped dropped;  ///< what its history takes for what leaves the window
    bool of_window;              ///< its family
    bool fixed_point;
    double smallest_sample;  ///< above 0
    bool (*order_in_range)(double order);
    /// Buffers for `buffers`, so many elements behind the alignment of a cache line, prepared for it.
    std::unique_ptr<AnyLine> (*make_line)(const glsum::Design& buffers, std::size_t offset);

    [[nodiscard]] std::unique_ptr<AnyLine> line(const glsum::Design& design, std::size_t offset = 0) const {
        return make_line(design, offset);
    }
    [[nodiscard]] bool takes_zero() const { return dropped == reference::Dropped::zero; }
    [[nodiscard]] bool guesses() const {
        return dropped == reference::Dropped::held || dropped == reference::Dropped::line;
    }
    /// In Horner form, from the oldest sample: no weight may follow a zero.
    [[nodiscard]] bool horner() const { return technique.starts_with("horner"); }
    /// The exact sums of what a design stands for.
    [[nodiscard]] reference::Sums exact_sums(const glsum::Design& design, std::span<const double> record) const {
        return reference::sums_of(dropped, design, record);
    }
};

inline void PrintTo(const AnyKernel& kernel, std::ostream* out) { *out << kernel.name; }

/// Every kernel but `null`.
const std::vector<AnyKernel>& any_kernels();

class EveryKernel : public testing::TestWithParam<AnyKernel> {
protected:
    const AnyKernel& kernel = GetParam();
};

/// What INSTANTIATE_TEST_SUITE_P takes besides `testing::ValuesIn(any_kernels())`.
inline std::string name_of(const testing::TestParamInfo<AnyKernel>& info) { return std::string(info.param.name); }

}  // namespace test
