// Files appear whole or not at all.
#include "bench/files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "qemu/failure.hpp"
#include "qemu/scratch.hpp"

namespace {

std::string content(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(Files, ReplaceAWholeFileAndLeaveNothingBeside) {
    const qemu::Scratch folder;
    const auto path = folder.file("out.json");
    bench::write_file(path, "old");
    bench::write_file(path, std::string(1 << 20, 'x'));
    EXPECT_EQ(content(path).size(), 1U << 20);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, AFullDiskIsAnErrorAndTheOldFileStays) {
    const qemu::Scratch folder;
    const auto path = folder.file("out.json");
    bench::write_file(path, "good");
    // The partial file's own name leads to a device that is always full.
    std::filesystem::create_symlink("/dev/full", bench::partial_name(path));
    try {
        bench::write_file(path, "new");
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
    const qemu::Scratch folder;
    const auto path = folder.file("out.json");
    std::ofstream(path.string() + ".partial-999999999") << "half";
    bench::write_file(path, "good");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(Files, AFolderThatCannotBeWrittenIsFoundBeforeTheRun) {
    EXPECT_THROW(bench::check_writable("/proc/glsum/out.json"), glsum::Failure);
}

}  // namespace
