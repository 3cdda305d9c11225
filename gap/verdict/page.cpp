#include "gap/verdict/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gap/verdict/plot.hpp"

namespace gap {
namespace {

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
svg{width:100%;height:auto;display:block}svg.phone{display:none}.shade{fill:var(--base)}code{font-size:.85em;overflow-wrap:anywhere}.bars{overflow-x:auto}text{font:12px system-ui,sans-serif;fill:var(--dim)}
polyline{fill:none;stroke-width:1.6}.measured{stroke:var(--measured);stroke-width:3}.base{stroke:var(--base);stroke-dasharray:6 4}.after{stroke:var(--after)}.other{stroke:var(--dim);stroke-dasharray:2 4}.input{stroke:var(--ink)}
path.grid{stroke:var(--line)}table{border-collapse:collapse;width:100%}td,th{padding:.15rem .6rem .15rem 0;text-align:left;vertical-align:middle}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}.track{display:inline-block;width:220px;height:9px;background:var(--line);border-radius:5px;overflow:hidden}
.bar,.bar2{display:block;height:100%;background:var(--base)}.bar2{background:var(--after)}.key span{margin-right:1.4rem}.key i{display:inline-block;width:26px;border-top:3px solid;margin-right:.4rem;vertical-align:middle}
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:0 2.5rem}@media(max-width:640px){svg.screen{display:none}svg.phone{display:block}.columns{grid-template-columns:1fr}.track{width:64px}td,th{overflow-wrap:anywhere}body{margin:1rem auto}}
)";

// Verdict, numbers and how it was asked: what a reader needs first.
std::string summary(const Verdict& verdict, const OfDrive& of, const std::string& command) {
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
    for (const std::vector<Cause>& causes : of.alternatives) {
        std::string items;
        for (const std::string& line : cause_lines(causes)) {
            items += fmt::format("<li>{}</li>", escaped(line));
        }
        html += items.empty() ? "" : fmt::format("<ul>{}</ul>\n", items);
    }
    for (const std::string& line : {base_line(of), suspect_line(verdict, of)}) {
        html += line.empty() ? "" : fmt::format("<p>{}.</p>\n", escaped(line));
    }
    if (!of.extrapolated.empty()) {
        html += fmt::format("<p class=\"dim\">Extrapolated, as training has none of it: {}.</p>\n",
                            escaped(fmt::format("{}", fmt::join(of.extrapolated, ", "))));
    }
    if (of.split) {
        html += "<p class=\"dim\">Judged by parts of the training log, which were kept aside.</p>\n";
    }
    return html + (command.empty() ? "" : fmt::format("<p class=\"dim\"><code>{}</code></p>\n", escaped(command)));
}

std::string key_of(const std::vector<std::pair<std::string, std::string>>& lines) {
    std::string html = "<p class=\"key\">";
    for (const auto& [name, colour] : lines) {
        html += fmt::format("<span style=\"color:var(--{0})\"><i{1}></i>{2}</span>", colour,
                            colour == "base" ? " style=\"border-top-style:dashed\"" : "", escaped(name));
    }
    return html + "</p>\n";
}

// Measured, base and base with what helps most, over one another; what they leave; what was put in.
std::string drawn(const Curve& curve) {
    std::vector<Trace> lines{{"measured", curve.measured}, {"base", simulated(curve, curve.left_by_base)}};
    std::vector<Trace> gaps{{"base", curve.left_by_base}};
    if (!curve.left_by_chosen.empty()) {
        lines.push_back({"after", simulated(curve, curve.left_by_chosen)});
        gaps.push_back({"after", curve.left_by_chosen});
    }
    const std::vector<double> shade = shade_of(curve.left_by_base, curve.time_s);
    std::string html =
        to_svg({"output, " + curve.name + "; shaded where the base's squared gap lies", 330.0, std::move(lines), shade},
               curve.time_s) +
        to_svg({"measured - simulated", 170.0, std::move(gaps), shade}, curve.time_s);
    if (!curve.input.empty()) {
        html += to_svg({"input", 120.0, {{"input", curve.input, true}}}, curve.time_s);
    }
    return html;
}

// What the simulations of a record that could be taken answer, and what is put in there.
std::string drawn(const NextRecord& next) {
    constexpr const char* styles[] = {"after", "base", "other"};
    std::vector<Trace> lines;
    std::vector<std::pair<std::string, std::string>> key;
    for (const auto& [name, output] : next.outputs) {
        const std::size_t which = std::min<std::size_t>(lines.size(), 2);
        lines.push_back({styles[which], output});
        key.emplace_back(name, which == 2 ? "dim" : styles[which]);
    }
    return key_of(key) + to_svg({"output, simulated: " + next.text, 220.0, std::move(lines)}, next.time_s) +
           to_svg({"input", 120.0, {{"input", next.input, true}}}, next.time_s);
}

std::string candidates(const Verdict& verdict, const OfDrive& of) {
    std::string html =
        "<h2>Candidates</h2><div class=\"bars\"><table><tr><th>effect</th><th></th><th class=\"n\">gap left</th><th "
        "class=\"n\">score over none</th></tr>\n";
    std::size_t rows = 0;
    for (const Rank& rank : verdict.ranking) {
        if (rows++ < 14 || rank.effects == no_effect) {
            html +=
                fmt::format("<tr><td>{}</td><td>{}</td><td class=\"n\">{:.4f}</td><td class=\"n\">{:.1f}</td></tr>\n",
                            escaped(rank.effects),
                            bar(verdict.gap.base > 0.0 ? rank.gap_after / verdict.gap.base : 0.0,
                                rank.effects == of.chosen ? "bar2" : "bar"),
                            rank.gap_after, rank.score - score_of_no_effect(verdict.ranking));
        }
    }
    return html + "</table></div>\n";
}

std::string places(const Where& where) {
    return "<div class=\"columns\">\n" + table_of(where.time, "Where the base's squared gap lies: time", "s") +
           table_of(where.frequency, "frequency", "Hz") + table_of(where.input_level, "input level", "") +
           table_of(where.output_level, "output level", "") +
           fmt::format(
               "<section><h2>direction</h2><table><tr><td>rising</td><td>{}</td><td class=\"n\">{:.1f} %</td></tr>"
               "<tr><td>falling</td><td>{}</td><td class=\"n\">{:.1f} %</td></tr><tr><td>still</td><td>{}</td><td "
               "class=\"n\">{:.1f} %</td></tr></table></section></div>\n",
               bar(where.rising, "bar"), 100.0 * where.rising, bar(where.falling, "bar"), 100.0 * where.falling,
               bar(where.still, "bar"), 100.0 * where.still);
}

}  // namespace

std::string to_html(const Verdict& verdict, const OfDrive& of, const Drawn& what) {
    std::string html = summary(verdict, of, what.command);
    std::vector<std::pair<std::string, std::string>> key{{"measured", "measured"}, {"base", "base"}};
    if (of.chosen != no_effect) {
        key.emplace_back("base + " + of.chosen, "after");
    }
    html += key_of(key);
    for (const Curve& curve : what.curves) {
        html += drawn(curve);
    }
    html += fmt::format("<h2>Next</h2><p>{}.</p>\n", escaped(verdict.next_experiment));
    if (what.next) {
        html += drawn(*what.next);
    }
    html += candidates(verdict, of) + places(of.where);
    for (const std::string& note : verdict.notes) {
        html += fmt::format("<p class=\"dim\">Note: {}.</p>\n", escaped(note));
    }
    return html + "</body></html>\n";
}

}  // namespace gap
