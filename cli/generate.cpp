// glsum generate: the chosen kernel as one C99 header.
#include <fmt/format.h>

#include <memory>

#include "bench/files.hpp"
#include "bench/generate/header.hpp"
#include "cli/budget.hpp"
#include "cli/commands.hpp"

namespace cli {
void add_generate(CLI::App& app) {
    CLI::App* command = app.add_subcommand("generate", "A kernel as one C99 header for firmware");
    auto budget = add_budget(*command);
    auto spec = std::make_shared<generate::Spec>();
    auto out = std::make_shared<std::string>();
    command->add_option("--kernel", spec->kernel, "");
    command->add_option("--taps", spec->taps, "");
    command->add_option("--prefix", spec->prefix, "");
    command->add_option("--out", *out, "")->required();
    command->callback([=] {
        spec->order = budget->order;
        bench::write_file(*out, generate::make_header(*spec));
    });
}
}  // namespace cli
