// The port by semihosting: a debugger or an emulator serves the calls. [Arm IHI 0100, semihosting 2.0]
#include <cstring>

#include "port.hpp"

namespace port {
namespace {

enum class Call : std::uint32_t {
    open = 0x01,
    close = 0x02,
    write = 0x05,
    read = 0x06,
    file_length = 0x0C,
    get_command_line = 0x15,
    exit_extended = 0x20,
};
constexpr std::uint32_t open_read_binary = 1;
constexpr std::uint32_t open_write = 4;
constexpr std::uint32_t application_exit = 0x20026;
constexpr std::int32_t failed = -1;

std::int32_t call(Call number, const void* arguments) {
    register std::uint32_t r0 asm("r0") = static_cast<std::uint32_t>(number);
    register const void* r1 asm("r1") = arguments;
    asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return static_cast<std::int32_t>(r0);
}

std::uint32_t word(const void* address) { return reinterpret_cast<std::uint32_t>(address); }

std::int32_t open(std::string_view path, std::uint32_t mode) {
    char name[512];
    if (path.size() >= sizeof name) {
        return failed;
    }
    std::memcpy(name, path.data(), path.size());
    name[path.size()] = '\0';
    const std::uint32_t arguments[] = {word(name), mode, static_cast<std::uint32_t>(path.size())};
    return call(Call::open, arguments);
}

}  // namespace

std::string_view command_line() {
    static char text[1024];
    std::uint32_t arguments[] = {word(text), sizeof text};
    if (call(Call::get_command_line, arguments) != 0) {
        return {};
    }
    return {text, arguments[1]};
}

void write(std::string_view text) {
    static const std::int32_t console = open(":tt", open_write);
    const std::uint32_t arguments[] = {static_cast<std::uint32_t>(console), word(text.data()),
                                       static_cast<std::uint32_t>(text.size())};
    call(Call::write, arguments);
}

std::span<std::byte> read_file(std::string_view path, std::span<std::byte> buffer) {
    const std::int32_t handle = open(path, open_read_binary);
    if (handle == failed) {
        return {};
    }
    const std::uint32_t of_handle[] = {static_cast<std::uint32_t>(handle)};
    const std::int32_t length = call(Call::file_length, of_handle);
    std::int32_t missing = failed;
    if (length >= 0 && static_cast<std::size_t>(length) <= buffer.size()) {
        const std::uint32_t arguments[] = {static_cast<std::uint32_t>(handle), word(buffer.data()),
                                           static_cast<std::uint32_t>(length)};
        missing = call(Call::read, arguments);
    }
    call(Call::close, of_handle);
    return missing == 0 ? buffer.first(static_cast<std::size_t>(length)) : std::span<std::byte>{};
}

[[noreturn]] void exit(int status) {
    const std::uint32_t arguments[] = {application_exit, static_cast<std::uint32_t>(status)};
    for (;;) {
        call(Call::exit_extended, arguments);
    }
}

}  // namespace port
