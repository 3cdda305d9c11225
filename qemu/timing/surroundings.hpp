// What lies around the core and knows no time: caches, the flash's buffers, the branch predictor, which word was stored
// last. Told each executed instruction, it says what the core meets there. One for a core file, whatever its rule sets.
#pragma once

#include <cstdint>
#include <span>

#include "qemu/stream/stream.hpp"
#include "qemu/timing/block_events.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/predictor.hpp"
#include "qemu/timing/prepared.hpp"
#include "qemu/timing/stored_words.hpp"

namespace timing {

class Surroundings {
public:
    /// \param core  whether it predicts branches, at all
    Surroundings(const Figures& figures, const Placement& placement, Core core);
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;
    /// \param next  address of the instruction that is executed after it
    /// \return valid up to the next call
    const Event& meet(const Decoded& d, std::uint32_t address, std::span<const qemu::Access> accesses,
                      std::uint32_t next);
    /// The same for each instruction of a block.
    /// \param lines  the block's, or as many of its first as were executed
    /// \param next   address of the instruction that is executed after the last of them
    /// \param met    as the last call left it for this block, or new
    void meet(std::span<const CodeBlock::Instruction> lines, std::span<const qemu::Access> accesses, std::uint32_t next,
              BlockEvents& met);

    [[nodiscard]] const Memory& memory() const { return memory_; }

private:
    void fetch(const Decoded& d, std::uint32_t address, Event& event);
    void access(std::span<const qemu::Access> accesses, Event& event);
    void follow(const Decoded& d, std::uint32_t address, std::uint32_t next, Event& event);
    void load(std::span<const qemu::Access> accesses, AccessEvent& event, Effect& effect);
    void store(std::span<const qemu::Access> accesses, Event& event);

    const Figures figures_;  // memory_ refers to it
    bool predicts_;
    unsigned fetch_shift_;
    Memory memory_;
    Predictor predictor_;
    std::uint32_t fetched_ = 0xFFFFFFFFU;  // number of the word at hand
    StoredWords stored_words_;
    Event event_;
};

}  // namespace timing
