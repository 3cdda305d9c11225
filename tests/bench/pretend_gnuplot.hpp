// A script in gnuplot's place: it keeps what it is sent, and draws files of one word.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

// A folder with a program `gnuplot`, the first that is found.
class PretendGnuplot : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder_);
        path_ = std::getenv("PATH");
        setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
        pretend("tee -a '" + (folder_ / "sent").string() +
                "' | sed -n \"s/^set output '\\(.*\\)'$/\\1/p\" | sed \"s/''/'/g\" | while read -r file; do echo drawn "
                ">\"$file\"; done");
    }
    void TearDown() override {
        setenv("PATH", path_.c_str(), 1);
        std::filesystem::remove_all(folder_);
    }
    void pretend(const std::string& body) {
        std::ofstream(folder_ / "gnuplot") << "#!/bin/sh\n" << body << '\n';
        std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms::owner_all);
    }
    // What was sent for the first of the two pictures.
    std::string sent() {
        std::ifstream in(folder_ / "sent");
        const std::string all{std::istreambuf_iterator<char>(in), {}};
        std::filesystem::remove(folder_ / "sent");
        return all.substr(0, all.find("unset output"));
    }
    std::filesystem::path stem() const { return folder_ / "picture"; }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("pretend_gnuplot-" + std::to_string(getpid()));
    std::string path_;
};
