#include "bench/gate/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "bench/rows/key.hpp"
#include "bench/rows/target_fields.hpp"

namespace bench::gate {
namespace {

// To which rows a field matters. A machine's own fields and its cores' files matter to its rows alone.
enum class Matters { always, to_machine, to_target, to_model, to_host };

struct Field {
    std::string_view name;
    Matters matters;
    Effect effect;
};

// Versions, commits, dates and hashes of programs are no conditions: that they changed is why someone compares.
constexpr Field fields[] = {
    {"schema", Matters::always, Effect::incomparable},
    {"compiler", Matters::always, Effect::incomparable},
    {"flags", Matters::always, Effect::incomparable},
    {"contraction", Matters::always, Effect::incomparable},
    {"n_samples", Matters::always, Effect::incomparable},
    {"seed", Matters::always, Effect::incomparable},
    {"weights", Matters::always, Effect::incomparable},
    {"target_compiler", Matters::to_machine, Effect::incomparable},
    {"target_flags", Matters::to_machine, Effect::incomparable},
    {"target_count_order", Matters::to_target, Effect::incomparable},
    {"placement", Matters::to_target, Effect::incomparable},
    // With its hash, under whatever key that begins so.
    {"core_file", Matters::to_model, Effect::incomparable},
    {"cpu", Matters::to_host, Effect::advisory},
    {"cycle_counter", Matters::to_host, Effect::advisory},
    {"simd", Matters::to_host, Effect::advisory},
    {"peer_flags", Matters::to_host, Effect::advisory},
    // Which instructions an architecture executes is not the emulator's choice; a fault of one version would be.
    {"qemu_version", Matters::to_target, Effect::note},
};

// What rows are of: of a target's, the machine too.
struct Aspect {
    Kind kind;
    const base::Machine* machine;  // null: of none
    auto operator<=>(const Aspect&) const = default;
};

std::set<Aspect> aspects_of(const std::vector<std::string>& rows) {
    std::set<Aspect> aspects;
    for (const std::string& row : rows) {
        const auto key = parse_any_key(row);
        aspects.insert({kind_of(row), key ? key->machine() : nullptr});
    }
    return aspects;
}

// The machines of which both runs have rows of one of the kinds.
std::vector<const base::Machine*> machines_of(const std::set<Aspect>& common, const std::set<Kind>& kinds) {
    std::vector<const base::Machine*> machines;
    for (const base::Machine& machine : base::machines) {
        if (std::any_of(kinds.begin(), kinds.end(), [&](Kind kind) { return common.contains({kind, &machine}); })) {
            machines.push_back(&machine);
        }
    }
    return machines;
}

// The names of cores that either run has rows of, with their machines.
std::map<std::string, const base::Machine*> modelled_cores(const Side& baseline, const Side& current) {
    std::map<std::string, const base::Machine*> cores;
    for (const Side* side : {&baseline, &current}) {
        for (const std::string& row : side->rows) {
            if (kind_of(row) == Kind::target_model) {
                const auto key = parse_any_key(row);
                cores[key->core()] = key->machine();
            }
        }
    }
    return cores;
}

std::string text_of(const Json& context, const std::string& key) {
    const auto found = context.find(key);
    if (found == context.end()) {
        // Files older than the field are of the only weights that there were.
        return key == "weights" ? "gl" : "(absent)";
    }
    return found->is_string() ? found->get<std::string>() : found->dump();
}

// "NAME sha256:HASH, ...": each entry by its name.
std::map<std::string, std::string> core_entries(const std::string& list) {
    std::map<std::string, std::string> by_name;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(", ", at), list.size());
        const std::string entry = list.substr(at, end - at);
        by_name[entry.substr(0, entry.find(' '))] = entry;
        at = end + 2;
    }
    return by_name;
}

// The cores that both runs modelled, as one of them has them. Where they share none, or a file says it otherwise, the
// whole text.
std::string shared_cores(const std::string& text, const std::string& other) {
    const auto others = core_entries(other);
    std::string shared;
    for (const auto& [name, entry] : core_entries(text)) {
        if (others.contains(name)) {
            shared += (shared.empty() ? "" : ", ") + entry;
        }
    }
    return shared.empty() ? text : shared;
}

// Without the cores that are known as another machine's.
std::string cores_on(const base::Machine& machine, const std::map<std::string, const base::Machine*>& known,
                     const std::string& text) {
    std::string here;
    for (const auto& [name, entry] : core_entries(text)) {
        const auto found = known.find(name);
        if (found == known.end() || found->second == &machine) {
            here += (here.empty() ? "" : ", ") + entry;
        }
    }
    return here;
}

// The keys of a field in either context that begin with its name.
std::set<std::string> keys_of(const Field& field, const Json& baseline, const Json& current) {
    std::set<std::string> keys{std::string(field.name)};
    for (const Json* context : {&baseline, &current}) {
        for (const auto& [key, value] : context->items()) {
            if (key.starts_with(field.name)) {
                keys.insert(key);
            }
        }
    }
    return keys;
}

class Differences {
public:
    Differences(const Side& baseline, const Side& current) : baseline_(baseline), current_(current) {
        const std::set<Aspect> ours = aspects_of(baseline.rows);
        const std::set<Aspect> theirs = aspects_of(current.rows);
        std::set_intersection(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                              std::inserter(common_, common_.end()));
    }

    std::vector<Difference> all() {
        for (const Field& field : fields) {
            add(field);
        }
        return found_;
    }

private:
    void add(const Field& field) {
        const std::set<Kind> of_target{Kind::target_count, Kind::target_model};
        const std::string name(field.name);
        switch (field.matters) {
            case Matters::always:
                add(field, name, text_of(baseline_.context, name), text_of(current_.context, name));
                break;
            case Matters::to_machine:
                for (const base::Machine* machine : machines_of(common_, of_target)) {
                    const std::string was = target_field_in(baseline_.context, name, *machine);
                    const std::string is = target_field_in(current_.context, name, *machine);
                    add(field, std::max(was, is, [](const auto& a, const auto& b) { return a.size() < b.size(); }),
                        text_of(baseline_.context, was), text_of(current_.context, is));
                }
                break;
            case Matters::to_target:
                if (!machines_of(common_, of_target).empty()) {
                    add(field, name, text_of(baseline_.context, name), text_of(current_.context, name));
                }
                break;
            case Matters::to_model:
                add_cores(field);
                break;
            case Matters::to_host:
                if (common_.contains({Kind::host, nullptr})) {
                    add(field, name, text_of(baseline_.context, name), text_of(current_.context, name));
                }
                break;
        }
    }

    // Of a core that only one run has there are no rows to compare.
    void add_cores(const Field& field) {
        const auto known = modelled_cores(baseline_, current_);
        for (const base::Machine* machine : machines_of(common_, {Kind::target_model})) {
            for (const std::string& key : keys_of(field, baseline_.context, current_.context)) {
                const std::string was = cores_on(*machine, known, text_of(baseline_.context, key));
                const std::string is = cores_on(*machine, known, text_of(current_.context, key));
                add(field, key, shared_cores(was, is), shared_cores(is, was));
            }
        }
    }

    void add(const Field& field, const std::string& key, const std::string& was, const std::string& is) {
        const bool told = std::any_of(found_.begin(), found_.end(), [&](const Difference& one) {
            return one.field == key && one.baseline == was && one.current == is;
        });
        if (was != is && !told) {
            found_.push_back({key, was, is, field.effect});
        }
    }

    const Side& baseline_;
    const Side& current_;
    std::set<Aspect> common_;
    std::vector<Difference> found_;
};

}  // namespace

std::vector<Difference> differences(const Side& baseline, const Side& current) {
    return Differences(baseline, current).all();
}

std::string incomparable(const std::vector<Difference>& differences, const std::string& first,
                         const std::string& second) {
    std::string text;
    for (const Difference& difference : differences) {
        if (difference.effect == Effect::incomparable) {
            text +=
                fmt::format("{}{}: {} in {}, {} {}", text.empty() ? "" : "; ", difference.field, difference.baseline,
                            first, difference.current, second == "now" ? second : "in " + second);
        }
    }
    return text;
}

bool has_effect(const std::vector<Difference>& differences, Effect effect) {
    return std::any_of(differences.begin(), differences.end(),
                       [&](const Difference& difference) { return difference.effect == effect; });
}

}  // namespace bench::gate
