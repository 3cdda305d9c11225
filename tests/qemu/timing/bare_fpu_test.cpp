// The Cortex-M7's rules on a core that has no others: what one figure adds, by hand. The FPU, stores and branches.
// Positions are half cycles: two an issue cycle.
#include <gtest/gtest.h>

#include <tuple>

#include "bare_core.hpp"

namespace {

using bare::accessing;
using bare::Core;
using bare::last_of;
using bare::mac;
using bare::no_rules;
using bare::s0;
using bare::Step;
using bare::transfer;
using bare::work;
using timing::Branch;
using timing::Decoded;
using timing::Effect;
using timing::Effects;
using timing::Event;
using timing::Figures;
using timing::Kind;
using timing::Prediction;
using timing::Role;
using timing::Source;

const Decoded idle = work(Kind::hint);
const Decoded float_load = transfer(Kind::load, {s0 + 20}, true);
const Decoded float_store = transfer(Kind::store, {s0 + 20}, true);
constexpr auto fpu = Effect::fpu_latency;

// As many cycles as the figure says lie between the two.
TEST(BareFpu, BarsBehindAMacAreOfTheirKinds) {
    struct Bar {
        std::int64_t Figures::*figure;
        Decoded first;
        std::vector<Decoded> barred;
        std::vector<Decoded> free;
    };
    const Decoded add = work(Kind::fp_add, {s0 + 1});
    const Decoded product = work(Kind::fp_mul, {s0 + 1});
    const Decoded constant = work(Kind::fp_move_immediate, {s0 + 1});
    const Decoded loads = transfer(Kind::load_multiple, {s0 + 20, s0 + 21}, true);
    const Decoded stores = transfer(Kind::store_multiple, {s0 + 20, s0 + 21}, true);
    const Decoded integer = transfer(Kind::load, {1});
    const Bar bars[] = {
        {&Figures::fp_bar_after_mac,
         mac(s0),
         {add, constant, loads, stores},
         {product, float_load, float_store, integer}},
        {&Figures::fp_load_bar_after_mac, mac(s0), {float_load, loads}, {add, float_store, stores, integer}},
        {&Figures::fp_mac_bar_after_load, float_load, {mac(s0), mac(s0, false)}, {add, product, float_store}},
        {&Figures::fp_mac_bar_after_store, float_store, {mac(s0), mac(s0, false)}, {add, product, float_load}},
        {&Figures::fp_fma_bar_after_mla, mac(s0, false), {mac(s0 + 1)}, {mac(s0 + 1, false), add, float_load}},
    };
    for (std::size_t n = 0; n < std::size(bars); ++n) {
        for (const int cycles : {0, 1, 4}) {
            Figures f = no_rules();
            f.*bars[n].figure = cycles;
            for (const Decoded& second : bars[n].barred) {
                EXPECT_EQ(last_of(f, {{bars[n].first}, {second}}, fpu), cycles > 0 ? 2 * (cycles + 1) : 1) << n;
            }
            for (const Decoded& second : bars[n].free) {
                EXPECT_EQ(last_of(f, {{bars[n].first}, {second}}, fpu), 1) << n;
            }
        }
    }
    Figures f = no_rules();
    f.fp_fma_bar_after_mla = 4;
    EXPECT_EQ(last_of(f, {{mac(s0)}, {mac(s0 + 1)}}, fpu), 1);  // behind a VFMA there is none
}

// A MAC's multiplicand is not overwritten by a load for some cycles; other registers are.
TEST(BareFpu, AMultiplicandIsKeptFromALoad) {
    Figures f = no_rules();
    f.fp_overwrite_bar_after_mac = 6;
    const auto load_of = [](unsigned reg) { return transfer(Kind::load, {reg}, true); };
    EXPECT_EQ(last_of(f, {{mac(s0)}, {load_of(s0 + 30)}}, fpu), 2 * 6);
    EXPECT_EQ(last_of(f, {{mac(s0)}, {load_of(s0 + 29)}}, fpu), 1);
    EXPECT_EQ(last_of(f, {{mac(s0)}, {load_of(s0)}}, fpu), 1);  // of the accumulator nothing is said
    for (const unsigned edge : {0U, 31U}) {
        Decoded of_edge = work(Kind::fp_mac, {s0 + 1}, {{Role::multiplicand, s0 + edge}});
        EXPECT_EQ(last_of(f, {{of_edge}, {load_of(s0 + edge)}}, fpu), 2 * 6) << edge;
    }
    // A base that is written back is no register of the FPU.
    Decoded post = load_of(s0 + 5);
    post.write(1, Source::base);
    EXPECT_EQ(last_of(f, {{mac(s0)}, {post}}, fpu), 1);
}

// The younger slot is closed to transfers in the cycles behind a MAC's own.
TEST(BareFpu, TheYoungerSlotIsClosedToTransfersBehindAMac) {
    Figures f = no_rules();
    f.fp_younger_bar_after_mac = 3;
    const std::vector<Decoded> transfers{float_load, float_store, work(Kind::fp_move, {s0 + 1}),
                                         work(Kind::fp_from_core, {s0 + 1}), work(Kind::fp_to_core, {1})};
    for (const Decoded& moves : transfers) {
        for (int place = 1; place <= 10; ++place) {
            Core core(f);
            (void)core.issue(mac(s0));
            core.idle(place - 1);
            const bool closed = place % 2 == 1 && place / 2 >= 1 && place / 2 <= 3;
            EXPECT_EQ(core.issue(moves), closed ? place + 1 : place) << static_cast<int>(moves.kind);
            EXPECT_EQ(core.lost(fpu), closed ? 1 : 0);
        }
    }
    for (const Kind kind : {Kind::fp_add, Kind::fp_mul, Kind::load}) {  // arithmetic, and the core's own loads
        Core core(f);
        (void)core.issue(mac(s0));
        core.idle(2);
        EXPECT_EQ(core.issue(work(kind, {})), 3);
    }
}

// One VMOV after the other, as far apart as the figure says.
TEST(BareFpu, MovesKeepTheirDistance) {
    Figures f = no_rules();
    f.fp_move_spacing = 6;
    const Decoded move = work(Kind::fp_move, {s0});
    EXPECT_EQ(last_of(f, {{move}, {move}}, fpu), 12);
    EXPECT_EQ(last_of(f, {{move}, {idle}, {idle}, {move}}, fpu), 12);
    EXPECT_EQ(last_of(f, {{move}, {work(Kind::fp_mul, {s0 + 1})}}, fpu), 1);
}

// A chain of sums that a transfer meets takes longer; one before the chain's last product is not met.
TEST(BareFpu, AChainIsHeldUpByATransferBehindItsLastProduct) {
    Figures f = no_rules();
    f.fp_chain_across_transfer = 8;
    for (const bool fused : {false, true}) {
        const Decoded sum = mac(s0, fused);
        EXPECT_EQ(last_of(f, {{sum}, {sum}}, fpu), 1);
        for (const Decoded& moved : {float_load, float_store}) {
            EXPECT_EQ(last_of(f, {{sum}, {moved}, {sum}}, fpu), 16);
            EXPECT_EQ(last_of(f, {{moved}, {sum}, {sum}}, fpu), 16);  // in its cycle
            EXPECT_EQ(last_of(f, {{moved}, {idle}, {sum}, {sum}}, fpu), 3);
        }
        EXPECT_EQ(last_of(f, {{sum}, {float_load}, {mac(s0 + 1, fused)}}, fpu), 2);  // another sum
        const Decoded factor = work(Kind::fp_mac, {s0 + 1}, {{Role::multiplicand, s0}});
        EXPECT_EQ(last_of(f, {{sum}, {float_load}, {factor}}, fpu), 2);
    }
    EXPECT_EQ(last_of(f, {{work(Kind::fp_mul, {s0})}, {float_load}, {mac(s0)}}, fpu), 2);  // no chain
}

// In double precision the unit is taken for the cycles of each kind; a MAC right behind another one for its own.
TEST(BareFpu, DoublePrecisionTakesTheUnitForItsCycles) {
    Figures f = no_rules();
    f.fp64_add = 3;
    f.fp64_mul = 5;
    f.fp64_fma = 8;
    f.fp64_fma_chained = 7;
    f.fp64_mla = 10;
    f.fp64_mla_chained = 6;
    const auto in_double = [](Decoded d) {
        d.is_double = true;
        return d;
    };
    const Decoded add = in_double(work(Kind::fp_add, {s0, s0 + 1}));
    const Decoded product = in_double(work(Kind::fp_mul, {s0, s0 + 1}));
    const Decoded convert = in_double(work(Kind::fp_convert, {s0}));
    const Decoded fused = mac(s0, true, true);
    const Decoded rounded = mac(s0, false, true);
    const Decoded single = work(Kind::fp_add, {s0 + 8});
    const auto behind = [&](const std::vector<Decoded>& before) {
        std::vector<Step> steps;
        for (const Decoded& d : before) {
            steps.push_back({d});
        }
        steps.push_back({single});
        return last_of(f, steps, fpu) / 2;
    };
    EXPECT_EQ(behind({add}), 3);
    EXPECT_EQ(behind({convert}), 3);  // as an addition
    EXPECT_EQ(behind({product}), 5);
    EXPECT_EQ(behind({fused}), 8);
    EXPECT_EQ(behind({rounded}), 10);
    EXPECT_EQ(behind({fused, fused}), 8 + 7);
    EXPECT_EQ(behind({rounded, fused}), 10 + 7);
    EXPECT_EQ(behind({fused, rounded}), 8 + 6);
    EXPECT_EQ(behind({fused, add, fused}), 8 + 3 + 8);
    EXPECT_EQ(behind({fused, single, fused}), 8 + 8);  // the single one takes no time of the unit
    EXPECT_EQ(behind({fused, idle, fused}), 8 + 7);    // the core's own instructions end no chain
    EXPECT_EQ(last_of(f, {{fused}, {work(Kind::fp_move, {s0 + 8})}}, fpu), 1);  // a move needs no arithmetic
}

// VDIV and VSQRT let one instruction issue with them, and the next at their end; their result is there then.
TEST(BareFpu, DivisionsBlockTheCoreBehindTheirCycle) {
    Figures f = no_rules();
    f.fp_divide = 16;
    f.fp_sqrt = 14;
    f.fp64_divide = 30;
    f.fp64_sqrt = 28;
    f.fp_convert_to_use = 9;  // not theirs
    for (const auto& [kind, is_double, cycles] :
         {std::tuple(Kind::fp_divide, false, 16), std::tuple(Kind::fp_sqrt, false, 14),
          std::tuple(Kind::fp_divide, true, 30), std::tuple(Kind::fp_sqrt, true, 28)}) {
        Decoded division = work(kind, {s0});
        division.is_double = is_double;
        EXPECT_EQ(last_of(f, {{division}, {idle}}, fpu), 1);
        EXPECT_EQ(last_of(f, {{division}, {idle}, {idle}}, fpu), 2 * cycles);
        EXPECT_EQ(last_of(f, {{idle}, {division}, {idle}}, fpu), 2 * cycles);
        EXPECT_EQ(last_of(f, {{division}, {idle}, {work(Kind::fp_add, {s0 + 1}, {{Role::operand, s0}})}}, fpu),
                  2 * cycles);
        Core later(f);
        later.idle(6);
        EXPECT_EQ(later.issue(division), 6);
        later.idle(1);
        EXPECT_EQ(later.issue(idle), 2 * (3 + cycles));
    }
}

// A MAC and a transfer of the FPU share no cycle, unless it is the first MAC for as long as one bars others.
TEST(BareFpu, AMacAndATransferShareACycleAsTheRulesSay) {
    Figures f = no_rules();
    f.fp_mac_pairs_with_fp_transfer = 0;
    f.fp_first_mac_pairs_with_fp_transfer = 0;
    const Decoded integer = transfer(Kind::load, {1});
    for (const Decoded& moved : {float_load, float_store, work(Kind::fp_move, {s0 + 1})}) {
        EXPECT_EQ(last_of(f, {{mac(s0)}, {moved}}, Effect::single_issue), 2);
        EXPECT_EQ(last_of(f, {{moved}, {mac(s0)}}, Effect::single_issue), 2);
        EXPECT_EQ(last_of(f, {{moved}, {integer}}, Effect::single_issue), 1);
    }
    EXPECT_EQ(last_of(f, {{mac(s0)}, {integer}}, Effect::single_issue), 1);
    EXPECT_EQ(last_of(f, {{integer}, {mac(s0)}}, Effect::single_issue), 1);
    EXPECT_EQ(last_of(f, {{mac(s0)}, {work(Kind::fp_mul, {s0 + 1})}}, Effect::single_issue), 1);
    f.fp_first_mac_pairs_with_fp_transfer = 1;
    f.fp_bar_after_mac = 3;
    for (int cycle = 1; cycle <= 5; ++cycle) {
        for (const bool mac_is_older : {false, true}) {
            Core core(f);
            EXPECT_EQ(core.issue(mac(s0)), 0);
            core.idle(2 * cycle - 1);
            (void)core.issue(mac_is_older ? mac(s0 + 1) : float_load);
            EXPECT_EQ(core.issue(mac_is_older ? float_load : mac(s0 + 1)), 2 * cycle + (cycle > 3 ? 1 : 2)) << cycle;
        }
    }
}

// Two loads go together to two banks, where both are carried out and there are any.
TEST(BareStores, LoadsOfOneBankAreApart) {
    const Decoded load = transfer(Kind::load, {1});
    const auto at = [](bool odd, bool has_banks, unsigned accesses = 1) {
        Event event = accessing(accesses);
        event.odd_word = odd ? 1U : 0U;
        event.has_banks = has_banks ? 1U : 0U;
        return event;
    };
    const auto second = [&](const Event& a, const Event& b) {
        return last_of(no_rules(), {{load, a}, {load, b}}, Effect::load_bank_conflict);
    };
    for (const bool odd : {false, true}) {
        EXPECT_EQ(second(at(odd, true), at(!odd, true)), 1);
        EXPECT_EQ(second(at(odd, true), at(odd, true)), 2);
        EXPECT_EQ(second(at(odd, false), at(!odd, true)), 2);
        EXPECT_EQ(second(at(odd, true), at(!odd, false)), 2);
        EXPECT_EQ(second(at(odd, true, 0), at(odd, true)), 1);
        EXPECT_EQ(second(at(odd, true), at(odd, true, 0)), 1);
    }
    const Decoded store = transfer(Kind::store, {1});
    EXPECT_EQ(last_of(no_rules(), {{store, at(true, true)}, {load, at(true, true)}}, Effect::load_bank_conflict), 1);
    EXPECT_EQ(last_of(no_rules(), {{load, at(true, true)}, {store, at(true, true)}}, Effect::load_bank_conflict), 1);
}

// A full buffer holds the next store up; a word that was stored is there for a load some cycles later.
TEST(BareStores, StoresWaitForTheBufferAndLoadsForStores) {
    Figures f = no_rules();
    f.store_entries = 1;
    f.store_word = 3;
    const Decoded store = transfer(Kind::store, {1});
    const Decoded load = transfer(Kind::load, {2});
    EXPECT_EQ(last_of(f, {{store, accessing()}, {store, accessing()}}, Effect::store_buffer), 2 * 3);
    EXPECT_EQ(last_of(f, {{store, accessing()}, {store, accessing(0)}}, Effect::store_buffer), 1);
    EXPECT_EQ(last_of(f, {{store, accessing(0)}, {store, accessing()}}, Effect::store_buffer), 1);
    f.store_entries = 16;
    f.store_to_load = 5;
    Event meets_last = accessing();
    meets_last.meets = 1;
    Event meets_first = accessing();
    meets_first.meets = 2;
    EXPECT_EQ(last_of(f, {{store, accessing()}, {load, meets_last}}, Effect::store_buffer), 2 * 5);
    EXPECT_EQ(
        last_of(f, {{store, accessing()}, {idle}, {store, accessing()}, {load, meets_last}}, Effect::store_buffer),
        2 * (1 + 5));
    EXPECT_EQ(
        last_of(f, {{store, accessing()}, {idle}, {store, accessing()}, {load, meets_first}}, Effect::store_buffer),
        2 * 5);
    EXPECT_EQ(last_of(f, {{store, accessing()}, {load, accessing()}}, Effect::store_buffer), 1);
}

// The words of a store of several leave two a cycle, to one bank and the other in turn. A late memory keeps its bank:
// stores behind them show in a full buffer when each is done.
TEST(BareStores, WordsOfAStoreOfSeveralGoToBothBanks) {
    Figures f = no_rules();
    f.issue_registers_per_cycle = 2;
    f.store_word = 3;
    f.store_entries = 3;
    f.store_to_load = 10;
    const Decoded stores = transfer(Kind::store_multiple, {1, 2, 3});
    for (const bool odd : {false, true}) {
        Event event = accessing(3);
        event.odd_word = odd ? 1U : 0U;
        event.store_delayed = true;
        event.store_delays[1] = 20;
        const auto three_to_the_other_bank = [&](const Effects& off) {
            Core core(f, off);
            (void)core.issue(stores, event);
            Event other = accessing();
            other.odd_word = odd ? 0U : 1U;
            std::vector<std::int32_t> at;
            for (int n = 0; n < 3; ++n) {
                at.push_back(core.issue(transfer(Kind::store, {1}), other));
            }
            return at;
        };
        // On their bank the first and the third are done in cycles 3 and 6, the second on its own in cycle 23.
        EXPECT_EQ(three_to_the_other_bank({}), (std::vector<std::int32_t>{2 * 3, 2 * 6, 2 * 23}));
        Effects off;
        off.set(timing::index(Effect::dcache_misses));
        EXPECT_EQ(three_to_the_other_bank(off), (std::vector<std::int32_t>{2 * 3, 2 * 3 + 1, 2 * 6}));
        // Loads of the third word, which left in cycle 1, of the second, and of the first.
        for (const unsigned nth : {0U, 1U, 2U}) {
            Core core(f);
            (void)core.issue(stores, event);
            Event meets = accessing();
            meets.meets = 1U << nth & 0xFFU;
            EXPECT_EQ(core.issue(transfer(Kind::load, {4}), meets), 2 * ((nth == 0 ? 1 : 0) + 10)) << nth;
        }
    }
}

// A wrong guess costs its cycles from the branch's own, fewer where the flags that decide it were known before. The
// target's words are asked for at its end.
TEST(BareBranches, AWrongGuessCostsItsCycles) {
    Figures f = no_rules();
    f.branch_mispredict = 9;
    f.branch_mispredict_flags_known = 6;
    f.branch_flags_known_after = 3;
    f.branch_taken_without_entry = 4;
    Decoded compare = work(Kind::logic);
    compare.write(timing::registers::flags, Source::flags);
    Event wrong;
    wrong.prediction = Prediction::wrong;
    Event without_entry;
    without_entry.prediction = Prediction::right_without_entry;
    const auto branch_of = [](Branch branch, std::uint8_t condition) {
        Decoded d = work(Kind::branch);
        d.branch = branch;
        d.condition = condition;
        return d;
    };
    const auto behind = [&](const Decoded& branch, const Event& event, int cycle) {
        Core core(f);
        (void)core.issue(compare);
        core.idle(2 * cycle - 1);
        EXPECT_EQ(core.issue(branch, event), 2 * cycle);
        const std::int32_t next = core.issue(idle);
        EXPECT_EQ(core.lost(Effect::branch_mispredict), next - 2 * cycle - 1);
        return next - 2 * cycle;
    };
    const Decoded conditional = branch_of(Branch::conditional, 0);
    EXPECT_EQ(behind(conditional, wrong, 2), 2 * 9);
    EXPECT_EQ(behind(conditional, wrong, 3), 2 * 6);
    EXPECT_EQ(behind(conditional, wrong, 4), 2 * 6);
    EXPECT_EQ(behind(branch_of(Branch::conditional, 0xE), wrong, 4), 2 * 9);  // CBZ asks for no flags
    EXPECT_EQ(behind(branch_of(Branch::indirect, 0), wrong, 4), 2 * 9);
    EXPECT_EQ(behind(conditional, without_entry, 4), 2 * (1 + 4));
    EXPECT_EQ(behind(conditional, Event{}, 4), 1);
    EXPECT_EQ(behind(work(Kind::logic), wrong, 4), 1);  // no branch
    Event word;
    word.words = 1;
    Core core(f);
    (void)core.issue(branch_of(Branch::indirect, 0), wrong);
    EXPECT_EQ(core.issue(idle, word), 2 * 9);
    EXPECT_EQ(core.lost(Effect::fetch_alignment), 0);
    EXPECT_EQ(core.issue(idle, word), 2 * 10);
    EXPECT_EQ(core.lost(Effect::fetch_alignment), 1);
}

}  // namespace
