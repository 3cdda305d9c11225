// What the emulated board does not have: clocks to set, a cycle counter that counts, caches.
#include "port.hpp"

namespace port {

void start() {}
std::uint32_t cycles() { return 0; }
Memories memories() { return {"itcm", "dtcm", false, "emulated"}; }
void maintain_data_cache() {}

}  // namespace port
