// silicon: makes the calls that somebody measured on silicon, for the timing model to watch. Its argument is a file of
// lines `<kernel> <taps>`; each is called until caches and branch predictor have settled.
#include <cstddef>
#include <cstdint>

#include "plan.hpp"
#include "port.hpp"

extern "C" {
float glsum_silicon_shift_firfma_f32(void* memory, std::uint32_t taps, float newest);
std::int32_t glsum_silicon_shift_fir_q31(void* memory, std::uint32_t taps, std::int32_t newest);
}

namespace {

constexpr std::size_t most_taps = 128;
constexpr int calls = 12;  // qemu/silicon.cpp takes the last of each row
alignas(32) std::uint32_t memory[2 * most_taps + 8];

}  // namespace

int firmware_main() {
    alignas(8) static std::byte bytes[64 * 1024];
    std::string_view command = port::command_line();
    firmware::take_word(command);
    const auto file = port::read_file(firmware::take_word(command), bytes);
    std::string_view plan{reinterpret_cast<const char*>(file.data()), file.size()};
    while (!plan.empty()) {
        const std::string_view kernel = firmware::take_word(plan);
        std::uint32_t taps = 0;
        if (!firmware::to_number(firmware::take_word(plan), taps) || taps == 0 || taps > most_taps) {
            port::write("error: the loops take 1 to 128 taps\n");
            return 2;
        }
        for (int i = 0; i < calls; ++i) {
            if (kernel == "shift_firfma_f32") {
                glsum_silicon_shift_firfma_f32(memory, taps, 1.0F);
            } else if (kernel == "shift_fir_q31") {
                glsum_silicon_shift_fir_q31(memory, taps, 1);
            } else {
                port::write("error: no such loop\n");
                return 2;
            }
        }
    }
    return 0;
}
