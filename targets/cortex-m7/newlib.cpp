// What newlib asks of a system, for programs that print, allocate or throw. Linked only where something asks for it.
#include <sys/stat.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "port.hpp"

extern "C" {

extern char end[];  // of the linker script: behind all data
extern std::uint32_t link_stack_top[];

// Destructors of static objects never run: a firmware has no end.
void* __dso_handle = nullptr;
// What newlib 4.5 calls around constructors and destructors, where the compiler's own start-up files are left out.
void _init() {}
void _fini() {}

void* _sbrk(std::ptrdiff_t bytes) {
    constexpr std::uintptr_t kept_for_stack = 0x4000;
    static auto heap = reinterpret_cast<std::uintptr_t>(end);
    const std::uintptr_t most = reinterpret_cast<std::uintptr_t>(link_stack_top) - kept_for_stack;
    if (bytes > static_cast<std::ptrdiff_t>(most - heap)) {
        errno = ENOMEM;
        return reinterpret_cast<void*>(-1);
    }
    const std::uintptr_t before = heap;
    heap += static_cast<std::uintptr_t>(bytes);
    return reinterpret_cast<void*>(before);
}

int _write(int, const char* text, int bytes) {
    port::write({text, static_cast<std::size_t>(bytes)});
    return bytes;
}

[[noreturn]] void _exit(int status) { port::exit(status); }

int getentropy(void*, std::size_t) {
    errno = ENOSYS;
    return -1;
}
int _read(int, char*, int) { return 0; }
int _close(int) { return -1; }
int _lseek(int, int, int) { return 0; }
int _isatty(int) { return 1; }
int _getpid() { return 1; }
int _kill(int, int) { return -1; }
int _fstat(int, struct stat* status) {
    status->st_mode = S_IFCHR;
    return 0;
}

}  // extern "C"
