#include "gap/drive/contract.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"
#include "gap/drive/effect.hpp"

namespace gap {
namespace {

[[noreturn]] void cannot_read(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

}  // namespace

std::vector<Written> numbers_to_contract(const Effect& effect, std::span<const Fitted> fitted) {
    std::vector<Written> written;
    for (std::size_t i = 0; i < effect.numbers.size(); ++i) {
        if (effect.numbers[i].given != Number::Given::never) {
            written.push_back(
                {effect.numbers[i].name, fitted[i].value, {{fitted[i].low, fitted[i].high}}, fitted[i].unit});
        }
    }
    return written;
}

std::vector<double> numbers_from_contract(const Effect& effect, const Contracted& contracted) {
    std::vector<double> values;
    for (const Number& number : effect.numbers) {
        const auto found = number.given == Number::Given::never ? contracted.end() : contracted.find(number.name);
        const double* value = found == contracted.end() ? nullptr : std::get_if<double>(&found->second);
        const bool left_out = found == contracted.end() && number.given != Number::Given::always;
        if (value == nullptr && !left_out) {
            cannot_read(fmt::format("{}: expected a number {}", effect.name, number.name));
        }
        values.push_back(left_out ? number.otherwise : *value);
    }
    for (const auto& given : contracted) {
        if (std::none_of(effect.numbers.begin(), effect.numbers.end(), [&](const Number& number) {
                return number.name == given.first && number.given != Number::Given::never;
            })) {
            cannot_read(fmt::format("{}: has no parameter {}", effect.name, given.first));
        }
    }
    return values;
}

const std::vector<double>& list_in(const Contracted& contracted, const std::string& name) {
    const auto found = contracted.find(name);
    const auto* list = found == contracted.end() ? nullptr : std::get_if<std::vector<double>>(&found->second);
    if (list == nullptr) {
        cannot_read(fmt::format("expected a list of numbers {}", name));
    }
    return *list;
}

}  // namespace gap
