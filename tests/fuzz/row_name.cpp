// A row's name from anywhere: what is taken apart is put together again.
#include <string>

#include "bench/rows/key.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string name = fuzz::to_text(data, size);
    const auto key = bench::parse_any_key(name);
    fuzz::expect(!key || to_name(*key) == name);
    return 0;
}
