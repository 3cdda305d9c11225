// Core files: every figure of a modelled core, with its source and how far it may be trusted.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "qemu/timing/effects.hpp"

namespace timing {

/// Mechanisms that the core does not have as far as anybody knows: of cores that differ by more than numbers, whose
/// cycles the diagnosis is tried on. A core file names them in `mechanisms`; none of the folder's does.
struct Mechanisms {
    bool history_predictor = false;   ///< directions by 4096 counters, chosen by the last eight of them (predictor.hpp)
    bool random_replacement = false;  ///< of a cache's line, instead of the one used longest ago
    bool serial_fpu = false;          ///< arithmetic waits for the result of the arithmetic before
};
/// The words of `mechanisms`.
[[nodiscard]] std::vector<std::string> mechanism_names();

/// The figures of all cores, named <section>_<name> as in the rows; a core file has those of its own.
struct Figures {
#define ROW(section, name) std::int64_t section##_##name = 0;
#include "qemu/timing/cortex_m4/rows.def"
#include "qemu/timing/m7_rows.def"
#include "qemu/timing/rows.def"
#undef ROW
    Mechanisms mechanisms;
};

/// Which model a core file has figures for.
enum class Core : std::uint8_t { cortex_m7, cortex_m4 };
[[nodiscard]] std::string name_of(Core core);

/// How a figure is known.
enum class Mark : std::uint8_t {
    measured,    ///< read on silicon by the named author
    documented,  ///< in a manual or in another's model of the core
    fitted,      ///< chosen so that the model meets the named measured rows
    assumed,     ///< nothing says so; chosen as plausible
};

[[nodiscard]] std::string name_of(Mark mark);

/// A figure's origin.
struct Origin {
    std::string key;  ///< "section.name"
    std::int64_t value;
    Mark mark;
    std::string source;
    std::string file;
    unsigned line;
};

enum class CodePlace : std::uint8_t { itcm, flash, axi };
enum class DataPlace : std::uint8_t { dtcm, axi };

enum class Place : std::uint8_t { itcm, dtcm, flash, axi };
/// Addresses that lie elsewhere than their neighbours, code or data.
struct PlacedRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;  ///< behind its last byte
    Place place = Place::itcm;
};

struct Placement {
    CodePlace code = CodePlace::itcm;
    DataPlace data = DataPlace::dtcm;
    std::vector<PlacedRange> ranges = {};  ///< of two that overlap the later one holds
};
/// \throws glsum::Failure (bad input) for other words than the contract's
[[nodiscard]] CodePlace code_place_named(const std::string& name);
[[nodiscard]] DataPlace data_place_named(const std::string& name);
[[nodiscard]] Place place_named(const std::string& name);
[[nodiscard]] std::string name_of(CodePlace place);
[[nodiscard]] std::string name_of(DataPlace place);
[[nodiscard]] std::string name_of(Place place);

using Effects = std::bitset<effect_count>;

/// One set of rules: the nominal one, or a rival that fits silicon as well.
struct RuleSet {
    std::string name;  ///< "nominal", or the rival's
    std::string note;
    Figures figures;
    bool fits = true;  ///< silicon; false: refuted, kept to tell how much of a figure is fitted
};

struct CoreFile {
    static constexpr std::size_t most_sets = 8;
    std::string name;
    std::string note;
    Core core = Core::cortex_m7;
    Placement placement;
    Effects off;  ///< effects that cost nothing in this core
    bool double_in_software_off = false;
    std::vector<RuleSet> sets;    ///< the nominal one first
    std::vector<Origin> origins;  ///< of the nominal set, in the order of the rows
    std::string text;             ///< of all files that it was read from, for its hash
};

/// Reads `<folder>/<name>.toml`, and what it is based on.
/// \throws glsum::Failure: bad input, with file and line, for a damaged file, a missing or unknown key, an effect that
///         does not exist; missing (with the names that exist) when there is no such core
[[nodiscard]] CoreFile read_core(const std::filesystem::path& folder, const std::string& name);

/// The same of a file anywhere, named after it. What it is based on lies beside it or in `folder`.
/// \throws glsum::Failure (bad input) likewise, and when there is no such file
[[nodiscard]] CoreFile read_core_file(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Whether somebody who is asked for a core has named a file: it has a slash, or ends as core files do.
[[nodiscard]] bool names_core_file(const std::string& core);
/// What they mean: one of the folder's, or the file. \throws glsum::Failure as `read_core` and `read_core_file`
[[nodiscard]] CoreFile read_named_core(const std::filesystem::path& folder, const std::string& core);

/// Makes an effect cost nothing, one of the contract's: of the core, of double precision in software, of the
/// measurement. \return false when there is none of that name
[[nodiscard]] bool switch_off(CoreFile& core, std::string_view effect);

/// The cores that a folder holds, sorted. Files that begin with an underscore are only for others to be based on.
[[nodiscard]] std::vector<std::string> core_names(const std::filesystem::path& folder);

}  // namespace timing
