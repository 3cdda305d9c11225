// A board that is pretended, with one kernel: it answers with the host's hashes, and what a call costs there follows
// from its length.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/machines.hpp"
#include "base/scratch.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "qemu/emulate/firmware.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace test {

/// `ring_plain_f32`, or a kernel whose bits nobody asks for, with up to 64 taps: 10 instructions a tap, 8 bytes of
/// state and 4 of coefficients a tap.
class PretendBoard {
public:
    /// \param samples, seed  of the noise that a choice counts on
    /// \param cycles, high   a tap, of any core that is modelled: the usual ones, and the upper end of the band
    PretendBoard(double order, std::size_t samples, std::uint64_t seed, int cycles = 20, int high = 24,
                 const base::Machine& machine = base::machines.front(), const std::string& kernel = "ring_plain_f32")
        : order_(order), samples_(samples), signals_{bench::make_signal("noise", samples, seed + 1)} {
        program(kernel).write(folder_.file("measure.elf"));
        std::ofstream(folder_.file("build_info.json")) << R"({"compiler": "GNU 12.2.1", "flags": "-O3"})";
        std::ofstream(folder_.file("check")) << check_calls();
        std::string losses;
        for (std::size_t e = 0; e < timing::effect_count; ++e) {
            losses += " 0";
        }
        // Two calls before the past is full are timed, and each of the turn that follows.
        const std::string body = fmt::format(
            R"sh([ "${{1%verify.elf}}" = "$1" ] || {{ . ./verify; exit; }}
for plan; do :; done
{{ cat check; tail -n +2 "$plan" | while read -r kernel order taps rest; do
    [ ! -e "refuse$taps" ] || continue
    turn=$((taps > 32 ? taps : 32))
    echo "calls {0} 1 100 10 5 7"; echo "calls {0} $taps 50 9 9 9"
    echo "calls {0} $turn $((10 * taps)) 2 1 1"; echo "calls {0} 1 9 9 9 9"
done; echo "reached {0} {0}"; echo end; }} >"$(of out)"
[ -z "$(of timing)" ] || tail -n +2 "$plan" | while read -r kernel order taps rest; do
    [ ! -e "refuse$taps" ] || continue
    echo "calls 1 {0} 100 core 2 1 1{1} 0"
    echo "calls $((2 + (taps > 32 ? taps : 32))) {0} 9 core 2 $((2 * {2} * taps)) $((2 * {3} * taps)){1} 0"; echo end
done >"$(of times)"
n=0
tail -n +2 "$plan" | while read -r kernel order taps rest; do
    if [ -e "refuse$taps" ]; then echo "row $n $(cat "refuse$taps")"
    else echo "row $n 0 $(cat "hash$taps" || echo 1) 12 $((8 * taps)) $((4 * taps))"; fi
    n=$((n + 1))
done
echo "end $(($(wc -l <"$plan") - 1))"
)sh",
            ring, losses, cycles, high);
        board_ = {folder_.file("measure.elf"),  folder_.file("measure.elf"),       "x.so",
                  made_emulator(folder_, body), std::filesystem::path(TEST_CORES), &machine};
    }

    [[nodiscard]] const qemu::Board& board() const { return board_; }
    /// Answers what the host does at this length; has to be said of each that is asked for.
    void knows(std::size_t taps) const {
        const auto design = bench::design_of("ring_plain_f32", order_,
                                             bench::length_of("ring_plain_f32", order_, taps, samples_), samples_);
        const std::size_t calls = qemu::calls_to_measure("ring_plain_f32", taps);
        write("hash", taps,
              fmt::format("{:x}",
                          qemu::replay_here({"ring_plain_f32", order_, design.taps, 0, calls + 1}, signals_).hash));
    }
    void computes_other_bits(std::size_t taps) const { write("hash", taps, "1"); }
    /// What runs in the place of a program that generated code was linked to.
    void runs(const std::string& script) const { std::ofstream(folder_.file("verify")) << script; }
    void refuses(std::size_t taps, glsum::Status status) const {
        write("refuse", taps, fmt::format("{}", static_cast<unsigned>(status)));
    }

private:
    void write(const char* what, std::size_t taps, const std::string& text) const {
        std::ofstream(folder_.file((what + std::to_string(taps)).c_str())) << text;
    }

    double order_;
    std::size_t samples_;
    base::Scratch folder_;
    qemu::Signals signals_;
    qemu::Board board_;
};

}  // namespace test
