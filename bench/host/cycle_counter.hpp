// Cycles on the host: the core's own counter where the machine gives one, else the time-stamp counter.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

class CycleCounter {
public:
    CycleCounter();
    CycleCounter(const CycleCounter&) = delete;
    CycleCounter& operator=(const CycleCounter&) = delete;
    ~CycleCounter();

    [[nodiscard]] std::uint64_t read() const;
    /// "core cycles (perf)", or "time-stamp counter": reference cycles, which differ from core cycles under turbo.
    [[nodiscard]] std::string name() const;

private:
    int perf_ = -1;
};

}  // namespace bench
