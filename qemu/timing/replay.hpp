// A core under all its rule sets at once, fast: what it did before in the same state, it does again.
//
// The pipeline's next state depends on its state, the instruction and the event alone. So each step is computed once
// and kept under these three; a step met again is looked up. Nothing is skipped or estimated: equal keys are equal in
// every bit, and the state of a key is the whole state (`Pipeline::settle`).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "qemu/timing/pipelines.hpp"

namespace timing {

class Replay {
public:
    explicit Replay(const CoreFile& core);

    /// \param site  numbers the distinct instructions; the same site always comes with the same `instruction`
    void execute(std::uint32_t site, const Prepared& instruction, const Event& event);

    /// Half cycle in which the last instruction issued, under each rule set, the nominal one first.
    [[nodiscard]] const std::array<std::int64_t, CoreFile::most_sets>& positions() const { return positions_; }
    [[nodiscard]] const Losses& losses() const { return losses_; }  ///< of the nominal set
    /// Of the state in which the core is. Equal numbers are equal states, as long as the epoch is the same.
    [[nodiscard]] std::uint32_t state() const { return state_; }
    [[nodiscard]] std::uint64_t epoch() const { return epoch_; }

    /// Half cycles that the nominal set lost to an effect.
    struct Loss {
        std::uint32_t effect;
        std::int32_t half_cycles;
    };
    /// What `execute` did before from this state, at once. \param moved  half cycles, of each set
    void jump(std::uint32_t state, const std::array<std::int32_t, CoreFile::most_sets>& moved,
              std::span<const Loss> lost);

    /// Steps that were computed; all others were looked up.
    [[nodiscard]] std::uint64_t computed() const { return computed_; }

private:
    struct Key {
        std::uint64_t state_and_site = 0;
        std::uint64_t event = 0;
        std::uint64_t fetch_delays = 0;
        bool operator==(const Key&) const = default;
    };
    struct Step {
        Key key;
        std::uint32_t next_state = 0;
        std::uint32_t followed_by = 0;  // the step that came behind it last
        std::array<std::int32_t, CoreFile::most_sets> moved{};
        std::uint8_t loss_count = 0;
        std::array<std::uint8_t, effect_count> effects{};
        std::array<std::int32_t, effect_count> lost{};
    };
    [[nodiscard]] static std::uint64_t hash(const Key& key);
    [[nodiscard]] Step compute(const Prepared& instruction, const Event& event);
    void take(const Step& step);
    void forget();
    void grow();

    std::unique_ptr<Pipelines> pipelines_;
    std::uint64_t epoch_ = 0;  // times that states were numbered anew
    std::uint32_t state_ = 0;  // the present one

    std::vector<Step> steps_;            // the first is none
    std::vector<std::uint32_t> places_;  // by hash, open addressing; 0: free
    std::uint32_t last_step_ = 0;

    std::array<std::int64_t, CoreFile::most_sets> positions_{};
    Losses losses_{};
    std::uint64_t computed_ = 0;
};

}  // namespace timing
