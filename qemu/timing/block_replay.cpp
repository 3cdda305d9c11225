#include "qemu/timing/block_replay.hpp"

#include <algorithm>

namespace timing {
namespace {

// Past these all is forgotten and begun anew.
constexpr std::size_t most_steps = std::size_t{1} << 16;
constexpr std::size_t most_words = std::size_t{1} << 21;

}  // namespace

BlockReplay::BlockReplay(const CoreFile& core) : replay_(core) { forget(); }

bool BlockReplay::is(const Step& step, const CodeBlock& block, const BlockEvents& met) const {
    return step.block == &block && step.state == replay_.state() && step.key_words == met.key().size() &&
           std::equal(met.key().begin(), met.key().end(), keys_.begin() + step.key_begins);
}

std::uint64_t BlockReplay::hash(std::uint32_t state, const CodeBlock& block, std::span<const std::uint64_t> key) const {
    std::uint64_t hash = mix(0, std::uint64_t{state} << 32 | block.index);
    for (const std::uint64_t word : key) {
        hash = mix(hash, word);
    }
    return hash;
}

void BlockReplay::execute(const CodeBlock& block, const BlockEvents& met, bool counted) {
    if (replay_.epoch() != epoch_) {
        forget();
    }
    if (met.key().empty()) {
        execute_steps(block, met, counted, false, 0);
        return;
    }
    const std::uint32_t expected = steps_[last_step_].followed_by;
    if (expected != 0 && is(steps_[expected], block, met)) {
        take(expected, counted);
        return;
    }
    std::size_t place = hash(replay_.state(), block, met.key()) & (places_.size() - 1);
    while (places_[place] != 0 && !is(steps_[places_[place]], block, met)) {
        place = (place + 1) & (places_.size() - 1);
    }
    if (places_[place] != 0) {
        steps_[last_step_].followed_by = last_step_ != 0 ? places_[place] : 0;
        take(places_[place], counted);
        return;
    }
    if (steps_.size() >= most_steps || keys_.size() + moves_.size() + site_losses_.size() >= most_words) {
        forget();
        execute(block, met, counted);
        return;
    }
    execute_steps(block, met, counted, true, place);
}

void BlockReplay::take(std::uint32_t number, bool counted) {
    Step& step = steps_[number];
    replay_.jump(step.next_state, step.moved,
                 std::span(losses_).subspan(step.losses_begin, step.losses_end - step.losses_begin));
    step.counted += counted ? 1 : 0;
    last_step_ = number;
}

// Instruction by instruction. \param keep  as a step, at this place
void BlockReplay::execute_steps(const CodeBlock& block, const BlockEvents& met, bool counted, bool keep,
                                std::size_t place) {
    const std::uint32_t before = last_step_;
    const auto positions = replay_.positions();
    const Losses losses = replay_.losses();
    Step step;
    step.state = replay_.state();
    step.block = &block;
    step.moves_begin = static_cast<std::uint32_t>(moves_.size());
    step.site_losses_begin = static_cast<std::uint32_t>(site_losses_.size());
    for (std::size_t nth = 0; nth < block.lines.size(); ++nth) {
        const CodeBlock::Instruction& line = block.lines[nth];
        const SiteTime moved = execute(line, met.events[nth]);
        if (counted) {
            count(line.site, moved);
        }
        if (!keep) {
            continue;
        }
        moves_.push_back(static_cast<std::int32_t>(moved.half_cycles));
        for (std::uint32_t e = 0; e < effect_count; ++e) {
            if (moved.lost[e] != 0) {
                site_losses_.push_back(
                    {static_cast<std::uint32_t>(nth), {e, static_cast<std::int32_t>(moved.lost[e])}});
            }
        }
    }
    if (!keep) {
        return;
    }
    if (replay_.epoch() != epoch_) {
        forget();  // the state in which it began has no number any more
        return;
    }
    step.key_begins = static_cast<std::uint32_t>(keys_.size());
    step.key_words = static_cast<std::uint32_t>(met.key().size());
    keys_.insert(keys_.end(), met.key().begin(), met.key().end());
    step.next_state = replay_.state();
    for (std::size_t s = 0; s < step.moved.size(); ++s) {
        step.moved[s] = static_cast<std::int32_t>(replay_.positions()[s] - positions[s]);
    }
    step.losses_begin = static_cast<std::uint32_t>(losses_.size());
    for (std::size_t e = 0; e < effect_count; ++e) {
        if (replay_.losses()[e] != losses[e]) {
            losses_.push_back(
                {static_cast<std::uint32_t>(e), static_cast<std::int32_t>(replay_.losses()[e] - losses[e])});
        }
    }
    step.losses_end = static_cast<std::uint32_t>(losses_.size());
    step.site_losses_end = static_cast<std::uint32_t>(site_losses_.size());
    const auto number = static_cast<std::uint32_t>(steps_.size());
    steps_.push_back(step);
    places_[place] = number;
    steps_[before].followed_by = before != 0 ? number : 0;
    last_step_ = number;
    if (2 * steps_.size() > places_.size()) {
        grow();
    }
}

SiteTime BlockReplay::execute(const CodeBlock::Instruction& line, const Event& event) {
    const std::int64_t before = replay_.positions()[0];
    const Losses lost_before = replay_.losses();
    replay_.execute(line.site, *line.instruction, event);
    last_step_ = 0;
    SiteTime time{replay_.positions()[0] - before, {}};
    for (std::size_t e = 0; e < effect_count; ++e) {
        time.lost[e] = replay_.losses()[e] - lost_before[e];
    }
    return time;
}

SiteTime& BlockReplay::at(std::vector<SiteTime>& times, std::uint32_t site) {
    if (site >= times.size()) {
        times.resize(site + std::size_t{1});
    }
    return times[site];
}

void BlockReplay::count(std::uint32_t site, const SiteTime& time) {
    SiteTime& all = at(times_, site);
    all.half_cycles += time.half_cycles;
    for (std::size_t e = 0; e < effect_count; ++e) {
        all.lost[e] += time.lost[e];
    }
}

void BlockReplay::add_counted(std::vector<SiteTime>& times) const {
    for (const Step& step : steps_) {
        if (step.counted == 0) {
            continue;
        }
        const auto counted = static_cast<std::int64_t>(step.counted);
        const std::vector<CodeBlock::Instruction>& lines = step.block->lines;
        for (std::size_t nth = 0; nth < lines.size(); ++nth) {
            at(times, lines[nth].site).half_cycles += counted * moves_[step.moves_begin + nth];
        }
        for (std::uint32_t i = step.site_losses_begin; i < step.site_losses_end; ++i) {
            const auto& [nth, loss] = site_losses_[i];
            at(times, lines[nth].site).lost[loss.effect] += counted * loss.half_cycles;
        }
    }
}

std::vector<SiteTime> BlockReplay::times() const {
    std::vector<SiteTime> all = times_;
    add_counted(all);
    return all;
}

void BlockReplay::forget() {
    add_counted(times_);
    steps_.assign(1, {});
    keys_.clear();
    moves_.clear();
    losses_.clear();
    site_losses_.clear();
    places_.assign(1024, 0);
    last_step_ = 0;
    epoch_ = replay_.epoch();
}

void BlockReplay::grow() {
    places_.assign(2 * places_.size(), 0);
    for (std::uint32_t number = 1; number < steps_.size(); ++number) {
        const Step& step = steps_[number];
        std::size_t place = hash(step.state, *step.block, std::span(keys_).subspan(step.key_begins, step.key_words)) &
                            (places_.size() - 1);
        while (places_[place] != 0) {
            place = (place + 1) & (places_.size() - 1);
        }
        places_[place] = number;
    }
}

}  // namespace timing
