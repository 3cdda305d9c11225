// Logarithmic memory: a few taps, and means over blocks that grow with their age. It is laid out on the host.
#include <cmath>
#include <cstdio>
#include <glsum/design/blocks.hpp>
#include <glsum/registry.hpp>

int main() {
    const float step_s = 1e-3F;
    const float factor = 1.0F / std::sqrt(step_s);  // h^-v
    // 32 coefficients over records of up to 5000 samples.
    const auto design = glsum::design::design_blocks({.order = 0.5, .horizon = 5000}, 32);
    glsum::Line<glsum::nested_plain_f32, 8192> line;  // samples as far back as the blocks reach
    if (line.prepare({.order = 0.5, .taps = 32, .blocks = design.blocks}) != glsum::Status::ok) {
        return 1;
    }
    std::printf("%zu taps and %u blocks, off by at most %.4f of the largest sample\n", design.near_taps,
                static_cast<unsigned>(design.blocks.count), design.error);
    for (int k = 0; k <= 1000; ++k) {
        const float derivative = factor * line.step(1.0F);  // of a unit step: t^-1/2 / Gamma(1/2)
        if (k == 100 || k == 1000) {
            std::printf("%.1f s: %.4f, exact %.4f\n", k * 1e-3, derivative,
                        1.0 / std::sqrt(3.14159265358979 * k * 1e-3));
        }
    }
}
