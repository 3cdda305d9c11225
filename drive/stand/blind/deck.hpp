// Which effects a set holds: dealt like cards.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/chance.hpp"

namespace stand::blind {

/// Effects and sizes dealt like cards: every card once, then all again in another order.
class Deck {
public:
    Deck(std::vector<std::string> effects, std::vector<EffectSize> sizes, Chance& chance) : chance_(chance) {
        for (const std::string& effect : effects) {
            for (const EffectSize size : sizes) {
                all_.emplace_back(effect, size);
            }
        }
    }
    [[nodiscard]] std::pair<std::string, EffectSize> deal() {
        if (left_.empty()) {
            left_ = all_;
            chance_.shuffle(left_);
        }
        const auto card = left_.back();
        left_.pop_back();
        return card;
    }

private:
    Chance& chance_;
    std::vector<std::pair<std::string, EffectSize>> all_;
    std::vector<std::pair<std::string, EffectSize>> left_;
};

/// Two that could stand for one another, or of which one hides the other, make no pair.
[[nodiscard]] bool pairs_with(const std::string& a, const std::string& b);

}  // namespace stand::blind
