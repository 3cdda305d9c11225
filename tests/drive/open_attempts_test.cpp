// How long a blind case without a model looks for a plant that shows its effect: on a family that counts what it is
// asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/failure.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

namespace blind = stand::blind;
using blind::EffectSize;

std::vector<std::pair<std::string, EffectSize>> asked;

// Nothing shows in it.
struct Mute : blind::Rig {
    blind::Parameters draw(const std::string& effect, EffectSize size, bool, stand::Chance&) const override {
        asked.emplace_back(effect, size);
        throw glsum::Failure(glsum::Exit::check_failed, "nothing shows");
    }
    std::vector<double> read(std::span<const blind::Fault>, const blind::Held&, const std::vector<double>&,
                             std::uint64_t) const override {
        return {};
    }
};

std::unique_ptr<blind::Rig> draw_mute(const std::vector<std::string>&, stand::Chance&) {
    auto rig = std::make_unique<Mute>();
    rig->clock.until_s = 10.0;
    return rig;
}

TEST(OpenAttempts, AreFortyPlantsForEachOfSixEffects) {
    const blind::Family family{"mute", {"first", "second", "third"}, {"other"}, {}, {}, draw_mute};
    const blind::OpenPlan plan{&family, {blind::Class::single, {"first"}, {EffectSize::small}, false}};
    asked.clear();
    try {
        (void)blind::make_open_case(plan, 1, 7);
        FAIL() << "expected that it gives up";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::check_failed);
        EXPECT_STREQ(failure.what(), "blind: case 7 with first shows in no mute plant");
    }
    constexpr std::size_t plants = 40;
    constexpr std::size_t effects = 6;
    ASSERT_EQ(asked.size(), plants * effects);
    EXPECT_EQ(asked.front().first, "first");
    for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_EQ(asked[i].first, asked[i / plants * plants].first) << i;
        EXPECT_THAT(family.listed, testing::Contains(asked[i].first)) << i;
        // Eight plants are enough to see that it hardly shows: then it is larger.
        EXPECT_EQ(asked[i].second, static_cast<EffectSize>(std::min<std::size_t>(2, i % plants / 8))) << i;
    }
}

std::set<double> levels;  // the higher one of each record that goes to and fro between two

// It keeps what it is given, and answers with nothing that a base could be fitted to.
struct Deaf : blind::Rig {
    blind::Parameters draw(const std::string&, EffectSize, bool, stand::Chance&) const override { return {}; }
    std::vector<double> read(std::span<const blind::Fault>, const blind::Held& held, const std::vector<double>&,
                             std::uint64_t) const override {
        const std::set<double> own(held.input.begin(), held.input.end());
        int changes = 0;
        for (std::size_t k = 1; k < held.input.size(); ++k) {
            changes += held.input[k] != held.input[k - 1] ? 1 : 0;
        }
        if (own.size() == 2 && changes > 2) {
            levels.insert(*own.rbegin());
        }
        return std::vector<double>(held.input.size(), 0.0);
    }
};

std::unique_ptr<blind::Rig> draw_deaf(const std::vector<std::string>&, stand::Chance&) {
    auto rig = std::make_unique<Deaf>();
    rig->clock.interval_s = 0.4;
    rig->full_input = 5.0;
    return rig;
}

TEST(OpenAttempts, GiveSixTenthsOfTheFullInputToAllOfIt) {
    for (const auto& [kind, effect] : {std::pair(blind::Class::taken_up, "bend"), {blind::Class::single, "listed"}}) {
        const blind::Family family{"deaf", {effect}, {"other"}, {}, {"bend"}, draw_deaf};
        levels.clear();
        for (std::size_t number = 1; number <= 5; ++number) {
            EXPECT_THROW(
                (void)blind::make_open_case({&family, {kind, {effect}, {EffectSize::large}, false}}, 2, number),
                glsum::Failure);
        }
        ASSERT_GT(levels.size(), 300U) << effect;
        EXPECT_GE(*levels.begin(), 0.6 * 5.0) << effect;
        EXPECT_LT(*levels.begin(), 0.605 * 5.0) << effect;
        EXPECT_GT(*levels.rbegin(), 0.995 * 5.0) << effect;
        EXPECT_LE(*levels.rbegin(), 5.0) << effect;
    }
}

}  // namespace
