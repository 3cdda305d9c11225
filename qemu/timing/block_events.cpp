#include "qemu/timing/block_events.hpp"

namespace timing {

// Of the instructions whose events vary: the first, whose word may be at hand, those that access memory, those that
// wait for their bytes, and the last, which may branch. Which of the block's it is stands above the event's bits.
void BlockEvents::make_key() {
    static_assert(sizeof(AccessEvent) == sizeof(std::uint64_t));
    count_ = 0;
    if (events.size() >= std::size_t{1} << (64 - PackedEvent::bits)) {
        return;
    }
    words_.resize(2 * events.size());
    bool all = true;
    const auto add = [&](std::size_t nth) {
        all = all && packs(events[nth]);
        const PackedEvent word = packed(events[nth]);
        words_[count_++] = word.event | std::uint64_t{nth} << PackedEvent::bits;
        if (word.fetch_delays != 0) {
            words_[count_++] = word.fetch_delays;
        }
    };
    const std::size_t last = events.size() - 1;
    if (fetched_freely) {
        add(0);
        for (const std::uint32_t nth : touched) {
            if (nth != 0 && nth != last) {
                add(nth);
            }
        }
        if (last != 0) {
            add(last);
        }
    } else {
        for (std::size_t nth = 0; nth < events.size(); ++nth) {
            const Event& e = events[nth];
            if (nth == 0 || nth == last || e.accesses != 0 || e.fetch_delayed() || e.taken ||
                e.prediction != Prediction::right) {
                add(nth);
            }
        }
    }
    count_ = all ? count_ : 0;
}

}  // namespace timing
