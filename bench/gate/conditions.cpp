#include "bench/gate/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

namespace bench::gate {
namespace {

// To which rows a field matters.
enum class Matters { always, to_target, to_model, to_host };

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
    {"target_compiler", Matters::to_target, Effect::incomparable},
    {"target_flags", Matters::to_target, Effect::incomparable},
    // Of a second machine in the same run.
    {"m4_target_compiler", Matters::to_target, Effect::incomparable},
    {"m4_target_flags", Matters::to_target, Effect::incomparable},
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

bool matters(Matters to, const std::vector<Kind>& kinds) {
    const auto has = [&](Kind kind) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); };
    switch (to) {
        case Matters::always:
            return true;
        case Matters::to_target:
            return has(Kind::target_count) || has(Kind::target_model);
        case Matters::to_model:
            return has(Kind::target_model);
        case Matters::to_host:
            return has(Kind::host);
    }
    return true;
}

std::string text_of(const Json& context, const std::string& key) {
    const auto found = context.find(key);
    if (found == context.end()) {
        // Files older than the field are of the only weights that there were.
        return key == "weights" ? "gl" : "(absent)";
    }
    return found->is_string() ? found->get<std::string>() : found->dump();
}

// "NAME sha256:HASH, ...": the cores that both runs modelled, as one of them has them. Where they share none, or a file
// says it otherwise, the whole text.
std::string shared_cores(const std::string& text, const std::string& other) {
    const auto entries = [](const std::string& list) {
        std::map<std::string, std::string> by_name;
        for (std::size_t at = 0; at <= list.size();) {
            const std::size_t end = std::min(list.find(", ", at), list.size());
            const std::string entry = list.substr(at, end - at);
            by_name[entry.substr(0, entry.find(' '))] = entry;
            at = end + 2;
        }
        return by_name;
    };
    const auto others = entries(other);
    std::string shared;
    for (const auto& [name, entry] : entries(text)) {
        if (others.contains(name)) {
            shared += (shared.empty() ? "" : ", ") + entry;
        }
    }
    return shared.empty() ? text : shared;
}

// The keys of a field in either context: itself, or for the core file all that begin with its name.
std::vector<std::string> keys_of(const Field& field, const Json& baseline, const Json& current) {
    std::vector<std::string> keys{std::string(field.name)};
    if (field.matters == Matters::to_model) {
        for (const Json* context : {&baseline, &current}) {
            for (const auto& [key, value] : context->items()) {
                if (key.starts_with(field.name) && std::find(keys.begin(), keys.end(), key) == keys.end()) {
                    keys.push_back(key);
                }
            }
        }
    }
    return keys;
}

}  // namespace

std::vector<Difference> differences(const Json& baseline, const Json& current, const std::vector<Kind>& kinds) {
    std::vector<Difference> found;
    for (const Field& field : fields) {
        if (!matters(field.matters, kinds)) {
            continue;
        }
        for (const std::string& key : keys_of(field, baseline, current)) {
            std::string was = text_of(baseline, key);
            std::string is = text_of(current, key);
            if (field.matters == Matters::to_model) {
                // Of a core that only one run has there are no rows to compare.
                std::tie(was, is) = std::pair(shared_cores(was, is), shared_cores(is, was));
            }
            if (was != is) {
                found.push_back({key, was, is, field.effect});
            }
        }
    }
    return found;
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
