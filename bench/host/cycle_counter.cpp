#include "bench/host/cycle_counter.hpp"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace bench {

namespace {

int open_counter() {
    perf_event_attr attributes{};
    attributes.type = PERF_TYPE_HARDWARE;
    attributes.size = sizeof attributes;
    attributes.config = PERF_COUNT_HW_CPU_CYCLES;
    attributes.exclude_kernel = 1;
    attributes.exclude_hv = 1;
    return static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

}  // namespace

CycleCounter::CycleCounter() : CycleCounter(open_counter()) {}

CycleCounter::CycleCounter(int counter) : perf_(counter) {
    std::uint64_t value = 0;
    if (perf_ >= 0 && (::read(perf_, &value, sizeof value) != sizeof value || value == 0)) {
        close(perf_);  // it opens but does not count: some virtual machines
        perf_ = -1;
    }
}

CycleCounter::~CycleCounter() {
    if (perf_ >= 0) {
        close(perf_);
    }
}

const CycleCounter& CycleCounter::shared() {
    static const CycleCounter counter;
    return counter;
}

std::uint64_t CycleCounter::read() const {
    std::uint64_t value = 0;
    if (perf_ >= 0 && ::read(perf_, &value, sizeof value) == sizeof value) {
        return value;
    }
#if defined(__x86_64__)
    return __rdtsc();
#elif defined(__aarch64__)
    asm volatile("mrs %0, cntvct_el0" : "=r"(value));
    return value;
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

std::string CycleCounter::name() const {
    return perf_ >= 0 ? "core cycles (perf_event)" : "time-stamp counter (reference cycles, not core cycles)";
}

}  // namespace bench
