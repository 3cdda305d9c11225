// A stranger's program for this machine: a table of full memory, designed, and what its certificate promises. Exit 0
// where the half derivative of a step stays within it.
#include <cmath>
#include <cstdio>
#include <glsum/design/modes.hpp>
#include <glsum/registry.hpp>

int main() {
    const auto found = glsum::design::design_modes({.order = 0.5, .horizon = 5000}, 1e-4);
    glsum::Line<glsum::modes_compensated_f32, 40> line;
    if (!found || line.prepare({.order = 0.5, .taps = found->length(), .modes = found->modes}) != glsum::Status::ok) {
        return 1;
    }
    double exact = 1.0;  // Gamma(k + 1/2) / (Gamma(1/2) k!)
    double off = std::fabs(static_cast<double>(line.step(1.0F)) - exact);
    for (int k = 1; k <= 5000; ++k) {
        exact *= (k - 0.5) / k;
        off = std::fmax(off, std::fabs(static_cast<double>(line.step(1.0F)) - exact));
    }
    std::printf("%zu multiplications a sample, certificate %.3g, of a step %.3g\n", found->multiplications(),
                found->error, off);
    return found->error <= 1e-4 && off <= found->error + 1e-6 ? 0 : 1;
}
