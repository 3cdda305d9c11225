// One of the loops behind the rows of results/silicon, TAPS long: warm, as it was measured.
#include <cstdint>

extern "C" void LOOP(void* memory, std::uint32_t taps, std::int32_t newest_q31, float newest_f32);

int firmware_main() {
    alignas(8) static std::int32_t memory[128 + 130];  // coefficients and samples: zeros take as long as any
    for (int call = 0; call < 16; ++call) {
        LOOP(memory, TAPS, 1 << 20, 0.25F);
    }
    return 0;
}
