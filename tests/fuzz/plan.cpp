// The firmware's plan from anywhere; its first byte says how long the file of the signals is.
#include <cstring>
#include <string>

#include "targets/firmware/program.hpp"
#include "tests/fuzz/refused.hpp"

namespace {
std::string plan_text;
std::size_t signal_size = 0;
const std::byte* signals = nullptr;  // where the program read them to
std::string said;
}  // namespace

namespace port {

std::string_view command_line() { return "fuzz plan"; }
void write(std::string_view text) { said = text; }
std::span<std::byte> read_file(std::string_view path, std::span<std::byte> buffer) {
    const std::size_t size = path == "plan" ? plan_text.size() : signal_size;
    if (size > buffer.size()) {
        return {};
    }
    if (path == "plan") {
        std::memcpy(buffer.data(), plan_text.data(), size);
    } else {
        signals = buffer.data();
    }
    return buffer.first(size);
}
void exit(int) { std::abort(); }

}  // namespace port

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) {
        return 0;
    }
    signal_size = data[0];
    plan_text = fuzz::to_text(data + 1, size - 1);
    // The signals lie in a static buffer, larger than they are: no sanitizer sees where they end.
    const int status =
        firmware::run_plan([&]<class K>(const firmware::PlanRow&, firmware::Signal signal, firmware::Answer& answer) {
            const auto begin = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(signal.samples) - signals);
            fuzz::expect(signal.count > 0 && begin <= signal_size &&
                         signal.count <= (signal_size - begin) / sizeof(double));
            for (int i = 0; i < 6; ++i) {
                answer.number(~std::uint64_t{0}, 10);
            }
        });
    fuzz::expect(said.ends_with('\n') && (status == 0 ? said.starts_with("end ") : said.starts_with("error: ")));
    return 0;
}
