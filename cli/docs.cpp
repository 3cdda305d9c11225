// glsum docs: the documentation as pages that need no server and no network.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "cli/board.hpp"
#include "cli/command.hpp"
#include "docs/site/facts/facts.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path out = std::filesystem::path(build_info::source_folder) / "build" / "docs" / "pages";
};

void run(const Options& options) {
    const std::filesystem::path source = build_info::source_folder;
    const std::filesystem::path facts = source / "build" / "docs" / "facts";
    if (exists(options.out) && !is_directory(options.out)) {
        throw Failure(Exit::bad_input, options.out.string() + ": expected a folder, found a file");
    }
    create_directories(facts);
    fmt::print("what kernels, cores and effects say of themselves\n");
    base::write_file(facts / "families.json", docs::families().dump(1));
    base::write_file(facts / "cores.json", docs::cores(cores_folder()).dump(1));
    base::write_file(facts / "effects.json", docs::effects().dump());
    std::fflush(stdout);
    // What Sphinx needs is written in Python; the rest of the work, its messages and its status are that program's.
    // Debian's, which has the packages that Debian installs; another may come first on the path.
    const char* const python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
    const std::string program = (source / "docs" / "site" / "build.py").string();
    const std::string out = std::filesystem::absolute(options.out).string();
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    execlp(python, python, program.c_str(), source.c_str(), facts.c_str(), out.c_str(), self.c_str(), nullptr);
    throw Failure(Exit::missing, std::string(python) + ": not found (Debian package python3-sphinx brings it)");
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "Pages of the READMEs, of docs/, of the library's headers; one for each kernel family, effect and core file.\n"
        "They open from the disk in any browser, without a server or a network.\n"
        "Example: glsum docs && xdg-open build/docs/pages/index.html");
    command.add_option("--out", options->out, "Folder of the pages")
        .type_name("FOLDER")
        .default_str("build/docs/pages");
    command.callback([options] { run(*options); });
}

}  // namespace cli
