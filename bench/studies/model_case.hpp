// One model with one kernel and memory: what is stepped, and what that showed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/realtime.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/emulate/model_run.hpp"

namespace bench {

constexpr double model_step_s = 0.001;
constexpr double period_cycles = 216e6 * model_step_s;  ///< an STM32F746 at 1 kHz, where no other core is asked for
constexpr std::size_t emulated_double_taps = 600;       ///< longer ones take minutes in software

struct ModelCase {
    std::string model;
    std::string name;  ///< with the writing
    std::string kernel;
    drive::Writing writing;
    bool full;
    drive::RealtimeModel design;
    std::size_t steps;
    const std::vector<double>* exact;
    double error_max = 0.0;
    double error_rms = 0.0;
    double final_output = 0.0;
    std::uint32_t saturations = 0;
    double host_ns = 0.0;
    std::size_t macs = 0;
    std::vector<Counted> counted = {};  ///< on each emulated machine; empty where it was stepped on none
    std::string fault = {};

    [[nodiscard]] std::string length() const { return full ? "full" : design.memory().text(); }
    [[nodiscard]] bool in_double() const { return facts_of(kernel).in_double; }
    [[nodiscard]] bool runs_on_target() const { return !in_double() || design.memory().taps <= emulated_double_taps; }
    /// Whether every machine computed the host's bits.
    [[nodiscard]] bool same_bits() const {
        return std::all_of(counted.begin(), counted.end(), [](const Counted& on) { return on.same_bits; });
    }
};

/// An emulated machine, as tables of models show it.
struct ModelColumns {
    std::string machine = "M7";     ///< short
    double period = period_cycles;  ///< cycles of a step at 1 kHz
};

/// "216 000"
[[nodiscard]] std::string in_thousands(double cycles);

/// On this machine.
[[nodiscard]] Json to_host_row(const ModelCase& one);

/// On an emulated one. \param counted  of the case
/// \param core  which of the counted row's modelled cores; counts alone without
[[nodiscard]] Json to_target_row(const ModelCase& one, const Counted& counted, const std::string& aspect,
                                 std::optional<std::size_t> core = {}, double clock_hz = 1.0,
                                 double period = period_cycles);

/// Of one model, the machines beside each other. \param machines  one or more, in the order in which cases were counted
[[nodiscard]] std::string to_table(const std::vector<ModelCase>& cases, const std::string& model,
                                   const std::vector<ModelColumns>& machines = {{}});

/// The longest memory that a period leaves, if every cycle took an instruction, and what bytes 320 KB leave.
/// \param machine  which of those that cases were counted on
[[nodiscard]] std::string deadline_table(const std::vector<ModelCase>& cases, std::size_t machine = 0,
                                         const ModelColumns& columns = {});

}  // namespace bench
