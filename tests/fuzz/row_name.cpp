// A row's name from anywhere: what is taken apart is put together again.
#include <string>

#include "bench/rows/results.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string name = fuzz::to_text(data, size);
    const auto key = bench::parse_key(name);
    if (!key) {
        return 0;
    }
    std::string again = "gl/" + key->kernel + "/order:" + key->order + "/taps:" + key->taps + '/' + key->aspect;
    if (!key->signal.empty()) {
        again += "/signal:" + key->signal;
    }
    if (!key->amplitude.empty()) {
        again += "/amplitude:" + key->amplitude;
    }
    fuzz::expect(again == name);
    return 0;
}
