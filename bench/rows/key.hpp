// What a row is of: its name taken apart, and put together. The only place that knows how names are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/machines.hpp"

namespace bench {

/// What is measured in a row; each kind has a name of its own form, which begins with the kind's word.
enum class RowKind {
    sum,         ///< gl/<kernel>/order:<v>/taps:<L>/<aspect>[/signal:<s>[/amplitude:<a>]]
    model,       ///< drive/<model>/<kernel>/taps:<L>/<aspect>
    record,      ///< record/<kernel>/order:<v>/samples:<N>/<aspect>
    horizon,     ///< horizon/<kernel>/order:<v>/error:<e>/samples:<N>[/<aspect of a target>]
    filter,      ///< filter/<kernel>/order:<v>/poles:<P>/<aspect>/signal:<s>
    band,        ///< band/<kernel>/order:<v>/taps:<L>/hz:<low>..<high>
    derivative,  ///< derivative/<kernel>/order:<v>/taps:<L>/<aspect>[/hz:<low>..<high>][/until:<s>]
};

/// The parts of a name, as they are written in it; those that its kind has not are empty.
struct RowKey {
    RowKind kind = RowKind::sum;
    std::string model;
    std::string kernel;  ///< or what else sums
    std::string order;
    std::string taps;  ///< "600", "full", "2+7"
    std::string error;
    std::string samples;
    std::string poles;
    std::string hz;      ///< "0.05..80"
    std::string until;   ///< of a step, in seconds
    std::string aspect;  ///< accuracy, host, m7:<core>, m4:<core>
    std::string signal;
    std::string amplitude;  ///< empty: 1

    [[nodiscard]] bool is_accuracy() const { return aspect == accuracy; }
    [[nodiscard]] bool is_host() const { return aspect == host; }
    [[nodiscard]] bool is_target() const { return machine() != nullptr; }
    /// Of a target's row: the emulated machine that it is of; null of all others.
    [[nodiscard]] const base::Machine* machine() const {
        const std::size_t end = aspect.find(':');
        return end == aspect.npos ? nullptr : base::machine_called(std::string_view(aspect).substr(0, end));
    }
    /// Of a target's row: the core's name, or `count_only`.
    [[nodiscard]] std::string core() const { return aspect.substr(aspect.find(':') + 1); }

    static constexpr std::string_view accuracy = "accuracy";
    static constexpr std::string_view host = "host";
};

/// In place of a core's name: no timing model, only what the emulator counts.
inline constexpr const char* count_only = "count";

/// "m7:<core>", "m4:<core>"
[[nodiscard]] std::string on_target(const base::Machine& machine, const std::string& core);

[[nodiscard]] std::string to_name(const RowKey& key);

/// Of a name of any kind. Empty for another program's, and for one whose parts are not what ours are: words of letters
/// and digits, numbers, lengths, and nothing more behind them.
[[nodiscard]] std::optional<RowKey> parse_any_key(std::string_view name);

/// The same of a sum's row alone: what tables, fronts and choices are made of.
[[nodiscard]] std::optional<RowKey> parse_key(std::string_view name);

/// The word of a kernel's number format: the catalogue's, which alone knows; "unknown" of a kernel that is not there,
/// such as another program's or another version's.
[[nodiscard]] std::string number_format_of(const std::string& kernel);

/// "gl/<kernel>/order:<v>/taps:<L>": what all rows of a kernel, order and length share.
[[nodiscard]] std::string subject_of(const RowKey& key);

/// A glob of all of a kernel's rows of sums.
[[nodiscard]] std::string rows_of(const std::string& kernel);

/// Whether a length of a name is a window's ("600", "full"), not one of near taps with modes or blocks ("2+7").
[[nodiscard]] bool is_window(std::string_view taps);

/// The length of "<near>[+<modes>]": how many terms its sum has. Nothing for `full`, whose length the name does not
/// tell, and for what is no length.
[[nodiscard]] std::optional<double> taps_number(const std::string& taps);

}  // namespace bench
