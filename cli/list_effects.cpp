// glsum list effects: what the diagnosis looks for, a line each, the name first.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.hpp"
#include "gap/drive/effect.hpp"

namespace cli {

void add_options(Command& command, const Words&) {
    command.footer(
        "Where it acts, and what files call its numbers.\n"
        "Example: glsum list effects | grep sensor");
    command.callback([] {
        for (const gap::Effect* effect : gap::effects()) {
            std::vector<std::string> numbers;
            for (const gap::Number& number : effect->numbers) {
                numbers.push_back(number.name);
            }
            fmt::print("{:<30} {:<9} {}\n", effect->name, name_of(effect->place), fmt::join(numbers, ", "));
        }
    });
}

}  // namespace cli
