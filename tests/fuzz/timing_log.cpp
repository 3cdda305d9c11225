// What the timer wrote, and what it is asked, from anywhere.
#include <sstream>
#include <stdexcept>

#include "qemu/timing/timing_log.hpp"
#include "tests/fuzz/refused.hpp"

namespace {

template <class Read>
void read(const Read& read, const std::string& text) {
    std::istringstream in(text);
    try {
        read(in);
    } catch (const std::runtime_error&) {  // how it refuses
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::to_text(data, size);
    read(
        [](std::istream& in) {
            for (const timing::TimedRun& run : timing::read_timing_log(in).runs) {
                fuzz::expect(run.calls > 0);
            }
        },
        text);
    read([](std::istream& in) { (void)timing::read_timing_request(in); }, text);
    return 0;
}
