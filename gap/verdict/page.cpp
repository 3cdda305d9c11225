#include "gap/verdict/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gap {
namespace {

constexpr double width = 1100.0;
constexpr double left_margin = 64.0;
constexpr double bottom_margin = 34.0;

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

// Round steps that give four to eight ticks.
std::vector<double> ticks(double low, double high) {
    const double rough = (high - low) / 6.0;
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

struct Trace {
    const char* css;
    std::vector<double> values;
};

class Plot {
public:
    Plot(const std::vector<double>& time_s, double height) : time_s_(time_s), height_(height) {}

    std::string draw(const std::vector<Trace>& lines, const std::string& label) const {
        double low = lines.front().values.front();
        double high = low;
        for (const Trace& line : lines) {
            for (const double value : line.values) {
                low = std::isfinite(value) ? std::min(low, value) : low;
                high = std::isfinite(value) ? std::max(high, value) : high;
            }
        }
        high = high > low ? high : low + 1.0;
        const double from_s = time_s_.front();
        const double to_s = time_s_.back();
        const auto x = [&](double t) {
            return left_margin + (width - left_margin - 10.0) * (t - from_s) / (to_s - from_s);
        };
        const auto y = [&](double v) { return 8.0 + (height_ - bottom_margin - 8.0) * (high - v) / (high - low); };
        std::string svg =
            fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, height_, escaped(label));
        for (const double tick : ticks(low, high)) {
            svg += fmt::format(
                "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
                "text-anchor=\"end\">{:.4g}</text>\n",
                left_margin, y(tick), width - 10.0, left_margin - 6.0, y(tick) + 4.0, tick);
        }
        for (const double tick : ticks(from_s, to_s)) {
            svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.4g}{}</text>\n", x(tick),
                               height_ - bottom_margin + 16.0, tick, tick == 0.0 ? " s" : "");
        }
        for (const Trace& line : lines) {
            svg += fmt::format("<polyline class=\"{}\" points=\"", line.css);
            const std::size_t stride = std::max<std::size_t>(1, line.values.size() / 2200);
            for (std::size_t i = 0; i < line.values.size(); i += stride) {
                if (std::isfinite(line.values[i])) {
                    svg += fmt::format("{:.1f},{:.1f} ", x(time_s_[i]), y(line.values[i]));
                }
            }
            svg += "\"/>\n";
        }
        return fmt::format("<p class=\"dim\">{}</p>\n", escaped(label)) + svg + "</svg>\n";
    }

private:
    const std::vector<double>& time_s_;
    double height_;
};

std::vector<double> simulated(const Curve& curve, const std::vector<double>& residuals) {
    std::vector<double> values = curve.measured;
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] -= residuals[i];
    }
    return values;
}

std::string bar(double share, const char* css) {
    return fmt::format("<span class=\"track\"><span class=\"{}\" style=\"width:{:.1f}%\"></span></span>", css,
                       100.0 * std::clamp(share, 0.0, 1.0));
}

std::string table_of(const std::vector<Share>& shares, const std::string& title, const std::string& unit) {
    std::string html = fmt::format("<section><h2>{}</h2><table>", escaped(title));
    for (const Share& share : shares) {
        html +=
            fmt::format("<tr><td>{:.4g} to {:.4g} {}</td><td>{}</td><td class=\"n\">{:.1f} %</td><td>{}</td></tr>\n",
                        share.from, share.to, unit, bar(share.share, "bar"), 100.0 * share.share, escaped(share.what));
    }
    return html + "</table></section>\n";
}

constexpr const char* style = R"(
:root{color-scheme:light dark;--ink:#1c2530;--dim:#667;--paper:#fff;--line:#dde1e6;--measured:#9aa4b0;--base:#d55e00;--after:#0072b2}
@media(prefers-color-scheme:dark){:root{--ink:#e6e9ed;--dim:#9aa;--paper:#14181d;--line:#2c333b;--measured:#77818c;--base:#ff8a3c;--after:#56b4e9}}
body{font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:1140px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem;margin:0}h2{font-size:1.05rem;margin:1.6rem 0 .4rem}p{margin:.3rem 0}.dim{color:var(--dim)}
svg{width:100%;height:auto;display:block}text{font:12px system-ui,sans-serif;fill:var(--dim)}
polyline{fill:none;stroke-width:1.6}.measured{stroke:var(--measured);stroke-width:3}.base{stroke:var(--base);stroke-dasharray:6 4}.after{stroke:var(--after)}
path.grid{stroke:var(--line)}table{border-collapse:collapse;width:100%}td,th{padding:.15rem .6rem .15rem 0;text-align:left;vertical-align:middle}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}.track{display:inline-block;width:220px;height:9px;background:var(--line);border-radius:5px;overflow:hidden}
.bar,.bar2{display:block;height:100%;background:var(--base)}.bar2{background:var(--after)}.key span{margin-right:1.4rem}.key i{display:inline-block;width:26px;border-top:3px solid;margin-right:.4rem;vertical-align:middle}
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:0 2.5rem}@media(max-width:520px){.columns{grid-template-columns:1fr}.track{width:90px}}
)";

}  // namespace

std::string to_html(const Verdict& verdict, const OfDrive& of, const std::vector<Curve>& curves) {
    const Gap& gap = verdict.gap;
    std::string named;
    for (const std::vector<Cause>& causes : of.alternatives) {
        named += (named.empty() ? ": " : " or ") + joined(causes);
    }
    std::string html = fmt::format(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>glsum: {0}{1}</title><style>{2}</style></head><body>\n<h1>{0}{1}</h1>\n"
        "<p>confidence {3:.2f}; gap ({4}) {5:.4f} before, {6:.4f} after, {7:.4f} at best</p>\n",
        name_of(verdict.outcome), escaped(named), style, of.confidence, escaped(gap.metric), gap.base, gap.after,
        gap.noise_floor);
    for (const std::string& line : {base_line(of), suspect_line(verdict, of)}) {
        html += line.empty() ? "" : fmt::format("<p>{}.</p>\n", escaped(line));
    }
    for (const std::vector<Cause>& causes : of.alternatives) {
        std::string items;
        for (const std::string& line : cause_lines(causes)) {
            items += fmt::format("<li>{}</li>", escaped(line));
        }
        html += items.empty() ? "" : fmt::format("<ul>{}</ul>\n", items);
    }
    if (!of.extrapolated.empty()) {
        html += fmt::format("<p class=\"dim\">Extrapolated, as training has none of it: {}.</p>\n",
                            escaped(fmt::format("{}", fmt::join(of.extrapolated, ", "))));
    }
    if (of.split) {
        html += "<p class=\"dim\">No validation log: parts of the training log were kept aside for it.</p>\n";
    }
    html += fmt::format(
        "<p class=\"key\"><span style=\"color:var(--measured)\"><i></i>measured</span><span "
        "style=\"color:var(--base)\"><i "
        "style=\"border-top-style:dashed\"></i>base</span>{}</p>\n",
        of.chosen == no_effect
            ? ""
            : fmt::format("<span style=\"color:var(--after)\"><i></i>base + {}</span>", escaped(of.chosen)));
    for (const Curve& curve : curves) {
        std::vector<Trace> lines{{"measured", curve.measured}, {"base", simulated(curve, curve.left_by_base)}};
        std::vector<Trace> gaps{{"base", curve.left_by_base}};
        if (!curve.left_by_chosen.empty()) {
            lines.push_back({"after", simulated(curve, curve.left_by_chosen)});
            gaps.push_back({"after", curve.left_by_chosen});
        }
        html += Plot(curve.time_s, 330.0).draw(lines, "output, " + curve.name);
        html += Plot(curve.time_s, 170.0).draw(gaps, "measured - simulated");
    }
    html +=
        "<h2>Candidates</h2><table><tr><th>effect</th><th></th><th class=\"n\">gap left</th><th class=\"n\">score over "
        "none</th></tr>\n";
    std::size_t rows = 0;
    for (const Rank& rank : verdict.ranking) {
        if (rows++ < 14 || rank.effects == no_effect) {
            html += fmt::format(
                "<tr><td>{}</td><td>{}</td><td class=\"n\">{:.4f}</td><td class=\"n\">{:.1f}</td></tr>\n",
                escaped(rank.effects),
                bar(gap.base > 0.0 ? rank.gap_after / gap.base : 0.0, rank.effects == of.chosen ? "bar2" : "bar"),
                rank.gap_after, rank.score - score_of_no_effect(verdict.ranking));
        }
    }
    html += "</table>\n<div class=\"columns\">\n" +
            table_of(of.where.time, "Where the base's squared gap lies: time", "s") +
            table_of(of.where.frequency, "frequency", "Hz") + table_of(of.where.input_level, "input level", "") +
            table_of(of.where.output_level, "output level", "") +
            fmt::format(
                "<section><h2>direction</h2><table><tr><td>rising</td><td>{}</td><td class=\"n\">{:.1f} %</td></tr>"
                "<tr><td>falling</td><td>{}</td><td class=\"n\">{:.1f} %</td></tr><tr><td>still</td><td>{}</td><td "
                "class=\"n\">{:.1f} %</td></tr></table></section></div>\n",
                bar(of.where.rising, "bar"), 100.0 * of.where.rising, bar(of.where.falling, "bar"),
                100.0 * of.where.falling, bar(of.where.still, "bar"), 100.0 * of.where.still);
    for (const std::string& note : verdict.notes) {
        html += fmt::format("<p class=\"dim\">Note: {}.</p>\n", escaped(note));
    }
    return html + fmt::format("<h2>Next</h2><p>{}.</p></body></html>\n", escaped(verdict.next_experiment));
}

}  // namespace gap
