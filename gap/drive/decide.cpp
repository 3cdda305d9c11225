#include "gap/drive/decide.hpp"

#include "gap/drive/decide/rule.hpp"

namespace gap {

Decision decide(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study,
                const Study& validation, bool same_records) {
    const Evidence evidence(ranking, whitener, study, validation, same_records);
    Decision decision;
    for (const Rule& rule : rules()) {
        rule.apply(evidence, decision);
    }
    return decision;
}

}  // namespace gap
