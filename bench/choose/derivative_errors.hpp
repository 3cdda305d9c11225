// The error of any kernel at any length against the derivative that is meant: over a band of frequencies, and along a
// step. Each length has a filter of its own, fitted to that goal (glsum/design/band.hpp).
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/choose/errors.hpp"
#include "bench/choose/kernel_run.hpp"
#include "glsum/design/band.hpp"

namespace choose {

/// Who says which poles and weights a filter has.
enum class FilterDesign {
    fitted,
    oustaloup,  ///< by his rule, tuned to the band (glsum/design/rational.hpp); one near tap and modes alone
    charef,     ///< likewise
};

/// Whose filter that is, for people.
[[nodiscard]] const char* text_of(FilterDesign by);

/// The filter of a length, and of each kernel what its format and its arithmetic add. Where a kernel's noise is most of
/// its error, filters of smaller coefficients are fitted, too, and the best is taken. The error of a kernel is that of
/// the filter that it holds, its table read back, and the noise of its arithmetic (kernel_run.hpp).
class DerivativeErrors : public ErrorSource {
public:
    explicit DerivativeErrors(const glsum::design::DerivativeGoal& goal, FilterDesign by = FilterDesign::fitted);

    [[nodiscard]] std::size_t longest() const override { return longest_window; }
    /// With modes every length up to 40, parted as one near tap, or two, and modes; of a window every one to 16, then
    /// to 64 each an eighth longer than the last.
    [[nodiscard]] std::optional<std::vector<std::size_t>> lengths(const std::string& kernel) const override;
    [[nodiscard]] std::size_t patience() const override { return 6; }
    /// By what is fitted: two of one group that are asked at once wait for each other.
    [[nodiscard]] std::string group(const std::string& kernel) const override;
    [[nodiscard]] double truncation(std::size_t) const override { return 0.0; }
    [[nodiscard]] double rounding_bound(const std::string&, std::size_t) const override { return 0.0; }
    [[nodiscard]] ErrorAt error(const std::string& kernel, std::size_t taps) override;
    [[nodiscard]] bool meets(const std::string& kernel, std::size_t taps, double limit) override;

    /// What `error` fits, once. Thread-safe; it stays where it is. \pre `why_not(kernel)` is empty
    [[nodiscard]] const glsum::design::FittedFilter& filter_of(const std::string& kernel, std::size_t taps);

    /// Why a kernel cannot be fitted to a derivative; empty where it can.
    [[nodiscard]] static std::string why_not(const std::string& kernel);

private:
    static constexpr std::size_t longest_with_modes = 40;
    static constexpr std::size_t longest_window = 64;

    struct Key {
        std::size_t near_taps;
        std::size_t modes;
        glsum::design::FilterKind kind;
        glsum::design::Poles poles;
        double cost;  ///< of coefficients
        auto operator<=>(const Key&) const = default;
    };
    /// What a kernel makes of a filter at a length.
    struct Judged {
        const glsum::design::FittedFilter* filter = nullptr;
        std::string fault;
        glsum::design::DerivativeError error;
        double noise = 0.0;  ///< of the band, a part of the error
    };
    struct JudgedOnce {
        std::once_flag flag;
        Judged judged;
    };
    struct Once {
        std::once_flag flag;
        std::optional<glsum::design::FittedFilter> filter;
        std::once_flag certified_flag;
        glsum::design::DerivativeError certified;  ///< of the filter itself
    };
    [[nodiscard]] const glsum::design::FittedFilter& filter_of(const Key& key);
    [[nodiscard]] Once& entry_of(const Key& key);
    /// Of what a kernel holds; of the fitted filter itself once for all.
    [[nodiscard]] glsum::design::DerivativeError certified_error_of(const Key& key, const Held& held);
    /// \pre `why_not(kernel)` is empty
    [[nodiscard]] const Judged& judged(const std::string& kernel, std::size_t taps);
    [[nodiscard]] Judged judge(const std::string& kernel, std::size_t taps, const Key& key);
    [[nodiscard]] Key key_of(const std::string& kernel, std::size_t taps) const;

    /// Why a rule has no filter for what a kernel holds at a length; empty where it has.
    [[nodiscard]] std::string why_no_rational(const Key& key) const;

    glsum::design::DerivativeGoal goal_;
    FilterDesign by_;
    std::mutex mutex_;
    std::map<Key, std::unique_ptr<Once>> fitted_;
    std::map<std::pair<std::string, std::size_t>, std::unique_ptr<JudgedOnce>> judged_;
};

/// "80 Hz", or "60 s" where the step's error is the larger one.
[[nodiscard]] std::string worst_place(const glsum::design::DerivativeError& error);

/// Of a kernel with a fitted filter: the certificate of what it holds, with its noise, and what running it gave, a sine
/// at nine frequencies of the band (its line's amplitude and phase, by a window of eight periods) and the whole step.
struct DerivativeReport {
    glsum::design::FittedFilter filter;
    glsum::design::DerivativeError certified;
    glsum::design::DerivativeError measured;
};
[[nodiscard]] DerivativeReport report_on(const std::string& kernel, std::size_t taps,
                                         const glsum::design::DerivativeGoal& goal,
                                         const glsum::design::FittedFilter& filter);

}  // namespace choose
