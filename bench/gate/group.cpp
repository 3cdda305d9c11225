#include "bench/gate/group.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "bench/gate/percent.hpp"
#include "bench/rows/key.hpp"

namespace bench::gate {
namespace {

// What a finding shares with others of its kernel.
std::string shared_by(const Finding& finding) {
    const auto key = parse_any_key(finding.row);
    return key ? fmt::format("{} {} {}", key->model, key->kernel, key->aspect) : finding.row;
}

struct RegistryLine {
    std::string_view kernel;
    int line;
};

constexpr RegistryLine registry_lines[] = {
#define GLSUM_KERNEL(published, history, technique, format) {#published, __LINE__},
#define GLSUM_HOST_KERNEL GLSUM_KERNEL
#include "glsum/registry.def"
#undef GLSUM_KERNEL
#undef GLSUM_HOST_KERNEL
};

}  // namespace

std::string FindingGroup::rows() const {
    if (findings.size() == 1) {
        return first().row;
    }
    const auto key = parse_any_key(first().row);
    if (!key) {
        return first().row;
    }
    std::string words;
    for (const std::string& part : {key->model, key->kernel, key->aspect}) {
        words += part.empty() ? "" : (words.empty() ? "" : " ") + part;
    }
    return words;
}

std::string FindingGroup::subject() const { return first().counter.empty() ? rows() : rows() + " " + first().counter; }

std::string FindingGroup::what() const {
    if (findings.size() == 1) {
        return first().what;
    }
    const bool told = std::all_of(findings.begin(), findings.end(),
                                  [](const Finding* finding) { return finding->change.has_value(); });
    if (!told) {
        return fmt::format("in {} rows, the first {}: {}", findings.size(), first().row, first().what);
    }
    const auto [least, most] = std::minmax_element(
        findings.begin(), findings.end(), [](const Finding* a, const Finding* b) { return *a->change < *b->change; });
    const std::string from = percent(*(*least)->change, 2);
    const std::string to = percent(*(*most)->change, 2);
    return from == to ? fmt::format("{} in {} rows", to, findings.size())
                      : fmt::format("{} to {} in {} rows", from, to, findings.size());
}

std::vector<FindingGroup> groups_of(const Verdict& verdict, Level level) {
    std::vector<FindingGroup> groups;
    std::map<std::string, std::size_t> at;
    for (const Finding& finding : verdict.findings) {
        if (finding.level != level) {
            continue;
        }
        const auto [found, is_new] = at.try_emplace(
            fmt::format("{}\n{}\n{}", name_of(finding.layer), shared_by(finding), finding.counter), groups.size());
        if (is_new) {
            groups.emplace_back();
        }
        groups[found->second].findings.push_back(&finding);
    }
    return groups;
}

Place place_of(const std::string& row) {
    const auto key = parse_any_key(row);
    std::string kernel = key ? key->kernel : row;
    if (!key && row.starts_with("gl/") && row.ends_with("/*")) {
        kernel = row.substr(3, row.size() - 5);
    }
    for (const RegistryLine& one : registry_lines) {
        if (one.kernel == kernel) {
            return {"kernels/glsum/registry.def", one.line};
        }
    }
    return {};
}

}  // namespace bench::gate
