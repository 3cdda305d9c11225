#include "gap/verdict/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gap {
namespace {

constexpr double left_margin = 64.0;
constexpr double right_margin = 10.0;
constexpr double top_margin = 8.0;
constexpr double bottom_margin = 34.0;

// Round steps, of which about `wanted` fit, 2 more at most.
std::vector<double> ticks(double low, double high, double wanted) {
    const double rough = (high - low) / wanted;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * decade;
    for (const double mantissa : {5.0, 2.0, 1.0}) {
        step = mantissa * decade >= rough ? mantissa * decade : step;
    }
    std::vector<double> at;
    for (double k = std::ceil(low / step); k * step <= high + 1e-9 * step; ++k) {
        at.push_back(k * step + 0.0);  // no -0
    }
    return at;
}

// A drawing of one size.
class Drawing {
public:
    Drawing(const PlotOf& plot, const std::vector<double>& time_s, double width, double height)
        : plot_(plot), time_s_(time_s), width_(width), height_(height) {
        low_ = high_ = plot.lines.front().values.front();
        for (const Trace& line : plot.lines) {
            for (const double value : line.values) {
                low_ = std::isfinite(value) ? std::min(low_, value) : low_;
                high_ = std::isfinite(value) ? std::max(high_, value) : high_;
            }
        }
        high_ = high_ > low_ ? high_ : low_ + 1.0;
    }

    [[nodiscard]] std::string text(const char* css) const {
        std::string svg = fmt::format("<svg class=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", css,
                                      width_, height_, escaped(plot_.label));
        svg += shade() + axes();
        for (const Trace& line : plot_.lines) {
            svg += polyline(line);
        }
        return svg + "</svg>\n";
    }

private:
    [[nodiscard]] double x(double t) const {
        return left_margin + (width_ - left_margin - right_margin) * (t - time_s_.front()) / duration();
    }
    [[nodiscard]] double y(double v) const {
        return top_margin + (height_ - bottom_margin - top_margin) * (high_ - v) / (high_ - low_);
    }
    [[nodiscard]] double duration() const { return time_s_.back() - time_s_.front(); }

    [[nodiscard]] std::string shade() const {
        std::string svg;
        const double parts = static_cast<double>(plot_.shade.size());
        for (std::size_t i = 0; i < plot_.shade.size(); ++i) {
            constexpr double darkest = 0.3;
            if (const double dark = darkest * plot_.shade[i]; dark >= 0.01) {
                const double from = x(time_s_.front() + duration() * static_cast<double>(i) / parts);
                const double to = x(time_s_.front() + duration() * static_cast<double>(i + 1) / parts);
                svg += fmt::format(
                    "<rect class=\"shade\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                    "opacity=\"{:.2f}\"/>\n",
                    from, top_margin, to - from, height_ - bottom_margin - top_margin, dark);
            }
        }
        return svg;
    }

    [[nodiscard]] std::string axes() const {
        std::string svg;
        for (const double tick : ticks(low_, high_, height_ < 150.0 ? 2.0 : 6.0)) {
            svg += fmt::format(
                "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
                "text-anchor=\"end\">{:.4g}</text>\n",
                left_margin, y(tick), width_ - right_margin, left_margin - 6.0, y(tick) + 4.0, tick);
        }
        for (const double tick : ticks(time_s_.front(), time_s_.back(), width_ < 600.0 ? 3.0 : 6.0)) {
            // At the picture's edge half of a label in the middle would be cut off.
            const bool at_edge = x(tick) > width_ - right_margin - 12.0;
            svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{:.4g}{}</text>\n",
                               at_edge ? width_ : x(tick), height_ - bottom_margin + 16.0, at_edge ? "end" : "middle",
                               tick, tick == 0.0 ? " s" : "");
        }
        return svg;
    }

    [[nodiscard]] std::string polyline(const Trace& line) const {
        std::string svg = fmt::format("<polyline class=\"{}\" points=\"", line.css);
        const auto most = static_cast<std::size_t>(2.0 * width_);
        const std::size_t stride = std::max<std::size_t>(1, line.values.size() / most);
        double before = std::nan("");
        for (std::size_t i = 0; i < line.values.size(); i += stride) {
            if (std::isfinite(line.values[i])) {
                if (line.held && std::isfinite(before) && before != line.values[i]) {
                    svg += fmt::format("{:.1f},{:.1f} ", x(time_s_[i]), y(before));
                }
                svg += fmt::format("{:.1f},{:.1f} ", x(time_s_[i]), y(line.values[i]));
                before = line.values[i];
            }
        }
        return svg + "\"/>\n";
    }

    const PlotOf& plot_;
    const std::vector<double>& time_s_;
    double width_;
    double height_;
    double low_ = 0.0;
    double high_ = 0.0;
};

}  // namespace

std::string to_svg(const PlotOf& plot, const std::vector<double>& time_s) {
    constexpr double screen_width = 1100.0;
    constexpr double phone_width = 400.0;
    return fmt::format("<p class=\"dim\">{}</p>\n", escaped(plot.label)) +
           Drawing(plot, time_s, screen_width, plot.height).text("screen") +
           Drawing(plot, time_s, phone_width, std::max(110.0, 0.6 * plot.height)).text("phone");
}

std::vector<double> shade_of(const std::vector<double>& residual, const std::vector<double>& time_s) {
    constexpr std::size_t parts = 60;
    std::vector<double> squares(parts, 0.0);
    const double duration = time_s.back() - time_s.front();
    for (std::size_t i = 0; i < residual.size(); ++i) {
        const double share = duration > 0.0 ? (time_s[i] - time_s.front()) / duration : 0.0;
        const auto part = std::min(parts - 1, static_cast<std::size_t>(share * static_cast<double>(parts)));
        squares[part] += std::isfinite(residual[i]) ? residual[i] * residual[i] : 0.0;
    }
    const double most = *std::max_element(squares.begin(), squares.end());
    for (double& square : squares) {
        square = most > 0.0 ? square / most : 0.0;
    }
    return squares;
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '&':
                safe += "&amp;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

}  // namespace gap
