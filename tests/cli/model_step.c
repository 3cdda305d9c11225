/* Steps plant (12) as a user would: zero, then one, and says what comes out 5 s behind the dead time of 1 s. */
#include <stdio.h>
#include HEADER

int main(void)
{
    static plant_f32_instance plant;
    float y = 0.0F;
    int k;
    plant_init_f32(&plant);
    for (k = 0; k <= 6000; ++k) {
        y = plant_step_f32(&plant, 1.0F);
        if (k == 999 && y != 0.0F) {
            return 1; /* the dead time is not over */
        }
    }
    return printf("%.6f\n", (double)y) < 0;
}
