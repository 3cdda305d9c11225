// A firmware with a function of its own to time: glsum time --elf build/mps2-an500/targets/biquad.elf --function
// biquad_step
#include "port.hpp"

struct Biquad {
    float b0, b1, b2, a1, a2;
    float s1 = 0.0F;
    float s2 = 0.0F;
};

// One section in the transposed direct form II. Kept whole: what is inlined has no time of its own.
extern "C" [[gnu::noinline, gnu::noclone]] float biquad_step(Biquad* filter, float x) {
    const float y = filter->b0 * x + filter->s1;
    filter->s1 = filter->b1 * x - filter->a1 * y + filter->s2;
    filter->s2 = filter->b2 * x - filter->a2 * y;
    return y;
}

int firmware_main() {
    static Biquad filter{0.2F, 0.4F, 0.2F, -0.7F, 0.3F};
    float sum = 0.0F;
    for (int k = 0; k < 1000; ++k) {
        sum += biquad_step(&filter, static_cast<float>(k % 50));
    }
    return sum > 0.0F ? 0 : 1;
}
