#include "qemu/timing/call_timer.hpp"

#include <algorithm>
#include <utility>

namespace timing {

CallTimer::CallTimer(std::set<std::uint32_t> entries, const std::vector<CoreFile>& cores,
                     std::function<void(const TimedCall&)> done)
    : entries_(std::move(entries)), done_(std::move(done)), positions_(cores.size()) {
    for (const CoreFile& core : cores) {
        models_.emplace_back();
        for (const RuleSet& set : core.sets) {
            models_.back().push_back(std::make_unique<Model>(set.figures, core.placement, core.off));
        }
        call_.cores.emplace_back().half_cycles.resize(core.sets.size());
    }
}

CallTimer::Site& CallTimer::site_of(const qemu::Instruction& instruction) {
    if (instruction.index >= sites_.size()) {
        sites_.resize(instruction.index + 1);
    }
    Site& site = sites_[instruction.index];
    if (!site.prepared) {
        const bool inside = it_block_.inside();
        site.prepared = std::make_unique<Prepared>(
            decode(instruction.encoding, instruction.bytes, it_block_.condition(), inside));
        site.address = instruction.address;
        site.entry = entries_.contains(instruction.address);
        site.half_cycles.resize(models_.size());
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
    for (std::size_t c = 0; c < models_.size(); ++c) {
        CoreTime& time = call_.cores[c];
        for (std::size_t s = 0; s < models_[c].size(); ++s) {
            Model& model = *models_[c][s];
            const std::int64_t position = model.execute(*site.prepared, site.address, accesses_, next);
            if (s == 0) {
                if (inside_) {
                    (ends ? sites_[last_] : site).half_cycles[c] += position - positions_[c];
                }
                positions_[c] = position;
                if (ends) {
                    for (std::size_t e = 0; e < effect_count; ++e) {
                        time.losses[e] = model.losses()[e] - time.losses[e];
                    }
                }
            }
            if (ends) {
                time.half_cycles[s] = position - time.half_cycles[s];
            }
        }
    }
    if (ends) {
        inside_ = false;
        done_(call_);
    }
    if (begins) {
        inside_ = true;
        depth_ = returns_.size();
        call_.entry = site.address;
        call_.instructions = 0;
        for (std::size_t c = 0; c < models_.size(); ++c) {
            for (std::size_t s = 0; s < models_[c].size(); ++s) {
                call_.cores[c].half_cycles[s] = models_[c][s]->position();
            }
            call_.cores[c].losses = models_[c][0]->losses();
        }
    }
    if (inside_) {
        ++call_.instructions;
    }
    last_ = pending_;
    sequential_ = site.address + d.bytes;
    last_called_ = (d.branch == Branch::call || (d.branch == Branch::indirect && d.write_count > 0 &&
                                                 d.writes[0].reg == registers::lr)) &&
                   next != sequential_;
}

std::vector<std::map<std::uint32_t, std::int64_t>> CallTimer::hot() const {
    std::vector<std::map<std::uint32_t, std::int64_t>> tables(models_.size());
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
