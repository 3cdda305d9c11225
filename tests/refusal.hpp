// What is refused, in which words and with which exit code.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/failure.hpp"

namespace test {

/// The message of the failure that `ask` ends with. Fails the test where it ends with none, or another status.
template <class Ask>
std::string refusal(glsum::Exit status, Ask ask) {
    try {
        ask();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), status) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
}

}  // namespace test
