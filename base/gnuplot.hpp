// What every picture shares: gnuplot, its words, and the colours.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace base {

/// Okabe and Ito's palette, which colour-blind readers can tell apart; the yellow is a brown, which shows on white.
inline constexpr const char* palette[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                          "#E69F00", "#56B4E9", "#8C6D1F", "#666666"};

/// A text from a file as gnuplot may see it between double quotes: letters, digits and " _.:+-,/()"; others become '?',
/// so that no name can end the string or run a command. At most 60 characters.
[[nodiscard]] std::string gnuplot_text(const std::string& text);

/// "[low:high]" around values above 0 on a logarithmic axis, with room; also of a single value.
[[nodiscard]] std::string log_range(double smallest, double largest);

/// A gnuplot script without its terminal and output, and the size of the picture.
struct Picture {
    std::string script;
    std::size_t width = 1200;
    std::size_t height = 600;
};

/// Writes `stem`.svg and `stem`.png.
/// \throws glsum::Failure (missing) without gnuplot, (check failed) when it draws nothing, (bad input) when a file
/// cannot be written.
void draw(const Picture& picture, const std::filesystem::path& stem);

}  // namespace base
