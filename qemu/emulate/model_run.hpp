// Whole models stepped on the emulated board: what a step costs there, and which bits it computes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "glsum/model/stepper.hpp"
#include "qemu/emulate/firmware.hpp"

namespace qemu {

/// One model to step, from a cleared past. The design's spans and the input must live on.
struct PlannedModel {
    std::string kernel;  ///< of `glsum::ModelKernels`
    const glsum::ModelDesign* design;
    std::span<const double> input;  ///< repeated where it is shorter than the steps
    std::size_t steps;              ///< at least 100; counts are those of the last 32
};

/// `targets/model.elf` beside the board's others. \throws glsum::Failure (missing) where it is not built.
[[nodiscard]] std::filesystem::path model_elf(const Board& board);

/// Steps each model on the board and counts. `first` is the first step, `instructions` and its like the mean of the
/// last 32 steps, `worst_instructions` of all. The hash is of steps + 1 outputs. Modelled cycles are those of the first
/// step and of the first 8 of the last 32 (in software double of one). \param timing  cores that the timing model is to
/// have \throws glsum::Failure when the emulator fails.
[[nodiscard]] std::vector<MeasuredRow> step_models(const Board& board, std::span<const PlannedModel> plan,
                                                   const RowDone& done, const timing::TimingRequest& timing = {});

/// The same steps on this machine.
struct SteppedModel {
    glsum::Status status;
    std::uint64_t hash;
    std::vector<double> output;  ///< y_0 ... y_steps
    std::uint32_t saturations;
    std::size_t multiplications;  ///< of a step
};
/// \throws std::out_of_range for a kernel that is not there
[[nodiscard]] SteppedModel step_model_here(const PlannedModel& planned);

}  // namespace qemu
