#include "docs/site/facts/facts.hpp"

#include <algorithm>
#include <variant>

#include "docs/site/facts/effects.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/timing/core_file.hpp"

namespace docs {
namespace {

using Json = nlohmann::ordered_json;

struct Figure {
    std::string key;
    std::int64_t value;
};

std::vector<Figure> figures_of(const timing::Figures& figures) {
    std::vector<Figure> all;
#define ROW(section, name) all.push_back({#section "." #name, figures.section##_##name});
#include "qemu/timing/cortex_m4/rows.def"
#include "qemu/timing/m7_rows.def"
#include "qemu/timing/rows.def"
#undef ROW
    return all;
}

Json rivals_of(const timing::CoreFile& core) {
    Json rivals = Json::array();
    const std::vector<Figure> nominal = figures_of(core.sets.front().figures);
    for (std::size_t set = 1; set < core.sets.size(); ++set) {
        Json differs = Json::array();
        const std::vector<Figure> own = figures_of(core.sets[set].figures);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (own[i].value != nominal[i].value) {
                differs.push_back({{"key", own[i].key}, {"value", own[i].value}});
            }
        }
        rivals.push_back({{"name", core.sets[set].name},
                          {"note", core.sets[set].note},
                          {"fits", core.sets[set].fits},
                          {"differs", differs}});
    }
    return rivals;
}

}  // namespace

Json families() {
    Json all = Json::array();
    for (const glsum::CatalogueEntry& kernel : glsum::catalogue) {
        if (kernel.family.word.empty()) {
            continue;
        }
        auto family = std::ranges::find_if(all, [&](const Json& one) { return one["word"] == kernel.family.word; });
        if (family == all.end()) {
            all.push_back({{"word", kernel.family.word}, {"keeps", kernel.family.keeps}, {"kernels", Json::array()}});
            family = all.end() - 1;
        }
        (*family)["kernels"].push_back({{"name", kernel.name},
                                        {"history", kernel.history},
                                        {"technique", kernel.technique},
                                        {"format", kernel.format},
                                        {"host_only", kernel.host_only},
                                        {"exact_sums", kernel.exact_sums},
                                        {"in_double", kernel.in_double},
                                        {"orders", kernel.integrator ? "integrals" : "all"}});
    }
    return all;
}

Json cores(const std::filesystem::path& folder) {
    Json all = Json::array();
    for (const std::string& name : timing::core_names(folder)) {
        const timing::CoreFile core = timing::read_core(folder, name);
        Json figures = Json::array();
        for (const timing::Origin& origin : core.origins) {
            figures.push_back({{"key", origin.key},
                               {"value", origin.value},
                               {"mark", timing::name_of(origin.mark)},
                               {"source", origin.source},
                               {"file", std::filesystem::path(origin.file).filename().string()}});
        }
        all.push_back({{"name", name},
                       {"note", core.note},
                       {"core", timing::name_of(core.core)},
                       {"code", timing::name_of(core.placement.code)},
                       {"data", timing::name_of(core.placement.data)},
                       {"figures", figures},
                       {"rivals", rivals_of(core)}});
    }
    return all;
}

Json effects() {
    Json all = Json::array();
    for (const ShownEffect& shown : shown_effects()) {
        const gap::Effect& effect = *shown.effect;
        Json parameters = Json::object();
        Json units = Json::object();
        for (const gap::Written& one : shown.numbers) {
            std::visit([&](const auto& value) { parameters[one.name] = value; }, one.value);
            units[one.name] = one.unit;
        }
        Json domains = Json::array();
        for (const gap::Domain domain : effect.domains) {
            domains.push_back(name_of(domain));
        }
        all.push_back({{"name", effect.name},
                       {"place", name_of(effect.place)},
                       {"domains", domains},
                       {"event", effect.kind == gap::Kind::event},
                       {"linear", effect.linear},
                       {"base_takes_it", effect.of_fitted_base},
                       {"moves_nothing", effect.only_spreads},
                       {"plant", shown.plant},
                       {"parameters", parameters},
                       {"units", units},
                       {"alike", shown.alike},
                       {"time_s", shown.time_s},
                       {"input", shown.input},
                       {"without", shown.without},
                       {"with", shown.with}});
    }
    return all;
}

}  // namespace docs
