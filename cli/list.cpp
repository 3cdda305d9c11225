// glsum list: what there is, a line each, the name first.
#include <fmt/format.h>

#include <algorithm>

#include "base/failure.hpp"
#include "bench/run/usual_sweep.hpp"
#include "bench/sweep/signals.hpp"
#include "cli/board.hpp"
#include "cli/command.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/timing/core_file.hpp"

namespace cli {
namespace {

void list_kernels() {
    for (const glsum::CatalogueEntry& kernel : glsum::catalogue) {
        fmt::print("{:<27} {}{}{}{}\n", kernel.name, kernel.family.keeps,
                   kernel.forgotten == glsum::Forgotten::increments ? ", of increments"
                   : kernel.forgotten == glsum::Forgotten::held     ? ", and the oldest one for what it dropped"
                   : kernel.forgotten == glsum::Forgotten::line ? ", and a line to the first one for what it dropped"
                                                                : "",
                   kernel.integrator ? "; integrals alone" : "", kernel.host_only ? "; on the host alone" : "");
    }
}

void list_orders() {
    const std::vector<double> quick = bench::usual_sweep(true).orders;
    for (const double order : bench::usual_sweep(false).orders) {
        const bool in_quick = std::find(quick.begin(), quick.end(), order) != quick.end();
        fmt::print("{:<8} {} of bench{}\n", order, order < 0.0 ? "an integral" : "a derivative",
                   in_quick ? ", and of bench --quick" : "");
    }
}

void list_cores() {
    for (const std::string& name : timing::core_names(cores_folder())) {
        fmt::print("{:<25} {}\n", name, timing::read_core(cores_folder(), name).note);
    }
}

void list_signals() {
    for (const std::string_view name : bench::signal_names) {
        fmt::print("{:<8} {}\n", name, bench::meaning_of_signal(name));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto what = std::make_shared<std::string>();
    command.footer(
        "list effects has what the diagnosis looks for.\n"
        "Example: glsum list kernels | grep 'full memory'");
    command.add_option("what", *what, "Of what").one_of({"kernels", "orders", "cores", "signals"});
    command.callback([what] {
        if (what->empty()) {
            throw glsum::Failure(glsum::Exit::bad_input, "list: expected kernels, orders, cores, signals or effects");
        }
        *what == "kernels"  ? list_kernels()
        : *what == "orders" ? list_orders()
        : *what == "cores"  ? list_cores()
                            : list_signals();
    });
}

}  // namespace cli
