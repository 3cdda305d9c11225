// The C text of a kernel's three words: which of the kernels' own statements (shared.hpp) a header of them holds.
// Places (text.hpp): @name@ and @NAME@ begin every identifier, @sample@,
// @coefficient@,
// @accumulator@ and @output@ are the format's types.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "glsum/exponentials/modes.hpp"
#include "glsum/logmemory/nested.hpp"
#include "glsum/lookahead/block.hpp"

namespace generate {

/// How a history is written.
struct HistoryText {
    std::string summary;
    std::string formula = {};       ///< of the sum, in the opening comment; empty: that of a window
    std::string fields;             ///< of the instance
    std::string reset;              ///< statements of `init`
    std::string window = {};        ///< declarations of its pieces, as the kernels call them
    bool two_pieces = false;        ///< a newer and an older one
    std::string push = {};          ///< statements that store `newest`
    std::string before = {};        ///< statements before the sum, which may change `newest`
    std::string behind_start = {};  ///< a statement between a sum's start and its loops
    std::string behind = {};        ///< statements behind it, before `push`, which add to `sum`
};

/// How a technique is written.
struct TechniqueText {
    std::string summary;
    std::string sum;           ///< statements that end with the accumulator in `sum`, but for those of `closing`
    std::string closing = {};  ///< behind the upkeep, which a core does while it waits for these
    bool pushes = false;       ///< whether they store `newest` too
    bool pairs = false;        ///< needs the words of two samples
    bool fused = false;        ///< needs a fused multiply-add
    /// As a format's, behind these.
    std::vector<std::pair<std::string, std::string>> helpers = {};
    std::string m7 = {};  ///< needs this loop in the order of a Cortex-M7's issue slots, by its `M7Loop::name`
};

/// A file of kernels/glsum/window/m7, which a header holds as it is but for its names.
struct M7Loop {
    std::string_view name;       ///< of the function behind @name@_
    std::string_view macro;      ///< that makes it
    std::string_view arguments;  ///< of the macro behind the function's name
    std::string_view text;
};
extern const M7Loop m7_loops[4];

/// How a format is written.
struct FormatText {
    std::string summary;
    /// Name behind @name@_ and text, each after those that it calls; a header has the ones that it uses.
    std::vector<std::pair<std::string, std::string>> helpers;
    std::string scaling;  ///< the comment's paragraph on scaling and overflow
};

[[nodiscard]] HistoryText history_text(glsum::Modes);
[[nodiscard]] HistoryText history_text(glsum::Block);
[[nodiscard]] HistoryText history_text(glsum::Nested);
/// Increments, kept as `kept` keeps samples.
[[nodiscard]] HistoryText increments_text(const HistoryText& kept, bool fixed);
/// Modes and an integrator. \param near_samples  K - 1
[[nodiscard]] HistoryText integrator_text(const HistoryText& modes, std::size_t near_samples);
/// What stands behind its sum.
[[nodiscard]] std::string integrator_closing();
/// A window of `past` samples and a guess of what it dropped; with `to_first` on the line to the first sample.
[[nodiscard]] HistoryText guess_text(const HistoryText& window, std::size_t past, bool to_first);

/// Of a technique whose texts bear its unfused word. \param mixed  samples of half a word, coefficients of a whole one
[[nodiscard]] TechniqueText worded_text(std::string_view word, std::string_view summary, const HistoryText& history,
                                        bool fused, bool mixed);
/// \param in_software  sums in double, which takes calls on some targets \param m7  the loop that gives the same bits;
/// empty: none
[[nodiscard]] TechniqueText multi_text(const HistoryText& history, std::size_t past, bool fused, bool in_software,
                                       const std::string& m7);
[[nodiscard]] TechniqueText horner_text(const HistoryText& history, bool fused, bool in_software);
[[nodiscard]] TechniqueText horner_split_text(const HistoryText& history, std::size_t past, bool fused);
[[nodiscard]] TechniqueText fir_text(bool fused, bool fixed);
[[nodiscard]] TechniqueText paired_text(bool wide);
/// \param table  as `prepare` filled it: `past` coefficients, then the octaves' shifts
[[nodiscard]] TechniqueText scaled_text(std::size_t past, const std::vector<int>& shifts);

/// Of a history that states its sum itself: `fields` of the instance are its own.
[[nodiscard]] HistoryText stated_history_text(std::string_view summary, std::string_view fields);
/// Of one that gives a window: the texts "WORD window" and "WORD push" are its own, too.
[[nodiscard]] HistoryText window_text(std::string_view word, std::string_view summary, std::string_view fields,
                                      bool contiguous);
/// The statements that bear such a history's word: WORD up to the sum, then "WORD settle", which keeps the past.
[[nodiscard]] TechniqueText stated_sum_text(std::string_view word, std::string_view summary, bool fused);

/// Near taps and modes, which keep the past themselves.
/// \param near_samples  K - 1; without modes at least 1
[[nodiscard]] TechniqueText modes_text(std::size_t near_samples, std::size_t modes, bool compensated, bool fixed,
                                       bool in_software);

/// A window summed for four coming outputs at once.
[[nodiscard]] TechniqueText block_text(bool fused, bool fixed);

/// Near taps and blocks. \param near_samples  K - 1; without blocks at least 1
[[nodiscard]] TechniqueText nested_text(std::size_t near_samples, const glsum::Blocks& blocks, bool fixed,
                                        bool in_software);

/// \param normal_table  no coefficient is zero, subnormal, infinite or NaN
[[nodiscard]] FormatText floating_text(bool wide_data, bool wide_sum, bool normal_table);
/// The constants of a fixed-point kernel's scale.
struct FixedScale {
    int sample_bits;
    int coefficient_bits;
    int table_exponent;
    int output_exponent;
    int output_shift;
    bool half_scale = false;  ///< samples of increments: `sample_bits` and `output_exponent` are those of x and S
};
[[nodiscard]] FormatText fixed_text(const FixedScale& scale);

}  // namespace generate
