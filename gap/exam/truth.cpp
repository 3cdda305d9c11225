#include "gap/exam/truth.hpp"

#include <algorithm>

#include "gap/exam/fields.hpp"
#include "gap/exam/manifest.hpp"

namespace gap::exam {
namespace {

std::vector<Cause> take_causes(Fields& fields) {
    std::vector<Cause> causes;
    for (auto& value : fields.list("causes", Limits::list, false)) {
        Fields own(std::move(value), fields.name() + ": causes[" + std::to_string(causes.size()) + "]");
        Cause& cause = causes.emplace_back();
        cause.any_of = own.texts("any_of", 1);
        cause.main = own.flag_or("main", true);
        own.refuse_rest("any_of and main");
    }
    return causes;
}

Truth to_truth(Fields fields) {
    Truth truth;
    truth.name = fields.text("name");
    const std::string known = fields.one_of("known", {"listed", "nothing", "not_listed"});
    truth.known = known == "listed" ? Known::listed : known == "nothing" ? Known::nothing : Known::not_listed;
    truth.causes = take_causes(fields);
    const bool main =
        std::any_of(truth.causes.begin(), truth.causes.end(), [](const Cause& cause) { return cause.main; });
    if (truth.known == Known::listed && !main) {
        fields.refuse("causes", "a main one beside listed", "none");
    }
    if (truth.known == Known::nothing && !truth.causes.empty()) {
        fields.refuse("causes", "none beside nothing", std::to_string(truth.causes.size()));
    }
    truth.attainable_gap = fields.positive("attainable_gap");
    truth.attainable_of_base = fields.positive("attainable_of_base");
    if (truth.attainable_gap && truth.attainable_of_base) {
        fields.refuse("attainable_of_base", "it or attainable_gap", "both");
    }
    truth.source = fields.text_or("source", "");
    fields.refuse_rest("name, known, causes, attainable_gap, attainable_of_base and source");
    return truth;
}

}  // namespace

std::vector<Truth> parse_truth(const std::string& text, const std::string& name) {
    std::vector<Truth> all;
    for (Fields& question : questions_in(text, name, "glsum-exam-truth-1")) {
        all.push_back(to_truth(std::move(question)));
    }
    return all;
}

}  // namespace gap::exam
