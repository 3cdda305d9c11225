// selftest: are the kernels right on this machine? For every kernel, exact cases that need no reference:
// the differences x_k - x_(k-1) (order 1) and x_k - 2 x_(k-1) + x_(k-2) (order 2) of samples that are multiples of 1/8
// are exact in every format, over several turns of every history. Exit status 0, or 1 with a line for each failure.
#include "buffers.hpp"
#include "glsum/registry.hpp"
#include "plan.hpp"
#include "port.hpp"

namespace {

double sample(std::size_t k) { return (static_cast<double>((k * k * 5 + 3 * k) % 13) - 6.0) / 8.0; }

template <class K>
bool differences_are_exact(double order, std::size_t taps) {
    const auto buffers = firmware::buffers<K, 64>();
    typename K::State state;
    if (K::prepare(state, {order, taps}, buffers.table, buffers.past) != glsum::Status::ok) {
        return false;
    }
    for (std::size_t k = 0; k < 3 * taps + 5; ++k) {
        const double x0 = sample(k);
        const double x1 = k >= 1 && taps >= 2 ? sample(k - 1) : 0.0;
        const double x2 = k >= 2 && taps >= 3 ? sample(k - 2) : 0.0;
        const double expected = order == 1.0 ? x0 - x1 : x0 - 2.0 * x1 + x2;
        if (K::to_real(state, K::step(state, K::from_real(x0))) != expected) {
            return false;
        }
    }
    return true;
}

}  // namespace

int firmware_main() {
    int status = 0;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (K::past_count(2) > 0) {  // not null
            for (const double order : {1.0, 2.0}) {
                for (const std::size_t taps : {1U, 2U, 3U, 4U, 5U, 50U}) {
                    // Fewer than three do not hold a second difference: what is made of the rest is the history's.
                    const bool ends = glsum::forgotten_by<typename K::HistoryPart>() == glsum::Forgotten::zero;
                    if ((ends || taps >= 3) && !differences_are_exact<K>(order, taps)) {
                        firmware::Answer("failed: ").add(K::name()).number(taps).write();
                        status = 1;
                    }
                }
            }
        }
    });
    port::write(status == 0 ? "selftest: every kernel passed\n" : "selftest: failed\n");
    return status;
}
