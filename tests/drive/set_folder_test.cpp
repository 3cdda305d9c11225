// A blind set on disk: what is written, and what is opened only where its hashes fit.
#include "drive/stand/blind/set_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "base/sha256.hpp"

namespace {

namespace blind = stand::blind;
using testing::HasSubstr;

const std::string no_gap =
    R"({"schema": "glsum-gap-1", "verdict": "no_gap", "effects": [], "ranking": [], "gap": {}, "where": {}})";

std::string refused_by(const std::function<void()>& open) {
    try {
        open();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "nothing";
}

// Two cases without a model, and verdicts on both.
class SetFolder : public testing::Test {
protected:
    SetFolder() {
        std::size_t made = 0;
        set_ = blind::make_open_set(2, 4, 1, [&] { ++made; });
        EXPECT_EQ(made, 2U);
        blind::write_set(set_, at(), [&](const std::string& hash) {
            told_ = hash;
            EXPECT_FALSE(std::filesystem::exists(at("001")));  // before any case
        });
        for (const char* name : {"001/verdict.json", "002/verdict.json"}) {
            base::write_file(at(name), no_gap);
            hashes_ += base::sha256_line(base::sha256_of(at(name)), name);
        }
        base::write_file(at("verdicts.sha256"), hashes_);
    }
    [[nodiscard]] std::filesystem::path at(const std::string& name = "") const { return scratch_.file("set") / name; }
    [[nodiscard]] std::vector<blind::Answer> verdicts() const {
        return blind::open_verdicts(at(), blind::open_truth(at()));
    }

    base::Scratch scratch_;
    blind::Set set_;
    std::string told_;
    std::string hashes_;
};

TEST_F(SetFolder, IsOpenedAsItWasWritten) {
    EXPECT_EQ(told_, base::sha256_of(at("truth.sealed.json")));
    EXPECT_EQ(told_, blind::noted_hash(at()));
    const auto truths = blind::open_truth(at());
    ASSERT_EQ(truths.size(), 2U);
    EXPECT_EQ(truths[1].name, "002");
    EXPECT_EQ(verdicts().size(), 2U);
    ASSERT_EQ(set_.cases.size(), 2U);
    EXPECT_EQ(set_.cases[0].back().first, "case.json");
    for (const auto& [name, text] : set_.cases[0]) {
        EXPECT_EQ(base::read_file(at("001/" + name), 1U << 24U), text) << name;
    }
    EXPECT_TRUE(blind::is_case(at("001")));
    EXPECT_FALSE(blind::is_case(at()));
}

TEST_F(SetFolder, ACaseWithAModelHasTwoLogs) {
    const blind::Set set = blind::make_set(1, 4, 1, {});
    ASSERT_EQ(set.cases.size(), 1U);
    std::vector<std::string> names;
    for (const auto& [name, text] : set.cases[0]) {
        names.push_back(name);
        EXPECT_FALSE(text.empty());
    }
    EXPECT_THAT(names, testing::ElementsAre("model.json", "train.csv", "validate.csv"));
    blind::write_set(set, at("with"), [](const std::string&) {});
    EXPECT_TRUE(blind::is_case(at("with/001")));
    EXPECT_EQ(blind::open_truth(at("with")).size(), 1U);
}

TEST_F(SetFolder, ATruthThatWasChangedIsNotOpened) {
    base::write_file(at("truth.sealed.json"), set_.sealed + " ");
    EXPECT_THAT(refused_by([&] { (void)blind::open_truth(at()); }), HasSubstr("it was changed since"));
    base::write_file(at("truth.sha256"), hashes_);
    EXPECT_THAT(refused_by([&] { (void)blind::open_truth(at()); }),
                HasSubstr("expected one line, of truth.sealed.json, found 2"));
    base::write_file(at("truth.sha256"), base::sha256_line(told_, "another.json"));
    EXPECT_THAT(refused_by([&] { (void)blind::noted_hash(at()); }), HasSubstr("expected one line"));
}

TEST_F(SetFolder, VerdictsAreOfAllCasesAndNoOthers) {
    const std::string first = hashes_.substr(0, hashes_.find('\n') + 1);
    base::write_file(at("verdicts.sha256"), first);
    EXPECT_THAT(refused_by([&] { (void)verdicts(); }), HasSubstr("expected a line for 002/verdict.json, found none"));
    base::write_file(at("verdicts.sha256"), hashes_ + first);
    EXPECT_THAT(refused_by([&] { (void)verdicts(); }), HasSubstr("001/verdict.json is there twice"));
    base::write_file(at("verdicts.sha256"), hashes_ + base::sha256_line(told_, "003/verdict.json"));
    EXPECT_THAT(refused_by([&] { (void)verdicts(); }),
                HasSubstr("expected cases of the sealed truth, found 003/verdict.json"));
    base::write_file(at("verdicts.sha256"), hashes_);
    base::write_file(at("002/verdict.json"), no_gap + " ");
    EXPECT_THAT(refused_by([&] { (void)verdicts(); }), HasSubstr("it was changed since"));
}

}  // namespace
