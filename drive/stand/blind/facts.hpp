// What the judge of a case without a model is told beside its logs: facts that name no form and no effect.
#pragma once

#include <string>

namespace stand::blind {

struct Facts {
    std::string domain;  ///< `mechanical`, `thermal`, `hydraulic` or `electric`
};

/// JSON, schema `glsum-case-1`.
[[nodiscard]] std::string to_json(const Facts& facts);

/// \throws glsum::Failure (bad input) naming the file, what was expected and what was found.
[[nodiscard]] Facts parse_facts(const std::string& text, const std::string& name);

}  // namespace stand::blind
