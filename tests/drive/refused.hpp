// What is refused as bad input, in its words.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "base/failure.hpp"

namespace test {

/// The message of the failure that a call ends with; "accepted" where it ends with none.
inline std::string refusal_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "accepted";
}

}  // namespace test
