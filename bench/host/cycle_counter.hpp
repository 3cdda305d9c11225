// Cycles on the host: the core's own counter where the machine gives one, else the time-stamp counter.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

class CycleCounter {
public:
    CycleCounter();
    /// Takes over an open counter, whose reads give 64 bits, and closes it at its end, or at once where it does not
    /// count. \param counter  its file, or -1: none
    explicit CycleCounter(int counter);
    CycleCounter(const CycleCounter&) = delete;
    CycleCounter& operator=(const CycleCounter&) = delete;
    ~CycleCounter();
    /// One for the process, opened when first asked for.
    static const CycleCounter& shared();

    [[nodiscard]] std::uint64_t read() const;
    /// "core cycles (perf_event)", or "time-stamp counter": reference cycles, which differ from core cycles under
    /// turbo.
    [[nodiscard]] std::string name() const;

private:
    int perf_;
};

}  // namespace bench
