#include "qemu/timing/call_timer.hpp"

#include <algorithm>
#include <utility>

#include "qemu/timing/band.hpp"

namespace timing {

CallTimer::Core::Core(const CoreFile& core)
    : file(core), surroundings(core.sets[0].figures, core.placement), replay(core) {}

CallTimer::CallTimer(std::set<std::uint32_t> entries, const std::vector<CoreFile>& cores,
                     std::function<void(const TimedCall&)> done)
    : entries_(std::move(entries)), done_(std::move(done)) {
    for (const CoreFile& core : cores) {
        cores_.push_back(std::make_unique<Core>(core));
        call_.cores.emplace_back().half_cycles.resize(3);
    }
}

CallTimer::Site& CallTimer::site_of(const qemu::Instruction& instruction) {
    if (instruction.index >= sites_.size()) {
        sites_.resize(instruction.index + 1);
    }
    Site& site = sites_[instruction.index];
    if (!site.prepared) {
        const bool inside = it_block_.inside();
        site.prepared =
            std::make_unique<Prepared>(decode(instruction.encoding, instruction.bytes, it_block_.condition(), inside));
        site.address = instruction.address;
        site.entry = entries_.contains(instruction.address);
        site.half_cycles.resize(cores_.size());
    }
    return site;
}

void CallTimer::executes(const qemu::Instruction& instruction) {
    if (has_pending_) {
        flush(instruction.address);
    }
    const Site& site = site_of(instruction);
    // Members of an IT block follow it; it is never entered in the middle.
    if (site.prepared->decoded.kind == Kind::if_then) {
        it_block_.begin(instruction.encoding);
    } else {
        it_block_.advance();
    }
    pending_ = instruction.index;
    has_pending_ = true;
    accesses_.clear();
}

void CallTimer::accesses(const qemu::Access& access) { accesses_.push_back(access); }

void CallTimer::finish() {
    if (has_pending_) {
        flush(sites_[pending_].address + sites_[pending_].prepared->decoded.bytes);
        has_pending_ = false;
    }
}

// Whether the instruction is where a call returns to, or a watched function's first.
void CallTimer::follow_calls(const Site& site) {
    if (last_called_) {
        returns_.push_back(sequential_);
    } else if (site.address != sequential_) {
        const auto back = std::find(returns_.rbegin(), returns_.rend(), site.address);
        if (back != returns_.rend()) {
            returns_.erase(back.base() - 1, returns_.end());
        }
    }
}

void CallTimer::flush(std::uint32_t next) {
    Site& site = sites_[pending_];
    const Decoded& d = site.prepared->decoded;
    follow_calls(site);
    const bool ends = inside_ && returns_.size() < depth_;
    const bool begins = site.entry && (!inside_ || ends);
    recursive_ = recursive_ || (site.entry && inside_ && !ends && last_called_);
    if (d.kind == Kind::unknown) {
        ++unknown_[site.address];
    }
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        Core& core = *cores_[c];
        const std::int64_t before = core.replay.positions()[0];
        core.replay.execute(static_cast<std::uint32_t>(pending_), *site.prepared,
                            core.surroundings.meet(d, site.address, accesses_, next));
        if (inside_) {
            (ends ? sites_[last_] : site).half_cycles[c] += core.replay.positions()[0] - before;
        }
    }
    if (ends) {
        for (std::size_t c = 0; c < cores_.size(); ++c) {
            end_call(*cores_[c], call_.cores[c]);
        }
        inside_ = false;
        done_(call_);
    }
    if (begins) {
        inside_ = true;
        depth_ = returns_.size();
        call_.entry = site.address;
        call_.instructions = 0;
        for (std::size_t c = 0; c < cores_.size(); ++c) {
            cores_[c]->begun = cores_[c]->replay.positions();
            call_.cores[c].losses = cores_[c]->replay.losses();
        }
    }
    if (inside_) {
        ++call_.instructions;
    }
    last_ = pending_;
    sequential_ = site.address + d.bytes;
    last_called_ = (d.branch == Branch::call ||
                    (d.branch == Branch::indirect && d.write_count > 0 && d.writes[0].reg == registers::lr)) &&
                   next != sequential_;
}

void CallTimer::end_call(const Core& core, CoreTime& time) {
    std::array<std::int64_t, CoreFile::most_sets> taken{};
    for (std::size_t s = 0; s < taken.size(); ++s) {
        taken[s] = core.replay.positions()[s] - core.begun[s];
    }
    const Band band = band_of(core.file, std::span(taken).first(core.file.sets.size()));
    time.half_cycles = {taken[0], band.low, band.high};
    for (std::size_t e = 0; e < effect_count; ++e) {
        time.losses[e] = core.replay.losses()[e] - time.losses[e];
    }
}

std::vector<std::map<std::uint32_t, std::int64_t>> CallTimer::hot() const {
    std::vector<std::map<std::uint32_t, std::int64_t>> tables(cores_.size());
    for (const Site& site : sites_) {
        for (std::size_t c = 0; c < site.half_cycles.size(); ++c) {
            if (site.half_cycles[c] != 0) {
                tables[c][site.address] = site.half_cycles[c];
            }
        }
    }
    return tables;
}

}  // namespace timing
