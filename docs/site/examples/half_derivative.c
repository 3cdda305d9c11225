/* The half derivative of a unit step at 1 kHz, by a header that glsum generated. Any kernel's header has these names. */
#include <stdio.h>

#include "half_derivative.h"

int main(void)
{
    static half_derivative_f32_instance line;
    half_derivative_init_f32(&line);
    if (half_derivative_self_check_f32(&line) != 0) {
        return 1; /* this compiler changed the kernel's bits */
    }
    half_derivative_init_f32(&line);
    for (int k = 0; k <= 1000; ++k) {
        const float derivative = HALF_DERIVATIVE_F32_STEP_FACTOR * half_derivative_step_f32(&line, 1.0F);
        if (k == 100 || k == 1000) {
            printf("%.1f s: %.4f\n", k * 1e-3, (double)derivative);
        }
    }
    return 0;
}
