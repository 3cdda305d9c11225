// Measured functions of any programs, as a diagnosis takes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gap/cycles/diagnose.hpp"
#include "qemu/emulate/predicted_calls.hpp"

namespace gap::cycles {

/// Rows of any programs' functions, and what predicts them.
class Programs {
public:
    /// \param calls  at least one
    /// \param core   the core file that is judged; empty: those that the rows name
    /// \param name   of the file of the rows, with which messages begin
    /// \param jobs   emulators at once
    Programs(qemu::CallsProgram program, std::vector<qemu::MeasuredCall> calls, const std::string& core,
             std::string name, unsigned jobs);

    /// The cycles of whole calls; the length of a row is what the call executes.
    /// \throws glsum::Failure as `qemu::predict_calls`, and (bad input) where the rows' cores pay for different effects
    [[nodiscard]] Question question() const;
    /// Of the question's rows; as `qemu::predict_calls`.
    [[nodiscard]] std::vector<std::vector<qemu::PredictedCycles>> predict(
        const std::vector<qemu::CoreVariant>& variants) const;

private:
    qemu::CallsProgram program_;
    std::vector<qemu::MeasuredCall> calls_;
    bool of_the_rows_;                ///< each row is judged by the core that it names
    std::vector<std::string> cores_;  ///< that are judged
    std::string name_;
    unsigned jobs_;
};

}  // namespace gap::cycles
