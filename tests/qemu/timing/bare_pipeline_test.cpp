// The Cortex-M7's rules on a core that has no others: what one figure adds, by hand. Slots, words, the core's own
// results, and loads. Positions are half cycles: two an issue cycle.
#include <gtest/gtest.h>

#include <deque>

#include "bare_core.hpp"

namespace {

using bare::accessing;
using bare::Core;
using bare::last_of;
using bare::mac;
using bare::no_rules;
using bare::nzcv;
using bare::s0;
using bare::transfer;
using bare::work;
using timing::Branch;
using timing::Decoded;
using timing::Effect;
using timing::Effects;
using timing::Event;
using timing::Figures;
using timing::Kind;
using timing::Role;
using timing::Source;

TEST(BarePipeline, IssuesTwoACycleWhereNoRuleHolds) {
    Core core(no_rules());
    std::int32_t expected = 0;
    for (const Decoded& d :
         {work(Kind::add, {1}, {{Role::operand, 1}}), work(Kind::multiply, {2}, {{Role::operand, 1}}),
          transfer(Kind::load, {3}), mac(s0), work(Kind::fp_add, {s0}), transfer(Kind::store, {3}),
          work(Kind::bitfield, {4}), work(Kind::fp_move, {s0 + 1}), work(Kind::barrier)}) {
        EXPECT_EQ(core.issue(d, d.access_bytes > 0 ? accessing() : Event{}), expected++);
    }
    for (const Effect effect : {Effect::single_issue, Effect::fpu_latency, Effect::load_use, Effect::store_buffer}) {
        EXPECT_EQ(core.lost(effect), 0);
    }
}

// Words come one a cycle; one that is late moves all behind it.
TEST(BarePipeline, WaitsForItsWords) {
    const auto words = [](std::uint8_t count, std::uint16_t delay = 0) {
        Event event;
        event.words = count;
        event.fetch_delays[0] = delay;
        event.fetch_effect = Effect::flash_wait_states;
        return event;
    };
    const Decoded nop = work(Kind::hint);
    const Figures f = no_rules();
    EXPECT_EQ(last_of(f, {{nop, words(1)}, {nop, words(1)}, {nop, words(1)}}, Effect::fetch_alignment), 4);
    EXPECT_EQ(last_of(f, {{nop, words(2)}}, Effect::fetch_alignment), 2);
    EXPECT_EQ(last_of(f, {{nop, words(4)}}, Effect::fetch_alignment), 6);
    for (const std::uint16_t delay : {std::uint16_t{1}, std::uint16_t{5}}) {
        EXPECT_EQ(last_of(f, {{nop, words(1, delay)}}, Effect::flash_wait_states), 2 * delay);
        Core core(f);
        (void)core.issue(nop, words(2, delay));
        EXPECT_EQ(core.lost(Effect::flash_wait_states), 2 * delay);
        EXPECT_EQ(core.lost(Effect::fetch_alignment), 2);
        EXPECT_EQ(core.issue(nop, words(1)), 2 * (delay + 2));
    }
}

// An early result and a late one; an addition is early where it issues in the older slot and its operands are there.
TEST(BarePipeline, AResultIsEarlyOrLateByHowItIsMade) {
    Figures f = no_rules();
    f.read_operand = 7;
    f.read_shifted = 2;
    f.result_early = 8;
    f.result_late = 12;
    f.result_younger_add_to_address = 20;
    f.result_add_in_younger_slot_early = 0;
    const Decoded shifted_use = work(Kind::logic, {}, {{Role::shifted, 2}});
    const Decoded sum = work(Kind::add, {2}, {{Role::operand, 1}});
    const auto late = Effect::result_latency;
    EXPECT_EQ(last_of(f, {{sum}, {shifted_use}}, late), 2 * (8 - 2));
    EXPECT_EQ(last_of(f, {{work(Kind::logic, {2})}, {shifted_use}}, late), 2 * (12 - 2));
    const Decoded nop = work(Kind::hint);
    EXPECT_EQ(last_of(f, {{nop}, {sum}, {shifted_use}}, late), 2 * (12 - 2));
    EXPECT_EQ(last_of(f, {{nop}, {work(Kind::shift, {2})}, {shifted_use}}, late), 2 * (8 - 2));
    Decoded load = transfer(Kind::load, {3});
    load.read(Role::address, 2);
    EXPECT_EQ(last_of(f, {{nop}, {sum}, {load}}, late), 2 * 20);
    f.result_add_in_younger_slot_early = 1;
    EXPECT_EQ(last_of(f, {{nop}, {sum}, {shifted_use}}, late), 2 * (8 - 2));
    EXPECT_EQ(last_of(f, {{work(Kind::add, {2}, {{Role::condition, nzcv}})}, {shifted_use}}, late), 2 * (12 - 2));
    // A late operand reaches the shifter 10 cycles on: up to then what is made of it is late.
    f.read_operand = 12;
    for (const int cycle : {9, 10}) {
        Core core(f);
        (void)core.issue(work(Kind::logic, {1}));
        core.idle(2 * cycle - 1);
        EXPECT_EQ(core.issue(sum), 2 * cycle);
        EXPECT_EQ(core.issue(shifted_use), 2 * (cycle + (cycle < 10 ? 12 - 2 : 8 - 2))) << cycle;
    }
}

// What is foreseen waits for no operand; a load into PC does.
TEST(BarePipeline, ABranchWaitsForNoRegisterButOneThatLoads) {
    Figures f = no_rules();
    f.result_late = 6;
    Decoded branch = work(Kind::branch, {}, {{Role::address, 1}});
    branch.branch = Branch::indirect;
    const Decoded first = work(Kind::logic, {1});
    EXPECT_EQ(last_of(f, {{first}, {branch}}, Effect::result_latency), 1);
    branch.registers = 1;
    EXPECT_EQ(last_of(f, {{first}, {branch}}, Effect::result_latency), 12);
    EXPECT_EQ(last_of(f, {{first}, {work(Kind::logic, {}, {{Role::operand, 1}})}}, Effect::result_latency), 12);
    EXPECT_EQ(last_of(f, {{first}, {work(Kind::logic, {}, {{Role::operand, 2}})}}, Effect::result_latency), 1);
}

// A word, a byte or half, a float; of several so many a cycle, for which nothing else issues.
TEST(BarePipeline, LoadedRegistersComeByTheirSizeAndOneBehindTheOther) {
    Figures f = no_rules();
    f.result_load_word = 6;
    f.result_load_narrow = 9;
    f.fp_load_to_operand = 4;
    const auto use_of = [](unsigned reg) { return work(Kind::logic, {}, {{Role::operand, reg}}); };
    const auto load_use = Effect::load_use;
    EXPECT_EQ(last_of(f, {{transfer(Kind::load, {1}), accessing()}, {use_of(1)}}, load_use), 12);
    EXPECT_EQ(last_of(f, {{transfer(Kind::load, {1}, false, 2), accessing()}, {use_of(1)}}, load_use), 18);
    EXPECT_EQ(last_of(f, {{transfer(Kind::load, {1}, false, 1), accessing()}, {use_of(1)}}, load_use), 18);
    EXPECT_EQ(last_of(f, {{transfer(Kind::load, {s0}, true), accessing()}, {use_of(s0)}}, load_use), 8);
    for (const int a_cycle : {1, 2}) {
        f.issue_registers_per_cycle = a_cycle;
        for (unsigned nth = 0; nth < 5; ++nth) {
            Core core(f);
            (void)core.issue(transfer(Kind::load_multiple, {1, 2, 3, 4, 5}), accessing(5));
            EXPECT_EQ(core.issue(use_of(1 + nth)), 2 * (6 + static_cast<int>(nth) / a_cycle)) << nth;
            EXPECT_EQ(core.lost(Effect::single_issue), 2 * ((5 + a_cycle - 1) / a_cycle) - 1);
        }
    }
}

// Of two registers a cycle, rounded up; an even number that does not begin on eight bytes is stored for longer.
TEST(BarePipeline, SeveralRegistersIssueForTheirCycles) {
    Figures f = no_rules();
    f.issue_registers_per_cycle = 2;
    f.issue_unaligned_multiple_extra = 3;
    const auto next_behind = [&](Kind kind, unsigned count, bool off_eight, bool carried_out = true) {
        std::vector<unsigned> registers;
        for (unsigned reg = 0; reg < count; ++reg) {
            registers.push_back(reg);
        }
        Event event = accessing(carried_out ? count : 0);
        event.off_eight = off_eight ? 1U : 0U;
        return last_of(f, {{transfer(kind, registers), event}, {work(Kind::hint)}}, Effect::single_issue);
    };
    for (const auto& [count, cycles] :
         {std::pair(1U, 1), std::pair(2U, 1), std::pair(3U, 2), std::pair(4U, 2), std::pair(5U, 3)}) {
        EXPECT_EQ(next_behind(Kind::load_multiple, count, false), 2 * cycles) << count;
        EXPECT_EQ(next_behind(Kind::load_multiple, count, true), 2 * cycles) << count;
        EXPECT_EQ(next_behind(Kind::store_multiple, count, false), 2 * cycles) << count;
        EXPECT_EQ(next_behind(Kind::store_multiple, count, true), 2 * (cycles + (count % 2 == 0 ? 3 : 0))) << count;
        EXPECT_EQ(next_behind(Kind::store_multiple, count, true, false), 2 * cycles) << count;
    }
}

// A division issues for its cycles, and its quotient is a late result of the last of them.
TEST(BarePipeline, ADivisionLetsNothingIssueBesideIt) {
    Figures f = no_rules();
    f.result_divide = 7;
    f.result_late = 2;
    const Decoded division = work(Kind::divide, {1});
    EXPECT_EQ(last_of(f, {{division}, {work(Kind::hint)}}, Effect::result_latency), 2 * 7);
    EXPECT_EQ(last_of(f, {{division}, {work(Kind::logic, {}, {{Role::operand, 1}})}}, Effect::result_latency),
              2 * (7 - 1 + 2));
}

TEST(BarePipeline, FlagsAndBasesAreResultsOfTheirOwn) {
    Figures f = no_rules();
    f.result_flags = 3;
    f.result_base = 4;
    f.fp_compare_to_status = 5;
    f.result_late = 9;
    Decoded compare;
    compare.kind = Kind::logic;
    compare.write(nzcv, Source::flags);
    const Decoded conditional = work(Kind::logic, {}, {{Role::condition, nzcv}});
    EXPECT_EQ(last_of(f, {{compare}, {conditional}}, Effect::result_latency), 6);
    Decoded vcmp = work(Kind::fp_add);
    vcmp.write(timing::registers::fp_flags, Source::flags);
    const Decoded vmrs = work(Kind::fp_to_core, {}, {{Role::condition, timing::registers::fp_flags}});
    EXPECT_EQ(last_of(f, {{vcmp}, {vmrs}}, Effect::fpu_latency), 10);
    Decoded post = transfer(Kind::store, {2});
    post.write(1, Source::base);
    EXPECT_EQ(last_of(f, {{post, accessing()}, {work(Kind::logic, {}, {{Role::operand, 1}})}}, Effect::result_latency),
              8);
}

// A late load keeps all behind it from issuing, and its own result is as much later; both causes add up.
TEST(BarePipeline, ALateOrUnalignedLoadHoldsWhatFollows) {
    Figures f = no_rules();
    f.unaligned_load_in_older_slot = 3;
    f.unaligned_load_in_younger_slot = 4;
    const Decoded load = transfer(Kind::load, {1});
    const Decoded nop = work(Kind::hint);
    Event late = accessing();
    late.load_delay = 10;
    Event unaligned = accessing();
    unaligned.unaligned = 1;
    EXPECT_EQ(last_of(f, {{load, late}, {nop}}, Effect::dcache_misses), 2 * (1 + 10));
    EXPECT_EQ(last_of(f, {{load, unaligned}, {nop}}, Effect::unaligned_access), 2 * (1 + 3));
    EXPECT_EQ(last_of(f, {{nop}, {load, unaligned}, {nop}}, Effect::unaligned_access), 2 * (1 + 4));
    Event both = late;
    both.unaligned = 1;
    Core core(f);
    (void)core.issue(load, both);
    EXPECT_EQ(core.issue(nop), 2 * (1 + 10 + 3));
    EXPECT_EQ(core.lost(Effect::unaligned_access), 2 * 3);
    Event little = accessing();
    little.load_delay = 1;
    EXPECT_EQ(last_of(f, {{load, little}, {nop}}, Effect::dcache_misses), 2 * (1 + 1));
    // What is off is late for nobody.
    for (const auto& [effect, event] :
         {std::pair(Effect::dcache_misses, late), std::pair(Effect::unaligned_access, unaligned)}) {
        Effects off;
        off.set(timing::index(effect));
        EXPECT_EQ(last_of(f, {{load, event}, {nop}}, effect, off), 1);
    }
    f.result_load_word = 6;
    Core with_result(f);
    (void)with_result.issue(load, unaligned);
    EXPECT_EQ(with_result.issue(work(Kind::logic, {}, {{Role::operand, 1}})), 2 * (3 + 6));
    EXPECT_EQ(with_result.lost(Effect::unaligned_access), 2 * (1 + 3) - 1);
    EXPECT_EQ(with_result.lost(Effect::load_use), 2 * (3 + 6) - 2 * (1 + 3));
}

// Nothing was issued, fetched or stored before a program's first instruction. Under the rules of each set of a core
// file none waits for anything, nor does one of the FPU in the slot beside it.
TEST(BarePipeline, BeginsWithNothingUnderWay) {
    Event event = accessing();
    event.words = 1;
    event.in_dtcm = 1;
    Decoded branch = work(Kind::branch);
    branch.branch = Branch::conditional;
    const Decoded of_the_unit[] = {mac(s0),
                                   mac(s0, false),
                                   work(Kind::fp_add, {s0}),
                                   work(Kind::fp_mul, {s0}),
                                   work(Kind::fp_move, {s0}),
                                   work(Kind::fp_move_immediate, {s0}),
                                   work(Kind::fp_from_core, {s0}),
                                   transfer(Kind::load, {s0}, true),
                                   transfer(Kind::store, {s0}, true)};
    const Decoded others[] = {work(Kind::add, {1}, {{Role::operand, 2}}),
                              work(Kind::divide, {1}, {{Role::multiplicand, 2}}),
                              mac(s0, true, true),
                              work(Kind::fp_divide, {s0}),
                              transfer(Kind::load_multiple, {s0, s0 + 1}, true),
                              transfer(Kind::load, {1}),
                              transfer(Kind::store, {1}),
                              branch};
    const timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    const timing::Prepared nop(work(Kind::hint));
    for (const timing::RuleSet& set : core.sets) {
        const auto first = [&](const Decoded& d) {
            timing::Pipeline pipeline(set.figures, 4, {});
            const timing::Prepared prepared(d);
            pipeline.execute(prepared, event);
            EXPECT_EQ(pipeline.losses, timing::Losses{}) << set.name << ' ' << static_cast<int>(d.kind);
            return pipeline.state.position;
        };
        for (const Decoded& d : others) {
            EXPECT_EQ(first(d), 0);
        }
        for (const Decoded& d : of_the_unit) {
            EXPECT_EQ(first(d), 0);
            timing::Pipeline pipeline(set.figures, 4, {});
            const timing::Prepared prepared(d);
            pipeline.execute(nop, {});
            pipeline.execute(prepared, {});
            EXPECT_EQ(pipeline.state.position, 1) << set.name << ' ' << static_cast<int>(d.kind);
        }
    }
}

// What an idle time ends leaves no trace in the state: it is that of a core that only idled. So it is under the rules
// of each set of a core file.
TEST(BarePipeline, ForgetsWhatHoldsNothingAnyMore) {
    const auto in_double = [](Decoded d) {
        d.is_double = true;
        return d;
    };
    Event both = accessing();
    both.in_dtcm = 1;
    both.unaligned = 1;
    both.load_delay = 9;
    both.words = 2;
    both.fetch_delays = {3, 2, 0, 0};
    both.store_delayed = true;
    both.store_delays[0] = 7;
    Decoded compare = work(Kind::logic, {2});
    compare.write(nzcv, Source::flags);
    Decoded branch = work(Kind::branch);
    branch.branch = Branch::conditional;
    Event wrong;
    wrong.prediction = timing::Prediction::wrong;
    const std::vector<bare::Step> busy{
        {transfer(Kind::load, {1}), both},
        {transfer(Kind::load, {s0 + 2}, true), both},
        {mac(s0), {}},
        {mac(s0 + 1, false), {}},
        {transfer(Kind::store, {s0 + 1}, true), both},
        {transfer(Kind::store, {1}), both},
        {work(Kind::fp_move, {s0 + 3}), {}},
        {work(Kind::divide, {3}), {}},
        {mac(s0 + 8, true, true), {}},
        {in_double(work(Kind::fp_divide, {s0 + 10})), {}},
        {transfer(Kind::load_multiple, {4, 5, 6}), both},
        {compare, {}},
        {branch, wrong},
        {work(Kind::fp_add, {s0 + 4}), {}},  // ends the run of MACs in double precision
    };
    const timing::Prepared nop(work(Kind::hint));
    const timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    for (const timing::RuleSet& set : core.sets) {
        timing::Pipeline idled(set.figures, 4, {});
        timing::Pipeline worked(set.figures, 4, {});
        std::deque<timing::Prepared> sites;
        for (const bare::Step& step : busy) {
            worked.execute(sites.emplace_back(step.decoded), step.event);
        }
        for (timing::Pipeline* pipeline : {&idled, &worked}) {
            for (int n = 0; n < 400 || pipeline->state.position % 2 == 0; ++n) {
                pipeline->execute(nop, {});
            }
        }
        const std::int32_t cycles = worked.state.position / 2;
        EXPECT_EQ(worked.settle(), cycles) << set.name;
        (void)idled.settle();
        EXPECT_EQ(worked.state.position, 1) << set.name;
        EXPECT_TRUE(worked.state == idled.state) << set.name;
    }
}

}  // namespace
