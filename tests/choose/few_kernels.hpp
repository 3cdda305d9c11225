// Kernels that a test makes up, for the search.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/choose/search.hpp"

namespace test {

/// Kernels that meet any limit from a length on, with costs as each test gives them, and what was asked.
struct Few : choose::ErrorSource, choose::CostSource {
    struct One {
        std::size_t meets_from;
        std::function<choose::Cost(std::size_t)> cost;
        bool costly = false;
        double error = 0.01;
    };
    std::map<std::string, One> ones;
    std::size_t full = 400;
    bool same_every_time = true;
    std::vector<choose::Case> asked;
    std::size_t rounds = 0;

    [[nodiscard]] std::size_t longest() const override { return full; }
    [[nodiscard]] double truncation(std::size_t) const override { return 0.0; }
    [[nodiscard]] double rounding_bound(const std::string&, std::size_t) const override { return 0.0; }
    [[nodiscard]] choose::ErrorAt error(const std::string& kernel, std::size_t taps) override {
        const One& one = ones.at(kernel);
        return {.error = taps >= one.meets_from ? one.error : 1.0, .signal = "made", .fault = {}};
    }
    [[nodiscard]] bool meets(const std::string& kernel, std::size_t taps, double limit) override {
        return error(kernel, taps).error <= limit;
    }
    [[nodiscard]] std::string unit() const override { return "instructions"; }
    [[nodiscard]] std::string limited_unit() const override { return "instructions"; }
    [[nodiscard]] bool exact() const override { return same_every_time; }
    [[nodiscard]] bool costly(const std::string& kernel) const override { return ones.at(kernel).costly; }
    [[nodiscard]] std::vector<choose::Cost> costs(const std::vector<choose::Case>& cases) override {
        std::vector<choose::Cost> found;
        rounds += cases.empty() ? 0 : 1;
        for (const choose::Case& one : cases) {
            asked.push_back(one);
            found.push_back(ones.at(one.first).cost(one.second));
        }
        return found;
    }
    choose::Choice choose(const choose::Limits& limits) {
        std::vector<std::string> all;
        for (const auto& [name, one] : ones) {
            all.push_back(name);
        }
        return choose::choose(*this, *this, all, limits, 1, false);
    }
};

inline choose::Cost cost_of(double value, double bytes = 8.0, double noise = 0.0) {
    return {.value = value, .limited = value, .noise = noise, .bytes = bytes, .fault = {}};
}

}  // namespace test
