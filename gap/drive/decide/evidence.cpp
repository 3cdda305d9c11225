#include "gap/drive/decide/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/determined.hpp"

namespace gap {
namespace {

std::vector<Remainder> remainders(const Study& study, const std::vector<std::vector<double>>& residuals) {
    std::vector<Remainder> all;
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        Remainder one{&study.courses[r].record(), study.courses[r].record().output, residuals[r], study.counts[r]};
        for (std::size_t i = 0; i < one.simulated.size(); ++i) {
            one.simulated[i] -= residuals[r][i];
        }
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

bool is_clear(const Interval& over) { return over.mean > clear_advantage && over.low > 0.0; }

Evidence::Evidence(const std::vector<Ranked>& ranked, const Whitener& whitener, const Study& trained,
                   const Study& validated, bool same, FoundOut known)
    : ranking(ranked),
      study(trained),
      validation(validated),
      same_records(same),
      whitener_(whitener),
      known_(std::move(known)) {}

std::size_t Evidence::none() const {
    return static_cast<std::size_t>(std::find_if(ranking.begin(), ranking.end(),
                                                 [](const Ranked& ranked) { return ranked.trained.effects.empty(); }) -
                                    ranking.begin());
}

std::optional<std::size_t> Evidence::best_of(std::size_t size) const {
    for (std::size_t i = 0; i < ranking.size(); ++i) {
        if (ranking[i].trained.effects.size() == size && objection(i).empty()) {
            return i;
        }
    }
    return std::nullopt;
}

double Evidence::over_noise(double gap) const {
    return gap::over_noise(validation, gap * output_deviation(validation));
}

const Flexible& Evidence::remainder(std::size_t i) const {
    const auto known = known_.remainders.find(i);
    if (known != known_.remainders.end()) {
        return known->second;
    }
    std::vector<Remainder> also;
    if (!same_records) {
        also = remainders(study, all_residuals(study, ranking[i].trained));
    }
    return known_.remainders
        .emplace(i, explain(remainders(validation, ranking[i].residuals), also, model_of(study.base.form).delay_s,
                            study.scales.time_constant_s))
        .first->second;
}

const std::string& Evidence::objection(std::size_t i) const {
    const auto known = known_.objections.find(i);
    if (known != known_.objections.end()) {
        return known->second;
    }
    std::string what;
    if (!ranking[i].trained.effects.empty()) {
        Candidate trained = ranking[i].trained;
        add_intervals(study, trained, beside_form() ? nullptr : &whitener_);
        what = untold_of(study, trained);
        if (what.empty() && beside_form()) {
            what = linear_of(trained);
        }
        if (what.empty() && beside_form() && trained.has_events()) {
            what = objection_to_events(trained, ranking[i].candidate);
        }
    }
    return known_.objections.emplace(i, std::move(what)).first->second;
}

// Of events beside a fitted form. \param trained  with its intervals
std::string Evidence::objection_to_events(const Candidate& trained, Candidate judged) const {
    add_intervals(validation, judged, nullptr);
    for (const Effect* effect : trained.effects) {
        if (effect->kind != Kind::event) {
            continue;
        }
        const auto needs = [&](const Study& of, const Candidate& candidate) {
            return std::count_if(candidate.own.begin(), candidate.own.end(),
                                 [&](const auto& own) { return needs_event(of, own, *effect); });
        };
        const auto fitted = needs(study, trained);
        const auto validated = needs(validation, judged);
        if (validated == 0) {
            return fmt::format("validation does not tell {} from none", effect->name);
        }
        if (!same_records &&
            fitted + validated == static_cast<std::ptrdiff_t>(trained.own.size() + judged.own.size())) {
            return fmt::format("every record needs a {} of its own", effect->name);
        }
    }
    return "";
}

}  // namespace gap
