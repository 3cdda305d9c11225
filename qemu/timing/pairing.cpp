#include "qemu/timing/pairing.hpp"

namespace timing {
namespace {

bool moves_between_files(const Decoded& d) { return d.kind == Kind::fp_from_core || d.kind == Kind::fp_to_core; }
bool is_fp_division(const Decoded& d) { return d.kind == Kind::fp_divide || d.kind == Kind::fp_sqrt; }

// Rules that forbid two of a kind. \return whether both are of the kind and the rule forbids it
template <class Is>
bool both(const Decoded& a, const Decoded& b, Is is, bool allowed) {
    return !allowed && is(a) && is(b);
}
template <class IsOne, class IsOther>
bool either_way(const Decoded& a, const Decoded& b, IsOne one, IsOther other, bool allowed) {
    return !allowed && ((one(a) && other(b)) || (one(b) && other(a)));
}

}  // namespace

bool issues_alone(const Decoded& d, const Figures& f) {
    if (d.both_fp_ports && f.fp_both_ports_pair == 0) {
        return true;
    }
    switch (d.kind) {
        case Kind::unknown:
        case Kind::system:
        case Kind::barrier:
            return f.issue_system_pairs == 0;
        case Kind::load_multiple:
        case Kind::store_multiple:
            return f.issue_multiple_pairs == 0;
        case Kind::divide:
            return f.issue_divide_pairs == 0;
        case Kind::if_then:
            return f.issue_if_then_pairs == 0;
        default:
            return false;
    }
}

bool may_pair(const Decoded& older, const Decoded& younger, bool older_taken, const Figures& f) {
    if (issues_alone(older, f) || issues_alone(younger, f)) {
        return false;
    }
    if (older.branch != Branch::none) {
        const bool allowed =
            older_taken ? f.issue_taken_branch_pairs_with_target != 0 : f.issue_untaken_branch_pairs != 0;
        if (!allowed) {
            return false;
        }
    }
    if (younger.kind == Kind::bitfield && f.issue_bitfield_in_younger_slot == 0) {
        return false;
    }
    const auto is = [](Kind kind) { return [kind](const Decoded& d) { return d.kind == kind; }; };
    const auto branches = [](const Decoded& d) { return d.branch != Branch::none; };
    const auto shifted = [](const Decoded& d) { return d.uses_shifter; };
    const auto fp_load_store = [](const Decoded& d) { return d.is_fp; };
    return !(
        both(older, younger, branches, f.issue_two_branches_pair != 0) ||
        both(older, younger, shifted, f.issue_two_shifted_operands_pair != 0) ||
        both(older, younger, is(Kind::multiply), f.issue_two_multiplies_pair != 0) ||
        both(older, younger, is(Kind::load), f.issue_two_loads_pair != 0) ||
        both(older, younger, is(Kind::store), f.issue_two_stores_pair != 0) ||
        both(
            older, younger, [](const Decoded& d) { return d.is_fp_arithmetic(); }, f.fp_two_arithmetic_pair != 0) ||
        both(older, younger, moves_between_files, f.fp_two_moves_pair != 0) ||
        either_way(older, younger, is(Kind::multiply), is(Kind::store), f.issue_multiply_pairs_with_store != 0) ||
        either_way(older, younger, is(Kind::load), is(Kind::store), f.issue_load_pairs_with_store != 0) ||
        either_way(older, younger, is_fp_division, fp_load_store, false));
}

}  // namespace timing
