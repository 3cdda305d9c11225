// Files appear whole or not at all.
#include "base/files.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "tests/refusal.hpp"

namespace {

std::string content(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(Files, ReplaceAWholeFileAndLeaveNothingBeside) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    base::write_file(path, "old");
    base::write_file(path, std::string(1 << 20, 'x'));
    EXPECT_EQ(content(path).size(), 1U << 20);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, AFullDiskIsAnErrorAndTheOldFileStays) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    base::write_file(path, "good");
    // The partial file's own name leads to a device that is always full.
    std::filesystem::create_symlink("/dev/full", base::partial_name(path));
    try {
        base::write_file(path, "new");
        FAIL() << "expected an error";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_NE(std::string(failure.what()).find("No space left"), std::string::npos) << failure.what();
        EXPECT_NE(std::string(failure.what()).find("out.json"), std::string::npos);
    }
    EXPECT_EQ(content(path), "good");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, RemoveWhatAKilledRunLeft) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    std::ofstream(path.string() + ".partial-999999999") << "half";
    base::write_file(path, "good");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, AFolderThatCannotBeWrittenIsFoundBeforeTheRun) {
    EXPECT_THROW(base::check_writable("/proc/glsum/out.json"), glsum::Failure);
}

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(Files, AreReadUpToTheirLimit) {
    const base::Scratch folder;
    const auto path = folder.file("in.json");
    const std::string text = std::string(1 << 16, 'a') + std::string(1000, 'b');
    std::ofstream(path) << text;
    EXPECT_EQ(base::read_file(path, text.size()), text);
    EXPECT_EQ(base::read_file(path, 1 << 20), text);
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)base::read_file(path, text.size() - 1); }),
              path.string() + ": expected a file of at most 66535 bytes");
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)base::read_file(folder.file("none"), 9); }),
              folder.file("none").string() + ": cannot read: No such file or directory");
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)base::read_file(folder.file(""), 9); }),
              folder.file("").string() + ": cannot read: Is a directory");
    std::ofstream(folder.file("empty")).flush();
    EXPECT_EQ(base::read_file(folder.file("empty"), 9), "");
}

// Whatever comes in the way, the reason is said, nothing is left beside, and what was there stays.
TEST(Files, WhatCannotBeWrittenIsNamedWithItsReason) {
    const base::Scratch folder;
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { base::write_file("/proc/glsum/out.json", "x"); }),
              "/proc/glsum/out.json: cannot write: No such file or directory; what was there before is untouched");
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, [] { base::check_writable("/proc/glsum/out.json"); })
                  .find("cannot write: No such file"),
              std::string::npos);
    const auto taken = folder.file("taken");
    std::filesystem::create_directories(taken / "inside");
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { base::write_file(taken, "x"); }),
              taken.string() + ": cannot write: Is a directory; what was there before is untouched");
    EXPECT_EQ(files_in(taken.parent_path()), 1);
    EXPECT_EQ(
        test::refusal(glsum::Exit::bad_input, [&] { base::publish(folder.file("gone"), folder.file("out")); }),
        folder.file("out").string() + ": cannot write: No such file or directory; what was there before is untouched");
}

TEST(Files, AreWrittenIntoFoldersThatAreMade) {
    const base::Scratch folder;
    const auto path = folder.file("a") / "b" / "out.json";
    base::check_writable(path);
    EXPECT_EQ(files_in(path.parent_path()), 0);
    base::write_file(path, "new");
    EXPECT_EQ(content(path), "new");
    EXPECT_EQ(base::partial_name("out.json"), "./out.json.partial-" + std::to_string(getpid()));
}

// For everybody to read and write, as far as the user's mask allows, and not to run; of an earlier try nothing is left.
TEST(Files, AreWrittenAfresh) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    const mode_t mask = umask(0);
    base::write_file(path, "old");
    EXPECT_EQ(std::filesystem::status(path).permissions(), static_cast<std::filesystem::perms>(0666));
    std::ofstream(base::partial_name(path)) << "longer than what follows";
    base::write_file(path, "new");
    umask(mask);
    EXPECT_EQ(content(path), "new");
}

// A run that is still at work keeps its own; what is no run's is nobody's to remove.
TEST(Files, OfOthersOnlyWhatIsLeftIsRemoved) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    const std::string alive = path.string() + ".partial-" + std::to_string(getppid());
    std::ofstream(alive) << "half";
    std::ofstream(path.string() + ".partial-mine") << "half";
    std::ofstream(folder.file("another.json.partial-999999999")) << "half";
    std::ofstream(path.string() + ".partial-999999999") << "half";
    (void)base::partial_name(path);
    EXPECT_EQ(files_in(path.parent_path()), 3);
    EXPECT_EQ(content(alive), "half");
}

TEST(Files, NoneIsLeftOpen) {
    const base::Scratch folder;
    const auto path = folder.file("out.json");
    const auto open_files = [] { return files_in("/proc/self/fd"); };
    const auto before = open_files();
    base::write_file(path, "x");
    (void)base::read_file(path, 9);
    base::check_writable(path);
    base::write_file(folder.file("other"), "x");
    std::filesystem::create_directories(folder.file("taken") / "inside");
    (void)test::refusal(glsum::Exit::bad_input, [&] { base::write_file(folder.file("taken"), "x"); });
    (void)test::refusal(glsum::Exit::bad_input, [&] { (void)base::read_file(path, 0); });
    (void)test::refusal(glsum::Exit::bad_input, [&] { (void)base::read_file(folder.file(""), 9); });
    std::filesystem::create_symlink("/dev/full", base::partial_name(path));
    (void)test::refusal(glsum::Exit::bad_input, [&] { base::write_file(path, "new"); });
    EXPECT_EQ(open_files(), before);
}

TEST(Files, AFolderForResultsIsNewOrEmpty) {
    const base::Scratch folder;
    const auto path = folder.file("out");
    EXPECT_NO_THROW(base::check_new_or_empty(path));
    std::filesystem::create_directory(path);
    EXPECT_NO_THROW(base::check_new_or_empty(path));
    base::write_file(path / "a", "");
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { base::check_new_or_empty(path); }),
              path.string() + ": expected a folder that is new or empty, found files in it");
}

// A folder of its own, in which scratch folders are made meanwhile.
class ScratchFolder : public testing::Test {
protected:
    void SetUp() override {
        if (const char* const before = std::getenv("TMPDIR")) {
            before_ = before;
        }
        setenv("TMPDIR", outer_.file("").c_str(), 1);
    }
    void TearDown() override {
        if (before_) {
            setenv("TMPDIR", before_->c_str(), 1);
        } else {
            unsetenv("TMPDIR");
        }
    }
    const base::Scratch outer_;

private:
    std::optional<std::string> before_;
};

TEST_F(ScratchFolder, IsNewAndEmptyAndGoesWithWhatIsInIt) {
    std::filesystem::path made;
    {
        const base::Scratch one;
        const base::Scratch other;
        made = one.file("a").parent_path();
        EXPECT_NE(made, other.file("a").parent_path());
        EXPECT_EQ(made.parent_path(), outer_.file("a").parent_path());
        EXPECT_EQ(made.filename().string().find("glsum-" + std::to_string(getpid()) + "-"), 0U);
        EXPECT_EQ(files_in(made), 0);
        std::filesystem::create_directory(one.file("b"));
        base::write_file(one.file("b") / "a", "x");
    }
    EXPECT_FALSE(std::filesystem::exists(made));
    EXPECT_EQ(files_in(outer_.file("")), 0);
}

// Of runs that were killed nothing stays; of those at work, and of others' folders, all does.
TEST_F(ScratchFolder, OfAKilledRunIsRemoved) {
    const std::string alive = "glsum-" + std::to_string(getppid()) + "-aaaaaa";
    for (const std::string& name : {alive, std::string("glsum-999999999-aaaaaa"), std::string("glsum-mine"),
                                    std::string("other-999999999-aaaaaa")}) {
        std::filesystem::create_directory(outer_.file(name.c_str()));
        base::write_file(outer_.file(name.c_str()) / "a", "x");
    }
    { const base::Scratch swept; }
    EXPECT_FALSE(std::filesystem::exists(outer_.file("glsum-999999999-aaaaaa")));
    EXPECT_TRUE(std::filesystem::exists(outer_.file(alive.c_str()) / "a"));
    EXPECT_TRUE(std::filesystem::exists(outer_.file("glsum-mine") / "a"));
    EXPECT_TRUE(std::filesystem::exists(outer_.file("other-999999999-aaaaaa") / "a"));
    EXPECT_EQ(files_in(outer_.file("")), 3);
}

}  // namespace
