#include <stdio.h>

#include "half_derivative.h"

static half_derivative_f32_instance line;

__attribute__((noinline)) float ctrl_step(float x)
{
    return HALF_DERIVATIVE_F32_STEP_FACTOR * half_derivative_step_f32(&line, x);
}

int main(void)
{
    half_derivative_init_f32(&line);
    for (int k = 0; k <= 1000; ++k) { /* a unit step, for a second at 1 kHz */
        const float derivative = ctrl_step(1.0F);
        if (k == 10 || k == 100 || k == 1000) {
            printf("%4d ms: %.3f\n", k, (double)derivative);
        }
    }
    return 0;
}
