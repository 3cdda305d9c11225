// Measured functions of any programs, as a diagnosis takes them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gap/cycles/diagnose.hpp"
#include "qemu/emulate/predicted_calls.hpp"

namespace gap::cycles {

/// Predictions of all calls, for each variant of a core, as `qemu::predict_calls` has them.
using PredictCalls =
    std::function<std::vector<std::vector<qemu::PredictedCall>>(const std::vector<qemu::CoreVariant>& variants)>;

/// Rows of any programs' functions, and what predicts them.
class Programs {
public:
    /// \param calls    at least one
    /// \param core     the core file that is judged; empty: those that the rows name
    /// \param cores    the folder of core files
    /// \param predict  of these calls
    Programs(std::vector<qemu::MeasuredCall> calls, const std::string& core, std::filesystem::path cores,
             PredictCalls predict);

    /// The cycles of whole calls; the length of a row is what the call executes.
    /// \throws glsum::Failure as `predict`, and (bad input) where the rows' cores pay for different effects
    [[nodiscard]] Question question() const;
    /// Of the question's rows; throws as `predict`.
    [[nodiscard]] std::vector<std::vector<qemu::PredictedCycles>> predict(
        const std::vector<qemu::CoreVariant>& variants) const;

private:
    std::vector<qemu::MeasuredCall> calls_;
    bool of_the_rows_;                ///< each row is judged by the core that it names
    std::vector<std::string> cores_;  ///< that are judged
    std::filesystem::path cores_folder_;
    PredictCalls predict_;
};

}  // namespace gap::cycles
