// Marks the calls to time, as the timing model that watches the program expects it.
#pragma once

#include <cstddef>

#include "marks.hpp"
#include "shared/timed_calls.hpp"

namespace firmware {

class Marker {
public:
    explicit Marker(TimedCalls timed) : timed_(timed) {}
    ~Marker() { switch_to(false); }
    Marker(const Marker&) = delete;
    Marker& operator=(const Marker&) = delete;
    void before(std::size_t call) {
        if (call == 0) {
            glsum_mark_row();
        }
        switch_to(timed_.contains(call));
    }

private:
    void switch_to(bool on) {
        if (on != on_) {
            (on ? glsum_mark_on : glsum_mark_off)();
            on_ = on;
        }
    }
    TimedCalls timed_;
    bool on_ = false;
};

}  // namespace firmware
