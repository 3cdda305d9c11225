// A question small enough that every length of every kernel is asked.
#pragma once

#include "bench/choose/question.hpp"

namespace test {

inline choose::Question small_question() {
    choose::Question question;
    question.conditions = {0.5, 1e-3, {"step", "noise"}, 60, 2020};
    question.kernels = {"ring_plain_f32", "ring_plain_q15", "mirrorhold_plain_f32", "nested_plain_f32",
                        "modes_plain_f32"};
    return question;
}

}  // namespace test
