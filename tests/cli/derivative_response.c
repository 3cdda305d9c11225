/* The response of a generated header, taken by running it: against (jw)^v at some frequencies, by a correlation over
   whole periods, and against t^-v / Gamma(1 - v) behind a step. Not by any formula of glsum's.
   Arguments: v, h, low and high frequency in Hz, seconds of the step. Prints both largest errors. */
#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "half.h"


int main(int count, char **word)
{
    static half_f32_instance line;
    const double pi = acos(-1.0);
    const double v = atof(word[1]);
    const double h = atof(word[2]);
    const double low = atof(word[3]);
    const double high = atof(word[4]);
    const double seconds = atof(word[5]);
    double band = 0.0;
    double step = 0.0;
    int i;
    long k;
    (void)count;
    if (half_self_check_f32(&line) != 0U) {
        puts("self-check failed");
        return 1;
    }
    for (i = 0; i <= 12; ++i) {
        /* Whole periods of a whole number of samples. */
        const double wanted = low * pow(high / low, i / 12.0);
        const long samples = (long)ceil(8.0 / (wanted * h)) * 2;
        const double cycles = floor(wanted * h * (double)samples);
        const double hz = fmin(high, fmax(low, cycles / ((double)samples * h)));
        double complex sum = 0.0;
        double complex exact;
        half_init_f32(&line);
        for (k = 0; k < 4 * samples; ++k) {
            const double angle = 2.0 * pi * hz * h * (double)k;
            const double out = HALF_F32_STEP_FACTOR * half_step_f32(&line, (float)sin(angle));
            if (k >= 3 * samples) {
                sum += out * cexp(-I * angle);
            }
        }
        sum *= 2.0 * I / (double)samples;
        exact = cpow(I * 2.0 * pi * hz, v);
        if (hz * h * (double)samples == cycles || fabs(hz * h * (double)samples - cycles) < 1e-6) {
            band = fmax(band, cabs(sum - exact) / cabs(exact));
        }
    }
    half_init_f32(&line);
    for (k = 0; k <= (long)(seconds / h + 0.5); ++k) {
        const double out = HALF_F32_STEP_FACTOR * half_step_f32(&line, 1.0F);
        if (k >= 10) {
            const double exact = pow((double)k * h, -v) / tgamma(1.0 - v);
            step = fmax(step, fabs(out / exact - 1.0));
        }
    }
    printf("band %.4f step %.4f\n", band, step);
    return band > 0.0 && step > 0.0 ? 0 : 1;
}
