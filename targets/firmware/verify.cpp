// verify: do generated headers compute the bits of their kernels here? Linked with C code that `glsum generate` makes
// of the headers; the plugin counts their steps meanwhile. Answers `row <n> <result of the self-check, 0 for all
// bits>`.
#include "targets/firmware/plan.hpp"

extern "C" {
extern const unsigned glsum_verified_count;
/// The self-check of one header, then the calls that are counted.
unsigned glsum_verify(unsigned number);
}

int firmware_main() {
    for (unsigned number = 0; number < glsum_verified_count; ++number) {
        firmware::Answer("row").number(number).number(glsum_verify(number)).write();
    }
    firmware::Answer("end").number(glsum_verified_count).write();
    return 0;
}
