// A stranger's firmware: the half derivative of a ramp with a generated header, checked against the closed form
// D^0.5 t = 2 sqrt(t / pi). half_derivative.h is made, and made again, by the command in its comment.
#include "half_derivative.h"

#include <cmath>

#include "port.hpp"

int firmware_main() {
    static half_f32_instance line;
    if (half_self_check_f32(&line) != 0U) {
        port::write("example: the header does not compute the bits of its kernel here\n");
        return 1;
    }
    half_init_f32(&line);
    // 150 samples, fewer than the memory holds: what is left is the discretisation, of first order in h.
    constexpr float step_s = 0.001F;
    float t = 0.0F;
    float derivative = 0.0F;
    for (int k = 0; k <= 150; ++k) {
        t = static_cast<float>(k) * step_s;
        derivative = HALF_F32_STEP_FACTOR * half_step_f32(&line, t);
    }
    const float exact = 2.0F * std::sqrt(t / 3.14159265F);
    const bool good = std::fabs(derivative - exact) < 0.005F * exact;
    port::write(good ? "example: the half derivative of a ramp, within 0.5 %\n" : "example: wrong\n");
    return good ? 0 : 1;
}
