#include "cli/output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/failure.hpp"
#include "base/files.hpp"

namespace cli {
namespace {

// Where standard output was before words for people were sent to standard error.
int programs_output() {
    static const int output = [] {
        std::fflush(stdout);
        const int kept = dup(STDOUT_FILENO);
        dup2(STDERR_FILENO, STDOUT_FILENO);
        return kept;
    }();
    return output;
}

}  // namespace

Option Output::add_to(Command& command, const std::string& name, const std::string& help) {
    option_ = command.add_option(name, file_, help + "; alone on standard output without FILE or with -");
    option_->expected(0, 1).type_name("[FILE]");
    command.prepare([this] {
        if (to_stdout()) {
            (void)programs_output();
        }
    });
    return *option_;
}

Output Output::or_to(const std::filesystem::path& out) const {
    Output other = *this;
    if (to_stdout() && !out.empty()) {
        other.file_ = out.string();
    }
    return other;
}

void Output::check() const {
    if (wanted() && !to_stdout()) {
        base::check_writable(file_);
    }
}

void Output::write(const std::string& text) const {
    if (!to_stdout()) {
        base::write_file(file_, text);
        return;
    }
    std::size_t written = 0;
    while (written < text.size()) {
        const ssize_t now = ::write(programs_output(), text.data() + written, text.size() - written);
        if (now < 0 && errno != EINTR) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
        }
        written += now > 0 ? static_cast<std::size_t>(now) : 0;
    }
}

}  // namespace cli
