#include "base/gnuplot.hpp"

#include <fmt/format.h>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "base/failure.hpp"
#include "base/files.hpp"

namespace base {
namespace {

// Between single quotes gnuplot takes all as it is, and two of them for one.
std::string quoted_path(const std::filesystem::path& path) {
    std::string text = "'";
    for (const char c : path.string()) {
        text += c == '\'' ? "''" : std::string(1, c);
    }
    return text + "'";
}

// Debian's package fonts-dejavu-core has it: pictures look the same wherever they are drawn. It is as wide as Helvetica
// of a tenth more, for which a machine may have a wider one.
constexpr const char* installed_font = "DejaVu Sans,9";

void run_gnuplot(const std::string& script, const std::filesystem::path& path) {
    void (*const before)(int) = std::signal(SIGPIPE, SIG_IGN);  // without gnuplot nobody reads
    FILE* pipe = popen("gnuplot >/dev/null", "w");
    const bool written = pipe != nullptr && std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    std::signal(SIGPIPE, before);
    if (!written || status != 0) {
        throw glsum::Failure(glsum::Exit::missing,
                             fmt::format("{}: gnuplot failed (Debian package gnuplot-nox)", path.string()));
    }
}

}  // namespace

std::string gnuplot_text(const std::string& text) {
    std::string safe;
    for (const char c : text.substr(0, 60)) {
        const bool harmless = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                              std::string_view(" _.:+-,/()").find(c) != std::string_view::npos;
        safe += harmless ? c : '?';
    }
    return safe;
}

std::string log_range(double smallest, double largest) {
    return fmt::format("[{:.4e}:{:.4e}]", smallest / 1.5, largest * 1.5);
}

void draw(const Picture& picture, const std::filesystem::path& stem) {
    for (const bool svg : {true, false}) {
        std::filesystem::path path = stem;
        path += svg ? ".svg" : ".png";
        const std::filesystem::path partial = partial_name(path);
        run_gnuplot(fmt::format("set terminal {} size {},{} font \"{}\" background rgb \"white\"\n"
                                "set output {}\n{}\nunset output\n",
                                svg ? "svg" : "pngcairo", picture.width, picture.height,
                                svg ? "Helvetica,12" : installed_font, quoted_path(partial), picture.script),
                    path);
        std::error_code error;
        if (const auto size = std::filesystem::file_size(partial, error); error || size == 0) {
            std::filesystem::remove(partial, error);
            throw glsum::Failure(glsum::Exit::check_failed, fmt::format("{}: gnuplot drew nothing", path.string()));
        }
        publish(partial, path);
    }
}

}  // namespace base
