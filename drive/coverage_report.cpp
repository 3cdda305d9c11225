#include "drive/coverage_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "drive/model_file.hpp"

namespace drive {

std::string to_text(const Coverage& found, const Model& truth, const Acquisition& acquisition) {
    std::string text = fmt::format(
        "{} logs of {}: {} for {} s, {} s +- {} s, noise {}, steps of {}\n{:<16} {:>12} {:>12} {:>12} {:>12} {:>8}\n",
        found.runs, to_text(truth), acquisition.excitation.name, acquisition.until_s, acquisition.interval_s,
        acquisition.jitter_s, acquisition.noise, acquisition.quantum, "parameter", "truth", "mean", "spread", "claimed",
        "inside");
    for (std::size_t i = 0; i < found.names.size(); ++i) {
        text += fmt::format("{:<16} {:>12.6g} {:>12.6g} {:>12.3g} {:>12.3g} {:>8}\n", found.names[i], found.truth[i],
                            found.mean[i], found.spread[i], found.claimed[i],
                            fmt::format("{}/{}", found.inside[i], found.runs));
    }
    return text + fmt::format("{:<16} {:>12} {:>12} {:>12} {:>12} {:>8}\n", "all at once", "", "", "", "",
                              fmt::format("{}/{}", found.jointly_inside, found.runs));
}

std::string to_json(const Coverage& found, const std::string& model, const std::string& form) {
    using Json = nlohmann::ordered_json;
    Json json{{"model", model}, {"form", form}, {"runs", found.runs}, {"failed", found.failed}};
    json["parameters"] = Json::array();
    for (std::size_t i = 0; i < found.names.size(); ++i) {
        json["parameters"].push_back({{"name", found.names[i]},
                                      {"truth", found.truth[i]},
                                      {"inside", found.inside[i]},
                                      {"mean", found.mean[i]},
                                      {"spread", found.spread[i]},
                                      {"claimed", found.claimed[i]}});
    }
    json["jointly_inside"] = found.jointly_inside;
    return json.dump(2) + "\n";
}

bool holds(const Coverage& found) {
    return found.failed == 0 && std::all_of(found.inside.begin(), found.inside.end(), [&](std::size_t inside) {
               const double share = static_cast<double>(inside) / static_cast<double>(found.runs);
               return share >= 0.90 && share <= 0.995;
           });
}

}  // namespace drive
