// A stranger's program for this machine: a filter fitted to the half derivative over 1 to 50 Hz at 1 kHz, one tap and
// three modes. Exit 0 where it is certified within 5 %.
#include <cstdio>
#include <glsum/design/band.hpp>

int main() {
    const glsum::design::DerivativeGoal goal{
        .order = 0.5, .step_s = 1e-3, .band = glsum::design::Band{.low_hz = 1.0, .high_hz = 50.0}};
    const auto found = glsum::design::fit_filter(goal, 1, 3, glsum::design::FilterKind::samples);
    const double error = glsum::design::certified_error(found.filter(), goal).band;
    std::printf("one tap and three modes over 1 to 50 Hz: within %.3g\n", error);
    return error > 0.0 && error <= 0.05 ? 0 : 1;
}
