// How long a blind case without a model looks for a plant that shows its effect: on a family that counts what it is
// asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
