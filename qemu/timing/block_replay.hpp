// A core under all its rule sets at once, block by block: what a whole block did before, begun in the same state and
// meeting the same, it does again. As exact as `Replay`, on whose steps it stands: states and keys are compared whole.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "qemu/timing/block_events.hpp"
#include "qemu/timing/prepared.hpp"
#include "qemu/timing/replay.hpp"

namespace timing {

/// What an instruction took, and the part of it that was lost, in half cycles of the nominal set.
struct SiteTime {
    std::int64_t half_cycles = 0;
    Losses lost{};
};

class BlockReplay {
public:
    explicit BlockReplay(const CoreFile& core);

    /// \param counted  whether what it takes is added to its instructions' (`times`)
    void execute(const CodeBlock& block, const BlockEvents& met, bool counted);
    /// One instruction. \return what it moved the nominal set on by
    SiteTime execute(const CodeBlock::Instruction& line, const Event& event);
    void count(std::uint32_t site, const SiteTime& time);

    [[nodiscard]] const Replay& core() const { return replay_; }
    /// What blocks did that it need not go through again.
    [[nodiscard]] std::size_t remembered() const { return steps_.size() - 1; }
    /// Half cycles before each instruction's issue, as far as they were counted, by site.
    [[nodiscard]] std::vector<SiteTime> times() const;

private:
    struct Step {
        std::uint32_t state = 0;
        std::uint32_t key_begins = 0;
        std::uint32_t key_words = 0;
        std::uint32_t next_state = 0;
        std::uint32_t moves_begin = 0;  // of each instruction, of the nominal set
        std::uint32_t losses_begin = 0;
        std::uint32_t losses_end = 0;
        std::uint32_t site_losses_begin = 0;
        std::uint32_t site_losses_end = 0;
        std::uint32_t followed_by = 0;  // the step that came behind it last
        const CodeBlock* block = nullptr;
        std::uint64_t counted = 0;  // times
        std::array<std::int32_t, CoreFile::most_sets> moved{};
    };

    /// What one instruction of a block lost.
    struct SiteLoss {
        std::uint32_t nth;
        Replay::Loss loss;
    };

    static SiteTime& at(std::vector<SiteTime>& times, std::uint32_t site);
    [[nodiscard]] bool is(const Step& step, const CodeBlock& block, const BlockEvents& met) const;
    [[nodiscard]] std::uint64_t hash(std::uint32_t state, const CodeBlock& block,
                                     std::span<const std::uint64_t> key) const;
    void take(std::uint32_t number, bool counted);
    void execute_steps(const CodeBlock& block, const BlockEvents& met, bool counted, bool keep, std::size_t place);
    void add_counted(std::vector<SiteTime>& times) const;
    void forget();
    void grow();

    Replay replay_;
    std::uint64_t epoch_ = 0;  // of the numbers of the states
    std::vector<Step> steps_;  // the first is none
    std::vector<std::uint64_t> keys_;
    std::vector<std::int32_t> moves_;
    std::vector<Replay::Loss> losses_;
    std::vector<std::uint32_t> places_;  // by hash, open addressing; 0: free
    std::uint32_t last_step_ = 0;
    std::vector<SiteLoss> site_losses_;
    std::vector<SiteTime> times_;
};

}  // namespace timing
