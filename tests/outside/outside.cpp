// A stranger's program: the half derivative of a step, 50 samples after it.
#include <cmath>
#include <cstdio>
#include <glsum/registry.hpp>

int main() {
    glsum::Line<glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>, 600> line;
    if (line.prepare({.order = 0.5, .taps = 51}) != glsum::Status::ok) {
        return 1;
    }
    float sum = 0.0F;
    for (int k = 0; k <= 50; ++k) {
        sum = line.step(1.0F);
    }
    // Gamma(k + 1/2) / (Gamma(1/2) k!) at k = 50
    const double expected = 0.0795892373871787;
    std::printf("%.7f, expected %.7f\n", static_cast<double>(sum), expected);
    return std::fabs(sum - expected) < 1e-6 ? 0 : 1;
}
