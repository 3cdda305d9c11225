#include "bench/gate/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bench::gate {

std::string_view name_of(Level level) {
    switch (level) {
        case Level::fail:
            return "fail";
        case Level::warn:
            return "warn";
        case Level::improvement:
            return "improvement";
        case Level::note:
            return "note";
    }
    return "";
}

std::size_t Verdict::with(Level level) const {
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                  [&](const Finding& finding) { return finding.level == level; }));
}

std::string Verdict::word() const {
    switch (status) {
        case glsum::Exit::good:
            return "pass";
        case glsum::Exit::check_failed:
            return "fail";
        case glsum::Exit::not_comparable:
            return "not comparable";
        case glsum::Exit::bad_input:
        case glsum::Exit::missing:
            break;
    }
    return "refused";
}

std::string Verdict::headline() const {
    if (!refusal.empty()) {
        return refusal;
    }
    if (status == glsum::Exit::not_comparable) {
        return incomparable(differences);
    }
    const auto first = std::find_if(findings.begin(), findings.end(),
                                    [](const Finding& finding) { return finding.level == Level::fail; });
    if (first != findings.end()) {
        return fmt::format("{}: {}{}{}: {}", name_of(first->layer), first->row, first->counter.empty() ? "" : " ",
                           first->counter, first->what);
    }
    std::size_t compared = 0;
    for (const LayerCount& layer : layer_counts) {
        compared += layer.compared;
    }
    return fmt::format("{} values of {} rows are within what the rules allow{}", compared, rows.size(), besides());
}

std::string Verdict::besides() const { return not_judged.empty() ? "" : "; not judged: " + not_judged; }

std::string way_on(const Verdict& verdict) {
    const bool other_core = std::any_of(verdict.differences.begin(), verdict.differences.end(),
                                        [](const auto& one) { return one.field.starts_with("core_file"); });
    return !other_core
               ? ""
               : "; to go on: model the baseline's commit with this core file, and hold this run against that; or "
                 "record this run by --update-baseline --reason TEXT";
}

}  // namespace bench::gate
