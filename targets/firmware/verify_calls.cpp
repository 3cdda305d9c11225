// Makes the calls that `glsum generate --verify` counts and times, for its C code.
#include "marker.hpp"

extern "C" void glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned call));

void glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned call)) {
    const firmware::TimedCalls calls{taps, software_double != 0};
    firmware::Marker marker(calls);
    for (unsigned call = 0; call < calls.calls(); ++call) {
        marker.before(call);
        make(call);
    }
}
