/* Steps plant (12) as a user would: zero, then one, and says what comes out 5 s behind the dead time of 1 s. -DQ31: of a
 * header in that format with 2 as the input's full scale. */
#include <stdio.h>
#include HEADER

#ifdef Q31
static plant_q31_instance plant;
static void initialise(void) { plant_init_q31(&plant); }
static double step(void) { return plant_step_q31(&plant, INT32_C(1) << 30) * (PLANT_Q31_OUTPUT_FULL_SCALE / 2147483648.0); }
#else
static plant_f32_instance plant;
static void initialise(void) { plant_init_f32(&plant); }
static double step(void) { return (double)plant_step_f32(&plant, 1.0F); }
#endif

int main(void)
{
    double y = 0.0;
    int k;
    initialise();
    for (k = 0; k <= 6000; ++k) {
        y = step();
        if (k == 999 && y > 0.0) {
            return 1; /* the dead time is not over */
        }
    }
    return printf("%.6f\n", y) < 0;
}
