// The plugin's log from anywhere.
#include <sstream>
#include <stdexcept>

#include "qemu/stream/call_counter.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream text(fuzz::to_text(data, size));
    try {
        const qemu::CallLog log = qemu::read_call_log(text);
        for (const qemu::CallRun& run : log.runs) {
            fuzz::expect(run.calls > 0);
        }
    } catch (const std::runtime_error&) {  // how it refuses
    }
    return 0;
}
