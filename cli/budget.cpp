#include "cli/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <thread>

#include "bench/choose/derivative_plot.hpp"
#include "cli/board.hpp"
#include "cli/derivative_goal.hpp"
#include "qemu/emulate/foreign_program.hpp"

namespace cli {

std::shared_ptr<Budget> add_budget(Command& command, bool needs_order) {
    auto budget = std::make_shared<Budget>();
    budget->jobs = std::max(1U, std::thread::hardware_concurrency());
    Option order = command.add_option("--order", budget->order, "Order v in (-2, 2]").within(-2, 2);
    if (needs_order) {
        order.required();
    } else {
        budget->order = std::numeric_limits<double>::quiet_NaN();
    }
    command
        .add_option("--step-s", budget->step_s,
                    "Seconds from sample to sample: the sines and the drive's response are sampled there")
        .within(0, 1000);
    command
        .add_option("--max-error", budget->max_error,
                    "Largest error of the sum, relative to the largest exact full-memory sum, before h^-v")
        .above(0);
    add_goal(command, *budget);
    command.add_option("--plot", budget->plot,
                       "With --derivative-error: draws gain, phase and step response there (FILE.svg and FILE.png)");
    command.add_option("--signal", budget->signals, "The error is the worst of these records (default: all of them)")
        .delimiter(',');
    command
        .add_option("--max-cycles", budget->max_cycles, "Cycles a sample: the host's, or the timing model's upper end")
        .above(0);
    command
        .add_option("--max-instructions", budget->max_instructions,
                    "Instructions a sample, --target m7 or m4: ranked and limited in place of cycles")
        .above(0);
    command.add_option("--max-bytes", budget->max_bytes, "Bytes of state and coefficients").above(0);
    command.add_option("--clock-hz", budget->clock_hz, "The core's clock: with --rate-hz, says the share of real time")
        .above(0);
    command.add_option("--rate-hz", budget->rate_hz, "Samples a second").above(0);
    command.add_option("--target", budget->target, "host, m7 or m4; choose takes m7,m4: both beside each other");
    command.add_option(
        "--core", budget->core,
        fmt::format("Core of the timing model, a file of qemu/cores, whose cycles are ranked and limited "
                    "(default with --target m7: {}, m4: {}; with --max-instructions: none, instructions are)",
                    base::machines[0].default_core, base::machines[1].default_core));
    command.add_option("--results", budget->results,
                       "Earlier measurements (default: results/latest.json if it is there); only rows of this very "
                       "build count, at h = 1 ms");
    command.add_flag("--fresh", budget->fresh, "Measure everything, whatever the results hold");
    command.add_flag("--quick", budget->quick, "Records of 1000 samples instead of 5000, like bench --quick");
    command
        .add_option("--samples", budget->samples,
                    "Records of so many samples; of a sum the time of a search grows with their square")
        .between(2, most_samples_of_a_record);
    command.add_option("--jobs", budget->jobs, "Threads and emulators at once").at_least(1);
    return budget;
}

void plot_if_asked(const Budget& budget, const choose::Answer& answer) {
    if (!budget.plot.empty()) {
        const std::filesystem::path file(budget.plot);
        const bool named = file.extension() == ".png" || file.extension() == ".svg";
        choose::plot_derivative(answer.derivative.value(), *answer.question.goal, answer.question.max_error,
                                named ? std::filesystem::path(file).replace_extension() : file);
    }
}

std::optional<qemu::Board> board_for(const choose::Question& question) {
    const base::Machine* const machine = choose::machine_of(question.target);
    return machine != nullptr ? built_board(*machine) : board_if_there();
}

}  // namespace cli
