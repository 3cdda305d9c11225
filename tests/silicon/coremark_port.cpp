// What CoreMark asks of a port, on the emulated board: no clock, no printing; the timing model watches `iterate`.
#include <cstdint>

#include "port.hpp"

extern "C" {
// The seeds of its performance run, and its iterations.
volatile std::int32_t seed1_volatile = 0;
volatile std::int32_t seed2_volatile = 0;
volatile std::int32_t seed3_volatile = 0x66;
volatile std::int32_t seed4_volatile = 10;
volatile std::int32_t seed5_volatile = 0;
std::uint32_t default_num_contexts = 1;

void start_time() {}
void stop_time() {}
std::uint32_t get_time() { return 1; }
double time_in_secs(std::uint32_t ticks) { return ticks; }
void portable_init(void* /*portable*/, int* /*argc*/, char** /*argv*/) {}
void portable_fini(void* /*portable*/) {}
int ee_printf(const char* /*format*/, ...) { return 0; }

int coremark_main();
}

int firmware_main() {
    coremark_main();
    return 0;
}
