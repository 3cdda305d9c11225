#include "qemu/timing/call_timer.hpp"

#include <algorithm>
#include <utility>

#include "qemu/timing/band.hpp"

namespace timing {

CallTimer::Core::Core(const CoreFile& core)
    : file(core), surroundings(core.sets[0].figures, core.placement, core.core), replay(core) {}

CallTimer::CallTimer(std::set<std::uint32_t> entries, const std::vector<CoreFile>& cores,
                     std::function<void(const TimedCall&)> done, std::vector<AddressRange> double_routines)
    : entries_(std::move(entries)),
      call_stack_(entries_),
      double_routines_(std::move(double_routines)),
      done_(std::move(done)) {
    for (const CoreFile& core : cores) {
        cores_.push_back(std::make_unique<Core>(core));
        call_.cores.emplace_back().half_cycles.resize(3);
    }
}

const Prepared* CallTimer::prepared(const qemu::Instruction& instruction) {
    if (instruction.index >= prepared_.size()) {
        prepared_.resize(instruction.index + std::size_t{1});
        addresses_.resize(prepared_.size());
    }
    std::unique_ptr<Prepared>& one = prepared_[instruction.index];
    if (!one) {
        one = std::make_unique<Prepared>(
            decode(instruction.encoding, instruction.bytes, it_block_.condition(), it_block_.inside()));
        addresses_[instruction.index] = instruction.address;
    }
    // Members of an IT block follow it; it is never entered in the middle.
    if (one->decoded.kind == Kind::if_then) {
        it_block_.begin(instruction.encoding);
    } else {
        it_block_.advance();
    }
    return one.get();
}

CallTimer::Piece& CallTimer::piece_of(std::vector<std::unique_ptr<Piece>>& pieces, std::uint32_t index,
                                      std::span<const qemu::Instruction> instructions) {
    if (index >= pieces.size()) {
        pieces.resize(index + std::size_t{1});
    }
    std::unique_ptr<Piece>& piece = pieces[index];
    if (piece) {
        it_block_ = piece->it_block_behind;
        return *piece;
    }
    piece = std::make_unique<Piece>();
    piece->code.index = index;
    piece->entry = entries_.contains(instructions.front().address);
    if (stretch_ && qemu::is_stretch_mark(instructions.front())) {
        piece->mark = instructions.front();
    }
    piece->in_double_routine =
        std::any_of(double_routines_.begin(), double_routines_.end(), [&](const AddressRange& range) {
            return range.begin <= instructions.front().address && instructions.front().address < range.end;
        });
    piece->met.resize(cores_.size());
    for (const qemu::Instruction& instruction : instructions) {
        const Prepared* one = prepared(instruction);
        piece->code.lines.push_back({one, instruction.index, instruction.address});
        if (const auto move = stack_move(instruction.encoding, instruction.bytes)) {
            piece->stack_moves.emplace_back(static_cast<std::uint16_t>(piece->code.lines.size() - 1), *move);
        }
        if (one->decoded.kind == Kind::unknown) {
            piece->unknown.push_back(instruction.address);
        }
    }
    piece->it_block_behind = it_block_;
    return *piece;
}

void CallTimer::executes(const qemu::Instruction& instruction) {
    if (pending_ != nullptr) {
        flush(1, instruction.address);
    }
    accesses_.clear();
    pending_ = &piece_of(singles_, instruction.index, std::span(&instruction, 1));
}

void CallTimer::executes_block(const qemu::TranslationBlock& block, std::size_t done) {
    if (pending_ != nullptr) {
        flush(done, block.instructions.front().address);
    }
    accesses_.clear();
    pending_ = &piece_of(blocks_, block.index, block.instructions);
}

void CallTimer::finish() { finish(pending_ != nullptr ? pending_->code.lines.size() : 0); }

void CallTimer::finish(std::size_t done) {
    if (pending_ != nullptr) {
        const CodeBlock::Instruction& last = pending_->code.lines.back();
        flush(done, last.address + last.instruction->decoded.bytes);
        pending_ = nullptr;
    }
}

void CallTimer::flush(std::size_t done, std::uint32_t next) {
    Piece& piece = *pending_;
    const std::vector<CodeBlock::Instruction>& lines = piece.code.lines;
    done = std::clamp<std::size_t>(done, 1, lines.size());
    const std::size_t left = call_stack_.arrive(lines.front().address);
    const bool ends = inside_ && (stretch_ ? ends_stretch(piece) : left < depth_);
    const bool begins = stretch_ ? std::exchange(stretch_begins_, false) : piece.entry && (!inside_ || ends);
    recursive_ = recursive_ || (piece.entry && inside_ && !ends && call_stack_.called());
    for (const std::uint32_t address : piece.unknown) {
        if (address <= lines[done - 1].address) {
            ++unknown_[address];
        }
    }
    if (done < lines.size()) {
        piece.met.assign(cores_.size(), {});  // what is kept there is of whole blocks
    }
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        cores_[c]->surroundings.meet(std::span(lines).first(done), accesses_, next, piece.met[c]);
    }
    if (piece.in_double_routine) {
        enter_double_routine();
    }
    if (ends || begins || done < lines.size()) {
        time_by_steps(piece, done, ends, begins);
        if (done < lines.size()) {
            piece.met.assign(cores_.size(), {});
        }
    } else {
        for (std::size_t c = 0; c < cores_.size(); ++c) {
            cores_[c]->replay.execute(piece.code, piece.met[c], inside_);
        }
        call_.instructions += inside_ ? done : 0;
        follow_stack(piece, 0, done);
    }
    if (piece.in_double_routine && inside_) {
        leave_double_routine();
    }
    if (piece.mark) {
        stretch_marks_.meet(*piece.mark);
        stretch_begins_ = stretch_marks_.open() == stretch_;
    }
    const CodeBlock::Instruction& last = lines[done - 1];
    last_site_ = last.site;
    last_address_ = last.address;
    if (!fault_ && fault_handlers_.contains(next)) {
        fault_ = last.address;
    }
    call_stack_.leave(last.instruction->decoded, last.address, next);
}

// A call ends and begins with a block's first instruction.
void CallTimer::time_by_steps(const Piece& piece, std::size_t done, bool ends, bool begins) {
    for (std::size_t nth = 0; nth < done; ++nth) {
        const CodeBlock::Instruction& line = piece.code.lines[nth];
        for (std::size_t c = 0; c < cores_.size(); ++c) {
            const SiteTime moved = cores_[c]->replay.execute(line, piece.met[c].events[nth]);
            if (inside_) {
                cores_[c]->replay.count(ends && nth == 0 ? last_site_ : line.site, moved);
            }
        }
        if (ends && nth == 0) {
            end_call();
        }
        if (begins && nth == 0) {
            begin_call(stretch_.value_or(line.address));
            if (ends_stretch(piece)) {  // an empty one
                end_call();
            }
        }
        call_.instructions += inside_ ? 1 : 0;
        follow_stack(piece, nth, nth + 1);
    }
}

void CallTimer::follow_stack(const Piece& piece, std::size_t from, std::size_t done) {
    for (const auto& [nth, move] : piece.stack_moves) {
        if (from <= nth && nth < done) {
            const auto by = [nth = nth](const qemu::Access& access) { return access.by >= nth; };
            const auto first = std::find_if(accesses_.begin(), accesses_.end(), by);
            const auto last = std::find_if(first, accesses_.end(),
                                           [nth = nth](const qemu::Access& access) { return access.by != nth; });
            stack_.follow(move, std::span(first, last));
        }
    }
}

void CallTimer::enter_double_routine() {
    for (const auto& core : cores_) {
        core->before = core->replay.core().positions();
        core->lost_before = core->replay.core().losses();
    }
}

// All that its block took, whatever it was lost to.
void CallTimer::leave_double_routine() {
    for (const auto& core : cores_) {
        for (std::size_t s = 0; s < core->in_double.size(); ++s) {
            core->in_double[s] += core->replay.core().positions()[s] - core->before[s];
        }
        for (std::size_t e = 0; e < effect_count; ++e) {
            core->lost_in_double[e] += core->replay.core().losses()[e] - core->lost_before[e];
        }
    }
}

void CallTimer::begin_call(std::uint32_t entry) {
    inside_ = true;
    depth_ = call_stack_.depth();
    call_.entry = entry;
    call_.instructions = 0;
    stack_.begin();
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        Core& core = *cores_[c];
        core.begun = core.before = core.replay.core().positions();
        core.lost_before = call_.cores[c].losses = core.replay.core().losses();
        core.in_double = {};
        core.lost_in_double = {};
    }
}

void CallTimer::end_call() {
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        const Core& core = *cores_[c];
        std::array<std::int64_t, CoreFile::most_sets> taken{};
        for (std::size_t s = 0; s < taken.size(); ++s) {
            taken[s] = core.replay.core().positions()[s] - core.begun[s] -
                       (core.file.double_in_software_off ? core.in_double[s] : 0);
        }
        for (std::size_t e = 0; e < effect_count; ++e) {
            call_.cores[c].losses[e] =
                core.replay.core().losses()[e] - call_.cores[c].losses[e] - core.lost_in_double[e];
        }
        const Band band = band_of(core.file, std::span(taken).first(core.file.sets.size()),
                                  call_.cores[c].losses[index(Effect::branch_mispredict)]);
        call_.cores[c].half_cycles = {taken[0], band.low, band.high};
        call_.cores[c].sets.assign(taken.begin(), taken.begin() + core.file.sets.size());
        call_.cores[c].double_in_software = core.file.double_in_software_off ? 0 : core.in_double[0];
    }
    call_.stack_bytes = stack_.deepest();
    inside_ = false;
    done_(call_);
}

std::vector<std::map<std::uint32_t, HotSpot>> CallTimer::hot() const {
    std::vector<std::map<std::uint32_t, HotSpot>> tables(cores_.size());
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        auto address = addresses_.begin();
        for (const auto& [half_cycles, lost] : cores_[c]->replay.times()) {
            const auto most = std::max_element(lost.begin(), lost.end());
            if (half_cycles != 0) {
                tables[c][*address] = {half_cycles, static_cast<Effect>(most - lost.begin()), *most};
            }
            ++address;
        }
    }
    return tables;
}

}  // namespace timing
