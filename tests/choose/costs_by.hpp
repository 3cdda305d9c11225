// Costs that a test makes up, for what asks a source of costs.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/choose/costs.hpp"

namespace test {

/// By a function of the kernel and its length; the same every time.
class CostsBy : public choose::CostSource {
public:
    using Function = std::function<choose::Cost(const std::string& kernel, std::size_t taps)>;
    explicit CostsBy(Function cost) : cost_(std::move(cost)) {}
    [[nodiscard]] std::string unit() const override { return "model cycles"; }
    [[nodiscard]] std::string limited_unit() const override { return unit(); }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] std::vector<choose::Cost> costs(const std::vector<choose::Case>& cases) override {
        std::vector<choose::Cost> found;
        for (const auto& [kernel, taps] : cases) {
            found.push_back(cost_(kernel, taps));
        }
        return found;
    }

private:
    Function cost_;
};

}  // namespace test
