#include "qemu/timing/core_file.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include <toml++/toml.h>

#include "base/failure.hpp"

namespace timing {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Key {
    const char* name;
    std::int64_t Figures::*figure;
    std::optional<Core> core;  // without: of any
};
constexpr Key keys[] = {
#define ROW(section, name) {#section "." #name, &Figures::section##_##name, Core::cortex_m7},
#include "qemu/timing/m7_rows.def"
#undef ROW
#define ROW(section, name) {#section "." #name, &Figures::section##_##name, Core::cortex_m4},
#include "qemu/timing/cortex_m4/rows.def"
#undef ROW
#define ROW(section, name) {#section "." #name, &Figures::section##_##name, std::nullopt},
#include "qemu/timing/rows.def"
#undef ROW
};
struct MechanismName {
    const char* name;
    bool Mechanisms::*mechanism;
};
constexpr MechanismName mechanisms[] = {{"history_predictor", &Mechanisms::history_predictor},
                                        {"random_replacement", &Mechanisms::random_replacement},
                                        {"serial_fpu", &Mechanisms::serial_fpu}};

bool is_of(const Key& key, Core core) { return !key.core || *key.core == core; }

const Key* find_key(const std::string& name) {
    const auto* found =
        std::find_if(std::begin(keys), std::end(keys), [&](const Key& key) { return key.name == name; });
    return found == std::end(keys) ? nullptr : found;
}

std::string place(const toml::node& node) {
    return *node.source().path + ":" + std::to_string(node.source().begin.line);
}
[[noreturn]] void reject(const toml::node& node, const std::string& what) {
    throw Failure(Exit::bad_input, place(node) + ": " + what);
}

Mark mark_named(const toml::node& node, const std::string& name) {
    for (const Mark mark : {Mark::measured, Mark::documented, Mark::fitted, Mark::assumed}) {
        if (name_of(mark) == name) {
            return mark;
        }
    }
    reject(node, "expected a mark, measured, documented, fitted or assumed; found " + name);
}

std::string text_of(const toml::table& table, const char* key) {
    const toml::node* node = table.get(key);
    const auto text = node != nullptr ? node->value<std::string>() : std::nullopt;
    if (!text || text->empty()) {
        reject(table, std::string("expected ") + key + " = \"...\"");
    }
    return *text;
}

Origin read_row(const std::string& key, const toml::node& node) {
    const toml::table* row = node.as_table();
    if (row == nullptr) {
        reject(node, key + ": expected { value = N, mark = \"...\", source = \"...\" }");
    }
    for (const auto& [word, part] : *row) {
        if (word != "value" && word != "mark" && word != "source") {
            reject(part, key + ": expected value, mark and source, found " + std::string(word.str()));
        }
    }
    const toml::node* value = row->get("value");
    if (value == nullptr || !value->is_integer()) {
        reject(value != nullptr ? *value : node, key + ": expected value = a whole number");
    }
    const auto number = value->as_integer()->get();
    if (number < 0 || number > 1'000'000'000'000) {
        reject(*value, key + ": expected a number of at least 0, found " + std::to_string(number));
    }
    const std::string mark = text_of(*row, "mark");
    return {
        key, number, mark_named(*row, mark), text_of(*row, "source"), *node.source().path, node.source().begin.line};
}

// Rows of all sections of a table: "issue" = { two_loads_pair = {..} } becomes "issue.two_loads_pair".
void read_sections(const toml::table& sections, std::map<std::string, Origin>& rows) {
    for (const auto& [section, node] : sections) {
        if (section == "note" || section == "fits") {
            continue;  // of a rival set
        }
        const toml::table* table = node.as_table();
        if (table == nullptr) {
            reject(node, "expected a section of rows, found " + std::string(section.str()));
        }
        for (const auto& [name, row] : *table) {
            const std::string key = std::string(section.str()) + "." + std::string(name.str());
            if (find_key(key) == nullptr) {
                reject(row, key + ": no such row");
            }
            rows.insert_or_assign(key, read_row(key, row));
        }
    }
}

struct Rival {
    std::string note;
    bool fits = true;
    std::map<std::string, Origin> rows;
};

struct Collected {
    std::map<std::string, Origin> rows;
    std::map<std::string, Rival> rivals;
    std::optional<Placement> placement;
    Core core = Core::cortex_m7;
    std::vector<std::string> off;
    Mechanisms mechanisms;
    std::string note;
    std::string text;
};

constexpr std::size_t most_bytes = 1u << 20;

std::string read_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(most_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (in.bad() || (text.empty() && !in.eof())) {
        throw Failure(Exit::bad_input, file.string() + ": cannot read");
    }
    if (text.size() > most_bytes) {
        throw Failure(Exit::bad_input, file.string() + ": expected a core file of at most 1 MiB");
    }
    return text;
}

void read_rivals(const toml::node& node, Collected& into) {
    const toml::table* sets = node.as_table();
    if (sets == nullptr) {
        reject(node, "expected [set.NAME]");
    }
    for (const auto& [name, entry] : *sets) {
        const toml::table* set = entry.as_table();
        if (set == nullptr) {
            reject(entry, "expected [set.NAME]");
        }
        Rival rival;
        rival.note = text_of(*set, "note");
        if (const toml::node* fits = set->get("fits")) {
            if (!fits->is_boolean()) {
                reject(*fits, "fits: expected true or false");
            }
            rival.fits = fits->as_boolean()->get();
        }
        read_sections(*set, rival.rows);
        for (const auto& [key, row] : rival.rows) {
            // Memories and the predictor are the chip's: one for all sets.
            if (key.starts_with("cache.") || key.starts_with("memory.") || key.starts_with("band.") ||
                key.starts_with("measurement.") || key == "fetch.bytes" || key == "branch.target_entries" ||
                key == "branch.return_entries") {
                throw Failure(Exit::bad_input, row.file + ":" + std::to_string(row.line) + ": " + key +
                                                   ": no row that a rival set may change");
            }
        }
        into.rivals.insert_or_assign(std::string(name.str()), std::move(rival));
    }
}

void read_mechanisms(const toml::node& node, Mechanisms& into) {
    const toml::array* names = node.as_array();
    if (names == nullptr) {
        reject(node, "expected mechanisms = [\"..\"]");
    }
    for (const toml::node& one : *names) {
        const std::string name = one.value_or(std::string("?"));
        const auto* const found = std::find_if(std::begin(mechanisms), std::end(mechanisms),
                                               [&](const MechanismName& known) { return known.name == name; });
        if (found == std::end(mechanisms)) {
            reject(one, "mechanisms: no such mechanism: " + name);
        }
        into.*found->mechanism = true;
    }
}

void collect(const std::filesystem::path& file, const std::filesystem::path& folder,
             std::set<std::filesystem::path>& seen, Collected& into) {
    if (!seen.insert(std::filesystem::weakly_canonical(file)).second) {
        throw Failure(Exit::bad_input, file.string() + ": is based on itself");
    }
    const std::string text = read_text(file);
    toml::table table;
    try {
        table = toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        throw Failure(Exit::bad_input, file.string() + ":" + std::to_string(error.source().begin.line) + ": " +
                                           std::string(error.description()));
    }
    into.text += text;
    if (const toml::node* base = table.get("base")) {
        const std::string base_name = base->value<std::string>().value_or("") + ".toml";
        const std::filesystem::path beside = file.parent_path() / base_name;
        const std::filesystem::path found = std::filesystem::exists(beside) ? beside : folder / base_name;
        if (!base->is_string() || !std::filesystem::exists(found)) {
            reject(*base, "base: no such core file in " + folder.string());
        }
        collect(found, folder, seen, into);
    }
    for (const auto& [key, node] : table) {
        const std::string word(key.str());
        if (word == "base") {
            continue;
        }
        if (word == "core") {
            const std::string name = text_of(table, "core");
            if (name != name_of(Core::cortex_m7) && name != name_of(Core::cortex_m4)) {
                reject(node, "core: expected cortex-m7 or cortex-m4, found " + name);
            }
            into.core = name == name_of(Core::cortex_m4) ? Core::cortex_m4 : Core::cortex_m7;
        } else if (word == "note") {
            into.note = text_of(table, "note");
        } else if (word == "placement") {
            const toml::table* placement = node.as_table();
            if (placement == nullptr) {
                reject(node, "expected placement = { code = \"..\", data = \"..\" }");
            }
            into.placement = {
                code_place_named(text_of(*placement, "code")), data_place_named(text_of(*placement, "data")), {}};
        } else if (word == "effects_off") {
            const toml::array* names = node.as_array();
            if (names == nullptr) {
                reject(node, "expected effects_off = [\"..\"]");
            }
            for (const toml::node& one : *names) {
                CoreFile any;
                into.off.push_back(one.value_or(std::string("?")));
                if (!switch_off(any, into.off.back())) {
                    reject(one, "effects_off: no such effect: " + into.off.back());
                }
            }
        } else if (word == "mechanisms") {
            read_mechanisms(node, into.mechanisms);
        } else if (word == "rows") {
            if (node.as_table() == nullptr) {
                reject(node, "expected [rows.SECTION]");
            }
            read_sections(*node.as_table(), into.rows);
        } else if (word == "set") {
            read_rivals(node, into);
        } else {
            reject(node,
                   word + ": no such key; expected base, core, note, placement, effects_off, mechanisms, rows, set");
        }
    }
}

void check_rows_are_of(Core core, const std::map<std::string, Origin>& rows) {
    for (const auto& [name, row] : rows) {
        if (!is_of(*find_key(name), core)) {
            throw Failure(Exit::bad_input,
                          row.file + ":" + std::to_string(row.line) + ": " + name + ": no row of a " + name_of(core));
        }
    }
}

}  // namespace

CodePlace code_place_named(const std::string& name) {
    if (name == "itcm" || name == "flash" || name == "axi") {
        return name == "itcm" ? CodePlace::itcm : name == "flash" ? CodePlace::flash : CodePlace::axi;
    }
    throw Failure(Exit::bad_input, "code: expected itcm, flash or axi, found " + name);
}
DataPlace data_place_named(const std::string& name) {
    if (name == "dtcm" || name == "axi") {
        return name == "dtcm" ? DataPlace::dtcm : DataPlace::axi;
    }
    throw Failure(Exit::bad_input, "data: expected dtcm or axi, found " + name);
}
Place place_named(const std::string& name) {
    for (const Place place : {Place::itcm, Place::dtcm, Place::flash, Place::axi}) {
        if (name_of(place) == name) {
            return place;
        }
    }
    throw Failure(Exit::bad_input, "place: expected itcm, dtcm, flash or axi, found " + name);
}
std::string name_of(Mark mark) {
    return mark == Mark::measured     ? "measured"
           : mark == Mark::documented ? "documented"
           : mark == Mark::fitted     ? "fitted"
                                      : "assumed";
}
std::string name_of(Core core) { return core == Core::cortex_m4 ? "cortex-m4" : "cortex-m7"; }
std::string name_of(Place place) {
    return place == Place::itcm ? "itcm" : place == Place::dtcm ? "dtcm" : place == Place::flash ? "flash" : "axi";
}
std::string name_of(CodePlace place) {
    return place == CodePlace::itcm ? "itcm" : place == CodePlace::flash ? "flash" : "axi";
}
std::string name_of(DataPlace place) { return place == DataPlace::dtcm ? "dtcm" : "axi"; }

std::vector<std::string> mechanism_names() {
    std::vector<std::string> names;
    for (const MechanismName& known : mechanisms) {
        names.emplace_back(known.name);
    }
    return names;
}

std::vector<std::string> core_names(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() == ".toml" && !stem.starts_with("_")) {
            names.push_back(stem);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool switch_off(CoreFile& core, std::string_view effect) {
    if (const auto of_core = effect_named(effect)) {
        core.off.set(index(*of_core));
    } else if (effect == double_in_software) {
        core.double_in_software_off = true;
    } else if (std::find(effects_beside_a_call.begin(), effects_beside_a_call.end(), effect) ==
               effects_beside_a_call.end()) {
        return false;
    }
    for (RuleSet& set : core.sets) {
        if (effect == "call_overhead") {
            set.figures.measurement_counter_reads = 0;
        } else if (effect == "cache_maintenance") {
            set.figures.measurement_maintenance = 0;
        }
    }
    return true;
}

CoreFile read_core(const std::filesystem::path& folder, const std::string& name) {
    const std::filesystem::path file = folder / (name + ".toml");
    if (!std::filesystem::exists(file) || name.starts_with("_")) {
        std::string known;
        for (const std::string& one : core_names(folder)) {
            known += " " + one;
        }
        throw Failure(Exit::bad_input, name + ": no such core in " + folder.string() + "; expected one of" + known);
    }
    return read_core_file(file, folder);
}

bool names_core_file(const std::string& core) { return core.find('/') != std::string::npos || core.ends_with(".toml"); }

CoreFile read_named_core(const std::filesystem::path& folder, const std::string& core) {
    return names_core_file(core) ? read_core_file(core, folder) : read_core(folder, core);
}

CoreFile read_core_file(const std::filesystem::path& file, const std::filesystem::path& folder) {
    if (!std::filesystem::is_regular_file(file)) {
        throw Failure(Exit::bad_input, file.string() + ": no such core file");
    }
    Collected collected;
    std::set<std::filesystem::path> seen;
    collect(file, folder, seen, collected);
    CoreFile core;
    core.name = file.stem().string();
    core.note = collected.note;
    core.text = collected.text;
    if (!collected.placement) {
        throw Failure(Exit::bad_input, file.string() + ": expected placement = { code = \"..\", data = \"..\" }");
    }
    core.placement = *collected.placement;
    core.core = collected.core;
    check_rows_are_of(core.core, collected.rows);
    core.sets.push_back({"nominal", "", {}, true});
    for (const Key& key : keys) {
        if (!is_of(key, core.core)) {
            continue;
        }
        const auto row = collected.rows.find(key.name);
        if (row == collected.rows.end()) {
            throw Failure(Exit::bad_input, file.string() + ": expected the row " + key.name);
        }
        const std::string name_of_row = key.name;
        const bool is_width = name_of_row.ends_with("_bytes") || name_of_row == "fetch.bytes";
        const auto value = static_cast<std::uint64_t>(row->second.value);
        if (is_width && (value & (value - 1)) != 0) {
            throw Failure(Exit::bad_input, row->second.file + ":" + std::to_string(row->second.line) + ": " + key.name +
                                               ": expected a power of two, found " + std::to_string(value));
        }
        core.sets[0].figures.*key.figure = row->second.value;
        core.origins.push_back(row->second);
    }
    core.sets[0].figures.mechanisms = collected.mechanisms;
    for (const auto& [rival_name, rival] : collected.rivals) {
        check_rows_are_of(core.core, rival.rows);
        RuleSet set{rival_name, rival.note, core.sets[0].figures, rival.fits};
        for (const auto& [key, row] : rival.rows) {
            set.figures.*find_key(key)->figure = row.value;
        }
        core.sets.push_back(set);
    }
    if (core.sets.size() > CoreFile::most_sets) {
        throw Failure(Exit::bad_input, file.string() + ": expected at most " + std::to_string(CoreFile::most_sets - 1) +
                                           " rival sets, found " + std::to_string(core.sets.size() - 1));
    }
    for (const std::string& effect : collected.off) {
        (void)switch_off(core, effect);  // known: checked where it was read
    }
    return core;
}

}  // namespace timing
