// What `measure` and `replay` share: they read a plan and its signals and carry out one row after the other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "buffers.hpp"
#include "glsum/registry.hpp"
#include "plan.hpp"
#include "port.hpp"
#include "shared/output_hash.hpp"

namespace firmware {

/// A record of the plan's signals, repeated without end.
struct Signal {
    const double* samples;
    std::size_t count;
    [[nodiscard]] double at(std::size_t k) const { return samples[k % count]; }
};

/// Prepares the row's kernel, adds the status to the answer and makes the row's calls from a cleared past, all outputs
/// into the hash. \param before  called with the number of each call before it \return false when `prepare` refused.
template <class K, class Before>
bool run_row(const PlanRow& row, Signal signal, Answer& answer, typename K::State& state, OutputHash& hash,
             Before before) {
    const auto memory = buffers<K, 8192>();
    const glsum::Status status = K::prepare(state, row.design(), memory.table, memory.past);
    answer.number(static_cast<unsigned>(status));
    if (status != glsum::Status::ok) {
        return false;
    }
    for (std::size_t k = 0; k < row.calls; ++k) {
        before(k);
        hash.add(K::step(state, K::from_real(signal.at(k))));
    }
    return true;
}

/// Carries out the plan named on the command line: `run_row.template operator()<K>(row, signal, answer)` for each row.
/// Answers `row <number> ...` for each and `end <rows>` last. \return the exit status.
template <class RunRow>
int run_plan(RunRow run_row) {
    alignas(8) static std::byte plan_bytes[512 * 1024];
    alignas(8) static std::byte signal_bytes[1024 * 1024];
    std::string_view command = port::command_line();
    take_word(command);
    const auto plan_file = port::read_file(take_word(command), plan_bytes);
    std::string_view plan{reinterpret_cast<const char*>(plan_file.data()), plan_file.size()};
    if (take_word(plan) != "glsum-plan-3") {
        port::write("error: no plan of the form glsum-plan-3\n");
        return 2;
    }
    const auto signals = port::read_file(take_word(plan), signal_bytes);
    std::size_t samples = 0;  // of each signal
    const std::size_t all_samples = signals.size() / sizeof(double);
    if (!to_number(take_word(plan), samples) || samples == 0 || all_samples == 0 || all_samples % samples != 0 ||
        signals.size() % sizeof(double) != 0) {
        port::write("error: the signals do not have the length that the plan names\n");
        return 2;
    }
    const auto* doubles = reinterpret_cast<const double*>(signals.data());
    std::size_t number = 0;
    for (; !plan.empty(); ++number) {
        static PlanRow row;  // too large for the stack
        if (!take_row(plan, row)) {
            port::write("error: the plan has a damaged row\n");
            return 2;
        }
        Answer answer("row");
        answer.number(number);
        bool found = false;
        if (row.signal < all_samples / samples) {
            glsum::Registry::for_each([&]<class K>() {
                if (K::name() == row.kernel) {
                    found = true;
                    run_row.template operator()<K>(row, Signal{doubles + row.signal * samples, samples}, answer);
                }
            });
        }
        if (!found) {
            port::write("error: the plan names a kernel or a signal that this program does not have\n");
            return 2;
        }
        answer.write();
    }
    Answer("end").number(number).write();
    return 0;
}

}  // namespace firmware
