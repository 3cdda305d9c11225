#include "gap/exam/ask.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "gap/drive/fair_records.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"

namespace gap::exam {

using Json = nlohmann::ordered_json;

Question to_question(const Asked& asked, Given given, unsigned jobs) {
    if (asked.split_s) {
        check_split(fmt::format("{}: split_s {}", asked.name, *asked.split_s), *asked.split_s, given.train);
    }
    Question question{.form = asked.is_fitted() ? form_to_find() : form_of(given.model.value()),
                      .refit = asked.refit || asked.is_fitted(),
                      .train = std::move(given.train),
                      .validate = std::move(given.validate),
                      .split_s = asked.split_s,
                      .metric = asked.metric.value_or(Metric::simulation),
                      .without = {},
                      .jobs = jobs};
    question.given_form = !asked.is_fitted();
    question.metric_free = !asked.metric;
    if (!asked.domain.empty()) {
        question.domain = domain_named(asked.domain);
    }
    if (asked.is_fitted()) {
        take_base(question, asked.base);
    }
    return question;
}

std::string to_answer(const Asked& asked, const Answer& answer) {
    Json verdict = Json::parse(to_json(answer));
    Json question{{"name", asked.name}, {"base", asked.base}, {"train", asked.train}, {"validate", asked.validate}};
    if (asked.split_s) {
        question["split_s"] = *asked.split_s;
    }
    if (!asked.domain.empty()) {
        question["domain"] = asked.domain;
    }
    if (!asked.units.empty()) {
        question["units"] = asked.units;
    }
    verdict["question"] = question;
    return verdict.dump(2) + "\n";
}

}  // namespace gap::exam
