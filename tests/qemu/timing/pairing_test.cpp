// Which two instructions may share a cycle: each rule of a core file by itself, on a core that allows everything else.
#include "qemu/timing/pairing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "bare_core.hpp"

namespace {

using timing::Branch;
using timing::Decoded;
using timing::Figures;
using timing::Kind;
using Rule = std::int64_t Figures::*;

Figures all_pair_but(Rule rule) {
    Figures figures = bare::no_rules();
    figures.*rule = 0;
    return figures;
}

Decoded of_kind(Kind kind, bool is_fp = false) {
    Decoded d;
    d.kind = kind;
    d.is_fp = is_fp;
    return d;
}

Decoded any_branch() {
    Decoded d = of_kind(Kind::branch);
    d.branch = Branch::direct;
    return d;
}

Decoded with_shifter() {
    Decoded d = of_kind(Kind::logic);
    d.uses_shifter = true;
    return d;
}

const Decoded plain = of_kind(Kind::add);

// Two of a kind are apart where their rule says so, in either order, and there alone.
TEST(Pairing, TwoOfAKindPairAsTheirRuleSays) {
    struct Row {
        Rule rule;
        std::vector<Decoded> kinds;
    };
    const Row rows[] = {
        {&Figures::issue_two_branches_pair, {any_branch()}},
        {&Figures::issue_two_shifted_operands_pair, {with_shifter()}},
        {&Figures::issue_two_multiplies_pair, {of_kind(Kind::multiply)}},
        {&Figures::issue_two_loads_pair, {of_kind(Kind::load)}},
        {&Figures::issue_two_stores_pair, {of_kind(Kind::store)}},
        {&Figures::fp_two_arithmetic_pair, {of_kind(Kind::fp_add), of_kind(Kind::fp_mac), of_kind(Kind::fp_convert)}},
        {&Figures::fp_two_moves_pair, {of_kind(Kind::fp_from_core), of_kind(Kind::fp_to_core)}},
    };
    for (std::size_t row = 0; row < std::size(rows); ++row) {
        const Figures forbidden = all_pair_but(rows[row].rule);
        for (const Decoded& a : rows[row].kinds) {
            for (const Decoded& b : rows[row].kinds) {
                EXPECT_TRUE(may_pair(a, b, false, bare::no_rules())) << row;
                EXPECT_FALSE(may_pair(a, b, false, forbidden)) << row;
            }
            EXPECT_TRUE(may_pair(a, plain, false, forbidden)) << row;
            EXPECT_TRUE(may_pair(plain, a, false, forbidden)) << row;
        }
        for (const Row& other : rows) {
            if (other.rule != rows[row].rule) {
                EXPECT_TRUE(may_pair(other.kinds[0], other.kinds[0], false, forbidden)) << row;
            }
        }
    }
}

// Of two kinds one of each is apart; two of the same are another rule's matter.
TEST(Pairing, OneOfEachKindPairsAsTheirRuleSays) {
    const Decoded store = of_kind(Kind::store);
    for (const auto& [rule, one] :
         {std::pair<Rule, Decoded>(&Figures::issue_multiply_pairs_with_store, of_kind(Kind::multiply)),
          std::pair<Rule, Decoded>(&Figures::issue_load_pairs_with_store, of_kind(Kind::load))}) {
        const Figures forbidden = all_pair_but(rule);
        EXPECT_TRUE(may_pair(one, store, false, bare::no_rules()));
        EXPECT_TRUE(may_pair(store, one, false, bare::no_rules()));
        EXPECT_FALSE(may_pair(one, store, false, forbidden));
        EXPECT_FALSE(may_pair(store, one, false, forbidden));
        EXPECT_TRUE(may_pair(one, one, false, forbidden));
        EXPECT_TRUE(may_pair(store, store, false, forbidden));
        EXPECT_TRUE(may_pair(one, plain, false, forbidden));
        EXPECT_TRUE(may_pair(plain, store, false, forbidden));
    }
}

// VDIV and VSQRT let an integer instruction issue with them and none of the FPU, whatever a core file says.
TEST(Pairing, ADivisionOfTheFpuSharesItsCycleWithTheCoreAlone) {
    const Decoded load = of_kind(Kind::load, true);
    for (const Kind kind : {Kind::fp_divide, Kind::fp_sqrt}) {
        const Decoded division = of_kind(kind, true);
        EXPECT_FALSE(may_pair(division, load, false, bare::no_rules()));
        EXPECT_FALSE(may_pair(load, division, false, bare::no_rules()));
        EXPECT_TRUE(may_pair(division, plain, false, bare::no_rules()));
        EXPECT_TRUE(may_pair(plain, division, false, bare::no_rules()));
        EXPECT_TRUE(may_pair(division, of_kind(Kind::load), false, bare::no_rules()));
    }
    for (const Kind kind : {Kind::fp_add, Kind::fp_mul, Kind::fp_mac, Kind::fp_convert}) {
        EXPECT_TRUE(may_pair(of_kind(kind, true), load, false, bare::no_rules()));
        EXPECT_TRUE(may_pair(load, of_kind(kind, true), false, bare::no_rules()));
    }
}

// What issues alone does so in either slot; all others never do.
TEST(Pairing, SomeIssueAlone) {
    struct Row {
        Rule rule;
        std::vector<Kind> kinds;
    };
    const Row rows[] = {
        {&Figures::issue_system_pairs, {Kind::unknown, Kind::system, Kind::barrier}},
        {&Figures::issue_multiple_pairs, {Kind::load_multiple, Kind::store_multiple}},
        {&Figures::issue_divide_pairs, {Kind::divide}},
        {&Figures::issue_if_then_pairs, {Kind::if_then}},
    };
    for (const Row& row : rows) {
        const Figures forbidden = all_pair_but(row.rule);
        for (const Kind kind : row.kinds) {
            const Decoded d = of_kind(kind);
            EXPECT_TRUE(issues_alone(d, forbidden)) << static_cast<int>(kind);
            EXPECT_FALSE(may_pair(d, plain, false, forbidden)) << static_cast<int>(kind);
            EXPECT_FALSE(may_pair(plain, d, false, forbidden)) << static_cast<int>(kind);
            EXPECT_FALSE(issues_alone(d, bare::no_rules())) << static_cast<int>(kind);
            EXPECT_TRUE(may_pair(d, plain, false, bare::no_rules())) << static_cast<int>(kind);
            EXPECT_TRUE(may_pair(plain, d, false, bare::no_rules())) << static_cast<int>(kind);
        }
    }
    const Figures nothing_pairs{};
    for (const Kind kind : {Kind::add, Kind::bitfield, Kind::multiply, Kind::load, Kind::store, Kind::branch,
                            Kind::hint, Kind::fp_mac, Kind::fp_divide, Kind::fp_to_core}) {
        EXPECT_FALSE(issues_alone(of_kind(kind), nothing_pairs)) << static_cast<int>(kind);
    }
    EXPECT_TRUE(may_pair(plain, plain, false, nothing_pairs));
    Decoded both = of_kind(Kind::fp_to_core);  // VMRS, VMOV of two registers
    both.both_fp_ports = true;
    EXPECT_TRUE(issues_alone(both, all_pair_but(&Figures::fp_both_ports_pair)));
    EXPECT_FALSE(issues_alone(both, bare::no_rules()));
}

// A bit field needs the older slot, a branch is asked whether it was taken; neither holds for the other slot.
TEST(Pairing, SomeRulesAreOfOneSlot) {
    const Decoded bits = of_kind(Kind::bitfield);
    const Figures older_only = all_pair_but(&Figures::issue_bitfield_in_younger_slot);
    EXPECT_TRUE(may_pair(bits, plain, false, older_only));
    EXPECT_FALSE(may_pair(plain, bits, false, older_only));
    EXPECT_FALSE(may_pair(bits, bits, false, older_only));
    EXPECT_TRUE(may_pair(bits, bits, false, bare::no_rules()));
    for (const bool taken : {false, true}) {
        const Figures forbidden =
            all_pair_but(taken ? &Figures::issue_taken_branch_pairs_with_target : &Figures::issue_untaken_branch_pairs);
        EXPECT_TRUE(may_pair(any_branch(), plain, taken, bare::no_rules())) << taken;
        EXPECT_FALSE(may_pair(any_branch(), plain, taken, forbidden)) << taken;
        EXPECT_TRUE(may_pair(any_branch(), plain, !taken, forbidden)) << taken;
        EXPECT_TRUE(may_pair(plain, any_branch(), taken, forbidden)) << taken;
    }
}

}  // namespace
