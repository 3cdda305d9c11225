#include "gap/drive/shortlist.hpp"

#include <algorithm>
#include <map>

namespace gap {

void keep_finalists(std::vector<Candidate>& sets, bool beside_form) {
    constexpr std::size_t finalists = 8;
    constexpr std::size_t of_a_lead = 2;
    constexpr std::size_t eventful_ones = 2;
    if (!beside_form) {
        sets.resize(std::min(sets.size(), finalists));
        return;
    }
    std::map<std::vector<const Effect*>, std::size_t> lasting;
    std::size_t eventful = 0;
    std::erase_if(sets, [&](const Candidate& set) {
        const std::vector<const Effect*> lead(set.effects.begin(), set.effects.end() - 1);
        return set.has_events() ? ++eventful > eventful_ones : ++lasting[lead] > of_a_lead;
    });
}

std::vector<const Ranked*> leads_of(const std::vector<Ranked>& ranking, std::size_t size, bool more, bool with_steps) {
    constexpr std::size_t leads = 2;
    constexpr std::size_t more_leads = 5;
    std::vector<const Ranked*> sized;
    for (const Ranked& ranked : ranking) {
        if (ranked.trained.effects.size() == size && (with_steps || !ranked.trained.any(&Effect::rounds))) {
            sized.push_back(&ranked);
        }
    }
    std::vector<const Ranked*> by_training = sized;
    std::stable_sort(by_training.begin(), by_training.end(),
                     [](const Ranked* a, const Ranked* b) { return a->trained.cost < b->trained.cost; });
    std::vector<const Ranked*> first;
    for (const auto* list : {&sized, &by_training}) {
        for (std::size_t i = 0; i < std::min(more ? more_leads : leads, list->size()); ++i) {
            if (std::find(first.begin(), first.end(), (*list)[i]) == first.end()) {
                first.push_back((*list)[i]);
            }
        }
    }
    return first;
}

}  // namespace gap
