// How files write an effect's numbers, by the names of the contract, and read them back.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "gap/verdict/written.hpp"

namespace gap {

struct Effect;

/// One of an effect's numbers, as files have it.
struct Number {
    enum class Given {
        always,     ///< files give it
        otherwise,  ///< where a file does not give it, it is `otherwise`
        never,      ///< files leave it out; it is `otherwise`
    };
    std::string name;
    Given given = Given::always;
    double otherwise = 0.0;
};

/// A number that was fitted, with its interval of 95 %.
struct Fitted {
    double value;
    double low;
    double high;
    std::string unit = {};
};

/// Each number by its name, those that files leave out apart. \param fitted  in the order of the effect's numbers
[[nodiscard]] std::vector<Written> numbers_to_contract(const Effect& effect, std::span<const Fitted> fitted);

using Contracted = std::map<std::string, ContractValue>;

/// In the order of the effect's numbers. \throws glsum::Failure (bad input) naming a number that is missing, that the
/// effect has not, or that is none
[[nodiscard]] std::vector<double> numbers_from_contract(const Effect& effect, const Contracted& contracted);

/// The list of numbers with a name. \throws glsum::Failure (bad input): it is missing or no list of numbers
[[nodiscard]] const std::vector<double>& list_in(const Contracted& contracted, const std::string& name);

}  // namespace gap
