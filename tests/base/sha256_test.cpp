// Hashes of files against published ones, and the lines that sha256sum writes.
#include "base/sha256.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"

namespace {

// FIPS 180-2: of "abc".
const std::string of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Sha256, IsThePublishedOneWhateverTheFileIsCalled) {
    // Quotes, blanks and what a shell would carry out.
    const auto path = std::filesystem::temp_directory_path() / ("it's $(false) 'a' file-" + std::to_string(getpid()));
    std::ofstream(path) << "abc";
    EXPECT_EQ(base::sha256_of(path), of_abc);
    std::ofstream(path, std::ios::trunc);
    EXPECT_EQ(base::sha256_of(path), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    std::filesystem::remove(path);
    try {
        (void)base::sha256_of(path);
        FAIL() << "a file that is not there was hashed";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_NE(std::string(failure.what()).find(path.string()), std::string::npos) << failure.what();
    }
}

TEST(Sha256, LinesAreReadAsTheyAreWritten) {
    const std::string text = base::sha256_line(of_abc, "a") + base::sha256_line(of_abc, "two words.csv");
    EXPECT_EQ(text, of_abc + "  a\n" + of_abc + "  two words.csv\n");
    const auto lines = base::parse_sha256_lines(text, "seal");
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0], std::pair(of_abc, std::string("a")));
    EXPECT_EQ(lines[1], std::pair(of_abc, std::string("two words.csv")));
    EXPECT_TRUE(base::parse_sha256_lines("", "seal").empty());
}

TEST(Sha256, ADamagedLineIsNamed) {
    const std::string good = of_abc + "  a\n";
    std::string upper = of_abc;
    upper[0] = 'B';
    for (const std::string& bad : {std::string("\n"), of_abc + "\n", of_abc + "  \n", of_abc.substr(1) + "   a\n",
                                   of_abc + "_ a\n", upper + "  a\n"}) {
        try {
            (void)base::parse_sha256_lines(good + bad, "seal");
            ADD_FAILURE() << bad;
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            const std::string found =
                bad == "\n" ? "nothing" : "'" + bad.substr(0, std::min<std::size_t>(80, bad.size() - 1)) + "'";
            EXPECT_EQ(std::string(failure.what()),
                      "seal:2: expected a hash of 64 digits, two spaces and a file's name, found " + found);
        }
    }
}

TEST(Sha256, AChangedFileIsNamedBesideWhatNotedIt) {
    const base::Scratch folder;
    const auto path = folder.file("a");
    base::write_file(path, "abc");
    EXPECT_NO_THROW(base::check_sha256(path, of_abc, "seal"));
    base::write_file(path, "abd");
    try {
        base::check_sha256(path, of_abc, "seal");
        FAIL() << "a changed file was taken";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_EQ(std::string(failure.what()), path.string() + ": expected the sha256 " + of_abc + " of seal, found " +
                                                   base::sha256_of(path) + ": it was changed since");
    }
}

}  // namespace
