// replay: does this machine compute the host's bits? Answers `row <n> <status> <hash of all outputs>`.
#include "output_hash.hpp"
#include "program.hpp"

int firmware_main() {
    return firmware::run_plan(
        []<class K>(const firmware::PlanRow& row, firmware::Signal signal, firmware::Answer& answer) {
            const auto buffers = firmware::buffers<K>();
            typename K::State state;
            const glsum::Status status = K::prepare(state, {row.order, row.taps}, buffers.table, buffers.past);
            answer.number(static_cast<unsigned>(status));
            if (status != glsum::Status::ok) {
                return;
            }
            firmware::OutputHash hash;
            for (std::size_t k = 0; k < row.calls; ++k) {
                hash.add(K::step(state, K::from_real(signal.at(k))));
            }
            answer.number(hash.value(), 16);
        });
}
