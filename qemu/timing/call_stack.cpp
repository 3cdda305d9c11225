#include "qemu/timing/call_stack.hpp"

#include <algorithm>
#include <iterator>

namespace timing {

std::size_t CallStack::arrive(std::uint32_t address) {
    if (address == sequential_) {
        return frames_.size();
    }
    std::size_t left = frames_.size();
    if (called_) {
        frames_.push_back({sequential_, false});
    } else {
        const auto back = std::find_if(frames_.rbegin(), frames_.rend(), [&](const Frame& frame) {
            return !frame.exception && frame.address == address;
        });
        if (back != frames_.rend()) {
            frames_.erase(back.base() - 1, frames_.end());
        } else if (unwound_) {
            land(address);
        }
        left = frames_.size();
    }
    if (is_exception(address)) {
        frames_.push_back({address, true});
    }
    return left;
}

// A call or jump to a handler is taken for an exception, too: the frame goes with the handler's return, or with the
// caller's below it. A handler that jumps to its own beginning stays one.
bool CallStack::is_exception(std::uint32_t address) const {
    if (!handlers_.contains(address) && (called_ || !entries_.contains(address))) {
        return false;
    }
    const auto innermost =
        std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& frame) { return frame.exception; });
    return innermost == frames_.rend() || innermost->address != address;
}

std::optional<std::uint32_t> CallStack::function_of(std::uint32_t address) const {
    const auto behind = unwinding_.functions.upper_bound(address);
    return behind == unwinding_.functions.begin() || behind == unwinding_.functions.end()
               ? std::nullopt
               : std::optional(std::prev(behind)->second);
}

void CallStack::land(std::uint32_t address) {
    const std::optional<std::uint32_t> here = function_of(address);
    const auto gone = std::find_if(frames_.rbegin(), frames_.rend(), [&](const Frame& frame) {
        return !frame.exception && function_of(frame.address) == here;
    });
    if (here && gone != frames_.rend()) {
        frames_.erase(gone.base() - 1, frames_.end());
    }
}

void CallStack::leave(const Decoded& last, std::uint32_t address, std::uint32_t next) {
    sequential_ = address + last.bytes;
    const bool jumps = next != sequential_;
    called_ = jumps && last.is_call();
    unwound_ =
        jumps && std::any_of(unwinding_.restorers.begin(), unwinding_.restorers.end(),
                             [&](const AddressRange& range) { return range.begin <= address && address < range.end; });
    if (jumps && !unwound_ && last.branch == Branch::back && !frames_.empty() && frames_.back().exception) {
        frames_.pop_back();
    }
}

}  // namespace timing
