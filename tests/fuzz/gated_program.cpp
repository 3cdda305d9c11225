// A baseline of a program's functions, from anywhere: what is taken is written as it was read.
#include "qemu/emulate/gated_program.hpp"

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const qemu::GatedProgram program = qemu::parse_gated_program(fuzz::to_text(data, size), "file");
        const std::string text = qemu::to_json(program, "why");
        fuzz::expect(qemu::to_json(qemu::parse_gated_program(text, "again"), "why") == text);
    });
    return 0;
}
