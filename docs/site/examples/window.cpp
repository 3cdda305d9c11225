// A window of the newest 400 samples: no design, any order. What lies further back is forgotten.
#include <cmath>
#include <cstdio>
#include <glsum/registry.hpp>

int main() {
    const float step_s = 1e-3F;
    const float factor = 1.0F / std::sqrt(step_s);  // h^-v
    glsum::Line<glsum::ring_plain_f32, 400> line;   // state and buffers, no heap
    if (line.prepare({.order = 0.5, .taps = 400}) != glsum::Status::ok) {
        return 1;
    }
    for (int k = 0; k <= 1000; ++k) {
        const float derivative = factor * line.step(1.0F);  // of a unit step: t^-1/2 / Gamma(1/2)
        if (k == 100 || k == 1000) {
            std::printf("%.1f s: %.4f, exact %.4f\n", k * 1e-3, derivative,
                        1.0 / std::sqrt(3.14159265358979 * k * 1e-3));
        }
    }
}
