// What docs/measured and results/curves show was measured with today's kernels. `results/remake` makes them anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "glsum/registry.hpp"

namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Measured, IsOfTodaysKernels) {
    std::set<std::string> today;
    glsum::Registry::for_each([&]<class K>() { today.emplace(K::name()); });
    std::ifstream file(TEST_PROJECT "/docs/measured/kernels");
    std::set<std::string> measured;
    for (std::string name; std::getline(file, name);) {
        measured.insert(name);
    }
    EXPECT_EQ(measured, today) << "make pictures and tables anew: results/remake";
}

// Nothing is shown that the command does not make, and nothing is lost that a page shows.
TEST(Measured, PicturesAreThoseThatTheCommandMakes) {
    const std::filesystem::path project = TEST_PROJECT;
    const std::string command = text_of(project / "results/remake");
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(project / "results/curves")) {
        std::string name = entry.path().stem();
        name = name.starts_with("roots-") ? "roots-$model" : name;
        // Of the report: each a shot of its name.
        EXPECT_TRUE(command.find("picture " + name + " ") != std::string::npos ||
                    command.find("'" + name + "#") != std::string::npos ||
                    command.find("picture \"" + name + "\"") != std::string::npos)
            << entry.path();
        ++pictures;
    }
    EXPECT_GT(pictures, 0U);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(project)) {
        if (entry.path().extension() != ".md" || entry.path().string().find("/build/") != std::string::npos) {
            continue;
        }
        const std::string page = text_of(entry.path());
        for (std::size_t at = page.find("]("); at != std::string::npos; at = page.find("](", at + 1)) {
            const std::string link = page.substr(at + 2, page.find_first_of(")# ", at + 2) - at - 2);
            if (!link.empty() && link.find("://") == std::string::npos) {
                EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / link)) << entry.path() << ": " << link;
            }
        }
    }
}

}  // namespace
