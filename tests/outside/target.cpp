// A stranger's program for the target: the half derivative of a step, 50 samples after it, in single precision and in
// Q31.
#include <glsum/registry.hpp>

namespace {

// Gamma(k + 1/2) / (Gamma(1/2) k!) at k = 50
constexpr float expected = 0.0795892373871787F;

glsum::Line<glsum::Sum<glsum::Ring, glsum::Oldest, glsum::F32>, 600> of_floats;
glsum::Line<glsum::Sum<glsum::Mirror, glsum::Multi, glsum::Q31>, 600> of_words;

template <class Line, class Sample>
auto last_of_a_step(Line& line, Sample level) {
    auto sum = line.step(level);
    for (int k = 1; k <= 50; ++k) {
        sum = line.step(level);
    }
    return sum;
}

bool is_near(float found, float wanted) { return found - wanted < 1e-6F && wanted - found < 1e-6F; }

}  // namespace

int main() {
    if (of_floats.prepare({.order = 0.5, .taps = 51}) != glsum::Status::ok ||
        of_words.prepare({.order = 0.5, .taps = 51}) != glsum::Status::ok) {
        return 1;
    }
    using Words = glsum::Sum<glsum::Mirror, glsum::Multi, glsum::Q31>;
    const auto words = last_of_a_step(of_words, Words::from_real(0.5));
    return !is_near(last_of_a_step(of_floats, 1.0F), expected)                                      ? 2
           : !is_near(static_cast<float>(Words::to_real(of_words.state(), words)), 0.5F * expected) ? 3
                                                                                                    : 0;
}
