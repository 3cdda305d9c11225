// The firmware's build_info.json from anywhere.
#include "bench/target/target_build.hpp"

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const bench::TargetBuild build = bench::parse_target_build(fuzz::to_text(data, size), "file");
        fuzz::expect(build.compiler.size() + build.flags.size() <= size);
    });
    return 0;
}
