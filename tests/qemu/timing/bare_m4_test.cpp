// The Cortex-M4's rules on a core that has no others: each instruction takes a cycle, and what one figure adds is by
// hand.
#include <gtest/gtest.h>

#include <deque>
#include <tuple>
#include <utility>
#include <vector>

#include "bare_core.hpp"
#include "qemu/timing/cortex_m4/pipeline.hpp"

namespace {

using bare::s0;
using bare::Step;
using timing::Branch;
using timing::Decoded;
using timing::Effect;
using timing::Effects;
using timing::Event;
using timing::Figures;
using timing::Kind;
using timing::Role;
using timing::Source;

// The cycle in which the last one issues; beside half a cycle of each, all is lost to this effect.
int cycle_of_last(const Figures& figures, const std::vector<Step>& steps, Effect effect,
                  const Effects& off = Effects()) {
    timing::cortex_m4::Pipeline pipeline(figures, 40, off);
    std::deque<timing::Prepared> sites;
    for (const Step& step : steps) {
        pipeline.execute(sites.emplace_back(step.decoded), step.event);
    }
    const auto count = static_cast<std::int64_t>(steps.size());
    const std::int64_t lost = pipeline.state.position - (count - 1);
    EXPECT_EQ(pipeline.losses[timing::index(effect)], lost - (effect != Effect::single_issue ? count - 1 : 0));
    EXPECT_EQ(pipeline.state.position % 2, 0);
    return pipeline.state.position / 2;
}

Decoded m4_work(Kind kind, const char* mnemonic = "") {
    Decoded d = bare::work(kind);
    d.mnemonic = mnemonic;
    d.bytes = 4;
    return d;
}

Decoded m4_transfer(Kind kind, const std::vector<unsigned>& moved, bool is_fp = false) {
    Decoded d = bare::transfer(kind, moved, is_fp);
    d.bytes = 4;
    return d;
}

Event m4_accessing(bool in_dtcm = true) {
    Event event = bare::accessing();
    event.in_dtcm = in_dtcm ? 1U : 0U;
    return event;
}

Event taken() {
    Event event;
    event.taken = true;
    return event;
}

const Decoded sum = m4_work(Kind::add, "add");
const Decoded nop = m4_work(Kind::hint, "nop");
const Decoded load = m4_transfer(Kind::load, {1});
const Decoded store = m4_transfer(Kind::store, {1});

// How long each takes until the next one issues, and by what name.
TEST(BareM4, AnInstructionTakesItsCycles) {
    Figures f;
    f.takes_multiply_accumulate = 3;
    f.takes_divide = 5;
    f.takes_multiple_first = 2;
    f.takes_system = 4;
    f.takes_fp_mac_of_core = 6;
    f.takes_fp_transfer = 2;
    f.takes_fp_two_transfers = 7;
    f.takes_fp_store_extra = 2;
    const auto behind = [&](const Decoded& d, const Event& event, Effect effect) {
        return cycle_of_last(f, {{d, event}, {sum}}, effect);
    };
    const Event none{};
    EXPECT_EQ(behind(sum, none, Effect::single_issue), 1);
    EXPECT_EQ(behind(m4_work(Kind::multiply, "mla"), none, Effect::mac_latency), 3);
    EXPECT_EQ(behind(m4_work(Kind::multiply, "mls"), none, Effect::mac_latency), 3);
    EXPECT_EQ(behind(m4_work(Kind::multiply, "smlad"), none, Effect::mac_latency), 1);
    EXPECT_EQ(behind(m4_work(Kind::divide, "udiv"), none, Effect::result_latency), 5);
    EXPECT_EQ(behind(m4_work(Kind::system, "mrs"), none, Effect::single_issue), 4);
    for (const Kind kind : {Kind::load_multiple, Kind::store_multiple}) {
        EXPECT_EQ(behind(m4_transfer(kind, {1, 2, 3}), m4_accessing(), Effect::single_issue), 2 + 3);
        EXPECT_EQ(behind(m4_transfer(kind, {1}), m4_accessing(), Effect::single_issue), 2 + 1);
        EXPECT_EQ(behind(m4_transfer(kind, {1, 2, 3}), none, Effect::single_issue), 1);
    }
    EXPECT_EQ(behind(m4_work(Kind::fp_mac, "vfma"), none, Effect::fpu_latency), 6);
    EXPECT_EQ(behind(m4_work(Kind::fp_add, "vadd"), none, Effect::fpu_latency), 1);
    Decoded both = m4_work(Kind::fp_to_core, "vmov");
    EXPECT_EQ(behind(both, none, Effect::single_issue), 2);
    both.both_fp_ports = true;
    EXPECT_EQ(behind(both, none, Effect::single_issue), 7);
    both.mnemonic = "vmrs";
    EXPECT_EQ(behind(both, none, Effect::single_issue), 1);
    EXPECT_EQ(behind(m4_work(Kind::fp_from_core, "vmov"), none, Effect::single_issue), 2);
    EXPECT_EQ(behind(m4_transfer(Kind::store, {s0}, true), m4_accessing(), Effect::store_buffer), 1 + 2);
    EXPECT_EQ(behind(m4_transfer(Kind::store, {s0}, true), none, Effect::store_buffer), 1);
    EXPECT_EQ(behind(store, m4_accessing(), Effect::store_buffer), 1);
}

// The FPU is taken for longer than the core: integer instructions go on, its own wait.
TEST(BareM4, TheUnitIsTakenForItsOwnCycles) {
    Figures f;
    f.takes_fp_mac_of_core = 2;
    f.takes_fp_mac = 5;
    f.takes_fp_divide = 14;
    f.takes_fp_sqrt = 13;
    const Decoded next = m4_work(Kind::fp_mul, "vmul");
    for (const auto& [kind, core, unit] :
         {std::tuple(Kind::fp_mac, 2, 5), std::tuple(Kind::fp_divide, 1, 14), std::tuple(Kind::fp_sqrt, 1, 13),
          std::tuple(Kind::fp_add, 1, 1), std::tuple(Kind::fp_convert, 1, 1)}) {
        EXPECT_EQ(cycle_of_last(f, {{m4_work(kind)}, {sum}}, Effect::fpu_latency), core);
        EXPECT_EQ(cycle_of_last(f, {{m4_work(kind)}, {next}}, Effect::fpu_latency), unit);
        EXPECT_EQ(cycle_of_last(f, {{m4_work(kind)}, {m4_transfer(Kind::load, {s0}, true)}}, Effect::fpu_latency),
                  unit);
        EXPECT_EQ(cycle_of_last(f, {{m4_work(kind)}, {load}}, Effect::fpu_latency), core);
    }
}

// An address is needed earlier than an operand, which is there at once.
TEST(BareM4, AddressesWaitForTheirRegisters) {
    Figures f;
    f.use_address_ahead = 2;
    f.use_loaded_address_ahead = 4;
    f.access_load_wait = 1;
    f.access_load_pipelines = 1;
    const auto use_as = [](Role role) {
        Decoded d = m4_transfer(Kind::load, {5});
        d.read(role, 1);
        return d;
    };
    Decoded result = sum;
    result.write(1);
    for (const Role role : {Role::address, Role::index}) {
        EXPECT_EQ(cycle_of_last(f, {{result}, {use_as(role), m4_accessing()}}, Effect::result_latency), 1 + 2);
        EXPECT_EQ(cycle_of_last(f, {{load, m4_accessing()}, {use_as(role), m4_accessing()}}, Effect::load_use),
                  1 + 1 + 4);
    }
    // What comes late is later as an address by as much.
    Event late = m4_accessing();
    late.load_delay = 3;
    late.load_effect = Effect::load_use;
    EXPECT_EQ(cycle_of_last(f, {{load, late}, {use_as(Role::address), m4_accessing()}}, Effect::load_use),
              1 + 1 + 4 + 3);
    EXPECT_EQ(cycle_of_last(f, {{result}, {use_as(Role::store_data), m4_accessing()}}, Effect::result_latency), 1);
    EXPECT_EQ(cycle_of_last(f, {{result}, {sum}}, Effect::result_latency), 1);
    Decoded branch = m4_work(Kind::branch);
    branch.branch = Branch::indirect;
    branch.read(Role::address, 1);
    EXPECT_EQ(cycle_of_last(f, {{result}, {branch}}, Effect::result_latency), 1);  // BX takes it as an operand
    branch.registers = 1;                                                          // TBB
    EXPECT_EQ(cycle_of_last(f, {{result}, {branch}}, Effect::result_latency), 1 + 2);
    Decoded post = store;
    post.write(1, Source::base);
    EXPECT_EQ(
        cycle_of_last(f, {{post, m4_accessing()}, {use_as(Role::address), m4_accessing()}}, Effect::result_latency),
        1 + 2);
    Decoded quotient = m4_work(Kind::divide);
    quotient.write(1);
    f.takes_divide = 5;
    EXPECT_EQ(cycle_of_last(f, {{quotient}, {use_as(Role::address), m4_accessing()}}, Effect::result_latency), 5 + 2);
}

// What the FPU computes is late for its next instruction, as an addend less so; what is moved or loaded is not.
TEST(BareM4, ComputedFloatsAreLateForTheNextInstruction) {
    Figures f;
    f.takes_fp_mac = 1;
    f.use_fp_next = 3;
    f.use_fp_next_addend = 1;
    const auto made_by = [](Kind kind, const char* mnemonic) {
        Decoded d = m4_work(kind, mnemonic);
        d.write(s0);
        return d;
    };
    const auto use_as = [](Role role, unsigned reg = s0) {
        Decoded d = m4_work(Kind::fp_mac, "vfma");
        d.read(role, reg);
        return d;
    };
    const auto fpu = Effect::fpu_latency;
    for (const Kind kind : {Kind::fp_add, Kind::fp_mul, Kind::fp_mac, Kind::fp_convert}) {
        const Decoded made = made_by(kind, "vadd");
        EXPECT_EQ(cycle_of_last(f, {{made}, {use_as(Role::multiplicand)}}, fpu), 1 + 3);
        EXPECT_EQ(cycle_of_last(f, {{made}, {use_as(Role::accumulator)}}, fpu), 1 + 1);
        EXPECT_EQ(cycle_of_last(f, {{made}, {use_as(Role::multiplicand, s0 + 1)}}, fpu), 1);
    }
    f.use_fp_next_addend = 2;
    EXPECT_EQ(cycle_of_last(f, {{made_by(Kind::fp_add, "vadd")}, {use_as(Role::accumulator)}}, fpu), 1 + 2);
    for (const Decoded& made : {made_by(Kind::fp_add, "vabs"), made_by(Kind::fp_add, "vneg"),
                                made_by(Kind::fp_move, "vmov"), m4_transfer(Kind::load, {s0}, true)}) {
        EXPECT_EQ(cycle_of_last(f, {{made}, {use_as(Role::multiplicand)}}, fpu), 1);
        EXPECT_EQ(cycle_of_last(f, {{made_by(Kind::fp_mul, "vmul")}, {made}, {use_as(Role::multiplicand)}}, fpu), 2);
    }
    for (const unsigned edge : {s0, s0 + 31}) {
        Decoded made = m4_work(Kind::fp_add, "vadd");
        made.write(edge);
        EXPECT_EQ(cycle_of_last(f, {{made}, {use_as(Role::operand, edge)}}, fpu), 1 + 3);
    }
}

// A load holds up all but what follows it in the pipeline of loads: a load or store to the same memory, and a NOP.
TEST(BareM4, ALoadHoldsUpWhatDoesNotPipeline) {
    Figures f;
    f.access_load_wait = 2;
    const auto behind = [&](const Decoded& d, const Event& event, bool in_dtcm = true) {
        return cycle_of_last(f, {{load, m4_accessing(in_dtcm)}, {d, event}}, Effect::load_use);
    };
    const Event none{};
    for (const bool pipelines : {false, true}) {
        f.access_load_pipelines = pipelines ? 1 : 0;
        f.access_load_hides_nop = pipelines ? 1 : 0;
        EXPECT_EQ(behind(sum, none), 3);
        EXPECT_EQ(behind(m4_work(Kind::hint, "pld"), none), 3);
        EXPECT_EQ(behind(nop, none), pipelines ? 1 : 3);
        EXPECT_EQ(behind(load, m4_accessing()), pipelines ? 1 : 3);
        EXPECT_EQ(behind(store, m4_accessing()), pipelines ? 1 : 3);
        EXPECT_EQ(behind(load, m4_accessing(false), false), pipelines ? 1 : 3);
        EXPECT_EQ(behind(load, m4_accessing(false)), 3);
        EXPECT_EQ(behind(load, m4_accessing(), false), 3);
        EXPECT_EQ(behind(load, none), 3);  // not carried out
        EXPECT_EQ(behind(m4_transfer(Kind::load_multiple, {2, 3}), m4_accessing()), 3);
    }
    EXPECT_EQ(cycle_of_last(f, {{load, none}, {sum}}, Effect::load_use), 1);
    Decoded jump = load;
    jump.branch = Branch::indirect;
    EXPECT_EQ(cycle_of_last(f, {{jump, m4_accessing()}, {sum}}, Effect::single_issue), 1 + 2);
    EXPECT_EQ(cycle_of_last(f, {{jump, none}, {sum}}, Effect::single_issue), 1);
}

// A load behind a store waits for it, an indexed store holds up all but a NOP.
TEST(BareM4, AStoreHoldsUpLoads) {
    Figures f;
    f.access_load_behind_store = 3;
    f.takes_indexed_store_extra = 2;
    Decoded indexed = store;
    indexed.read(Role::index, 7);
    const auto buffer = Effect::store_buffer;
    const auto behind = [&](const Decoded& first, const Decoded& d, const Event& event) {
        return cycle_of_last(f, {{first, m4_accessing()}, {d, event}}, buffer);
    };
    const Event none{};
    EXPECT_EQ(behind(store, sum, none), 1);
    EXPECT_EQ(behind(store, store, m4_accessing()), 1);
    EXPECT_EQ(behind(store, load, m4_accessing()), 1 + 3);
    EXPECT_EQ(behind(store, m4_transfer(Kind::load_multiple, {2, 3}), m4_accessing()), 1 + 3);
    EXPECT_EQ(behind(store, load, none), 1);
    EXPECT_EQ(behind(indexed, sum, none), 1 + 2);
    EXPECT_EQ(behind(indexed, nop, none), 1);
    EXPECT_EQ(behind(indexed, load, m4_accessing()), 1 + 2 + 3);
    EXPECT_EQ(cycle_of_last(f, {{indexed, none}, {sum}}, buffer), 1);
    EXPECT_EQ(cycle_of_last(f, {{store, m4_accessing()}, {sum}, {load, m4_accessing()}}, buffer), 2);
    // Of a store whose memory is late the next access waits for the slowest word.
    Event late = m4_accessing();
    late.store_delayed = true;
    late.store_delays[0] = 4;
    late.store_delays[1] = 10;
    EXPECT_EQ(cycle_of_last(f, {{store, late}, {store, m4_accessing()}}, Effect::dcache_misses), 1 + 10);
    EXPECT_EQ(cycle_of_last(f, {{store, late}, {sum}}, Effect::dcache_misses), 1);
}

TEST(BareM4, ALateOrUnalignedLoadHoldsWhatFollows) {
    Figures f;
    f.access_unaligned_load = 4;
    Event late = m4_accessing();
    Event unaligned = m4_accessing();
    unaligned.unaligned = 1;
    for (const std::uint16_t delay : {std::uint16_t{1}, std::uint16_t{10}}) {
        late.load_delay = delay;
        const int expected = 1 + delay;
        EXPECT_EQ(cycle_of_last(f, {{load, late}, {sum}}, Effect::dcache_misses), expected);
        EXPECT_EQ(cycle_of_last(f, {{m4_transfer(Kind::load_multiple, {1}), late}, {sum}}, Effect::dcache_misses),
                  expected);
    }
    EXPECT_EQ(cycle_of_last(f, {{load, unaligned}, {sum}}, Effect::unaligned_access), 1 + 4);
    EXPECT_EQ(cycle_of_last(f, {{store, unaligned}, {sum}}, Effect::unaligned_access), 1);
    for (const auto& [effect, event] :
         {std::pair(Effect::dcache_misses, late), std::pair(Effect::unaligned_access, unaligned)}) {
        Effects off;
        off.set(timing::index(effect));
        EXPECT_EQ(cycle_of_last(f, {{load, event}, {sum}}, effect, off), 1);
    }
}

// A taken branch refills the pipeline, by where its target comes from; one that is not taken takes its cycle.
TEST(BareM4, ATakenBranchRefillsThePipeline) {
    Figures f;
    f.refill_direct = 2;
    f.refill_by_register = 3;
    f.refill_loaded = 5;
    const auto of = [](Branch kind, std::uint8_t registers = 0) {
        Decoded d = m4_work(Kind::branch);
        d.branch = kind;
        d.registers = registers;
        return d;
    };
    const auto refill = Effect::branch_mispredict;
    for (const Branch direct : {Branch::direct, Branch::conditional, Branch::call}) {
        EXPECT_EQ(cycle_of_last(f, {{of(direct), taken()}, {sum}}, refill), 1 + 2);
    }
    EXPECT_EQ(cycle_of_last(f, {{of(Branch::indirect), taken()}, {sum}}, refill), 1 + 3);
    EXPECT_EQ(cycle_of_last(f, {{of(Branch::back), taken()}, {sum}}, refill), 1 + 3);
    EXPECT_EQ(cycle_of_last(f, {{of(Branch::back, 2), taken()}, {sum}}, refill), 1 + 5);
    EXPECT_EQ(cycle_of_last(f, {{of(Branch::conditional)}, {sum}}, refill), 1);
    Effects off;
    off.set(timing::index(refill));
    EXPECT_EQ(cycle_of_last(f, {{of(Branch::direct), taken()}, {sum}}, refill, off), 1);
}

// IT behind a narrow instruction issues in its cycle, once, where the core folds it.
TEST(BareM4, AnItIsFoldedBehindANarrowInstruction) {
    for (const bool folds : {false, true}) {
        Figures f;
        f.takes_if_then_folds = folds ? 1 : 0;
        Decoded it = m4_work(Kind::if_then, "it");
        it.bytes = 2;
        Decoded narrow = sum;
        narrow.bytes = 2;
        const auto position = [&](const std::vector<Decoded>& all) {
            timing::cortex_m4::Pipeline pipeline(f, 40, {});
            std::deque<timing::Prepared> sites;
            for (const Decoded& d : all) {
                pipeline.execute(sites.emplace_back(d), {});
            }
            return pipeline.state.position;
        };
        EXPECT_EQ(position({narrow, it}), folds ? 1 : 2);
        EXPECT_EQ(position({narrow, it, sum}), folds ? 2 : 4);
        EXPECT_EQ(position({narrow, it, it}), folds ? 2 : 4);
        EXPECT_EQ(position({sum, it}), 2);
        EXPECT_EQ(position({narrow, sum}), 2);
    }
}

// What an idle time ends leaves no trace in the state: it is that of a core that only idled.
TEST(BareM4, ForgetsWhatHoldsNothingAnyMore) {
    Event slow = m4_accessing();
    slow.unaligned = 1;
    slow.load_delay = 9;
    slow.words = 2;
    slow.fetch_delays = {3, 2, 0, 0};
    slow.store_delayed = true;
    slow.store_delays[0] = 7;
    Decoded computed = m4_work(Kind::fp_mul, "vmul");
    computed.write(s0);
    Decoded divided = m4_work(Kind::fp_divide, "vdiv");
    divided.write(s0 + 31);
    Decoded result = sum;
    result.write(7);
    Decoded jump = m4_work(Kind::branch);
    jump.branch = Branch::direct;
    const std::vector<Step> busy{{load, slow},
                                 {m4_transfer(Kind::load_multiple, {2, 3, 4}), slow},
                                 {m4_work(Kind::divide), {}},
                                 {computed, {}},
                                 {divided, {}},
                                 {result, {}},
                                 {jump, taken()},
                                 {store, slow}};
    const timing::Prepared idle(nop);
    const Figures f = timing::read_core(TEST_CORES, "cortex-m4-zerowait").sets[0].figures;
    timing::cortex_m4::Pipeline idled(f, 4, {});
    timing::cortex_m4::Pipeline worked(f, 4, {});
    std::deque<timing::Prepared> sites;
    for (const Step& step : busy) {
        worked.execute(sites.emplace_back(step.decoded), step.event);
    }
    for (timing::cortex_m4::Pipeline* pipeline : {&idled, &worked}) {
        for (int n = 0; n < 200; ++n) {
            pipeline->execute(idle, {});
        }
    }
    const std::int32_t cycles = worked.state.position / 2;
    EXPECT_EQ(worked.settle(), cycles);
    (void)idled.settle();
    EXPECT_EQ(worked.state.position, 0);
    EXPECT_TRUE(worked.state == idled.state);
}

}  // namespace
