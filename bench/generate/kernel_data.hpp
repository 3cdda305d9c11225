// All that a header needs of a registered kernel, as plain data: its words, its table, its scale, its outputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/generate/parts.hpp"
#include "glsum/design/band.hpp"

namespace generate {

/// A type of C with its values, each exactly a double or a 64-bit integer.
struct Numbers {
    std::string type;  ///< "float", "double", "int32_t", "int16_t"
    std::vector<double> reals;
    std::vector<std::int64_t> integers;
};

struct KernelData {
    bool fixed = false;
    bool pairs = false;        ///< a table of words of two coefficients
    bool horner_form = false;  ///< sums have the units of samples, not of products
    std::string format;        ///< its word
    std::string accumulator;
    std::string output;
    std::size_t past = 0;  ///< samples that a sum reads
    std::size_t samples_held = 0;
    std::size_t modes = 0;
    std::size_t decaying = 0;                      ///< of these
    std::optional<double> integrator_weight = {};  ///< of the one that does not: the integrator
    bool has_blocks = false;                       ///< whether the kernel keeps them, if only none
    glsum::Blocks blocks = {};
    double design_error = 0.0;  ///< with modes or blocks: against full memory over the horizon, for |x| <= 1
    std::optional<std::size_t> groups = {};  ///< of samples, in a window summed for several outputs at once
    bool increments = false;
    bool guesses = false;      ///< what its window dropped
    double in_window = 0.0;    ///< then: a_0 + ... + a_(L-1), as the kernel has it
    double minus_order = 0.0;  ///< and -v
    Numbers table;
    std::size_t aligned_words = 0;  ///< of a table of pairs: those of the first of the two tables
    FixedScale scale{};
    HistoryText history_text;
    TechniqueText technique_text;
    FormatText format_text;
    double error_bound = 0.0;            ///< for |x| <= 1, over the horizon
    bool bound_grows = false;            ///< with the record
    Numbers inputs;                      ///< of the self-check
    std::vector<std::uint64_t> outputs;  ///< their bits, for the inputs repeated
    std::uint64_t hash = 0;              ///< of the outputs, as targets/shared/output_hash.hpp has it
};

/// \param taps     of a kernel with modes: near taps and two for each mode, with blocks one for each, as
/// `bench::length_of` parts them \param horizon  samples that a design with modes or blocks is for \param fitted  the
/// weights and modes where they are not the order's own, else null \param calls outputs wanted \throws glsum::Failure
/// (bad input) for a kernel that is not there or cannot be generated, and for a design that the
///         kernel refuses.
[[nodiscard]] KernelData describe(const std::string& kernel, double order, std::size_t taps, std::size_t horizon,
                                  const glsum::design::FittedFilter* fitted, const std::vector<double>& inputs,
                                  std::size_t calls);

}  // namespace generate
