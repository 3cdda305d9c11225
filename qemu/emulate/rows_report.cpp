// The fit of measured rows, for people and as a file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>

#include "qemu/emulate/rows_fit.hpp"

namespace qemu {
namespace {

constexpr std::size_t worst_rows = 10;
constexpr std::size_t greatest_losses = 4;

std::string place_of(const std::string& word) { return word.empty() ? "-" : word; }

// "load_use 12.0, ...": where the predicted cycles of a row went, beside half a cycle an instruction.
std::string losses_of(const PredictedCall& predicted) {
    std::array<std::size_t, timing::effect_count> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return predicted.lost[a] > predicted.lost[b]; });
    std::string text;
    for (std::size_t n = 0; n < greatest_losses && predicted.lost[order[n]] > 0.0; ++n) {
        text += fmt::format("{}{} {:.3g}", n > 0 ? ", " : "", timing::effect_names[order[n]], predicted.lost[order[n]]);
    }
    return text;
}

}  // namespace

namespace {

std::string band_of(const BandFit& band) {
    return fmt::format("{:>9.1f}% {:>7.1f}% {:>6.1f}%", 100 * band.half_width, 100 * band.inside,
                       100 * band.interval_score);
}

// The mean over all rows of the groups, or of the authors.
std::string mean_of(const std::vector<GroupLeftOut>& left_out, bool of_authors) {
    double rows = 0.0;
    BandFit as_it_is{};
    BandFit from_others{};
    const auto add = [&rows](BandFit& sum, const BandFit& band, double count) {
        sum.half_width += (band.half_width - sum.half_width) * count / rows;
        sum.inside += (band.inside - sum.inside) * count / rows;
        sum.interval_score += (band.interval_score - sum.interval_score) * count / rows;
    };
    for (const GroupLeftOut& one : left_out) {
        if (one.is_author == of_authors) {
            const auto count = static_cast<double>(one.rows);
            rows += count;
            add(as_it_is, one.as_it_is, count);
            add(from_others, one.from_others, count);
        }
    }
    return fmt::format("{:<28} {:>5} {} {:>7} {}\n", of_authors ? "all, by authors" : "all, each unseen", rows,
                       band_of(as_it_is), "", band_of(from_others));
}

std::string left_out_of(const std::vector<GroupLeftOut>& left_out) {
    std::string text =
        fmt::format("\n{:<28} {:>5} {:^26} {:^34}\n{:<28} {:>5} {:>10} {:>8} {:>7} {:>7} {:>10} {:>8} {:>7}\n", "", "",
                    "the band", "as wide as the others ask", "left out", "rows", "half-width", "inside", "score",
                    "scale", "half-width", "inside", "score");
    bool authors = false;
    for (const GroupLeftOut& one : left_out) {
        if (one.is_author && !authors) {
            authors = true;
            text += mean_of(left_out, false);
        }
        text += fmt::format("{:<28} {:>5} {} {:>7.2f} {}\n", one.group + (one.is_author ? "/" : ""), one.rows,
                            band_of(one.as_it_is), one.scale, band_of(one.from_others));
    }
    return text + mean_of(left_out, authors);
}

}  // namespace

std::string to_text(const std::string& name, const std::vector<MeasuredCall>& rows,
                    const std::vector<PredictedCall>& predicted, const RowsFit& fit) {
    std::string text =
        fmt::format("{}: {} rows\n\n{:>5} {:<32} {:<16} {:<6} {:<5} {:>10} {:>10} {:>21} {:>8}\n", name, rows.size(),
                    "line", "function", "core", "code", "data", "measured", "predicted", "band", "error");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const MeasuredCall& row = rows[i];
        const PredictedCall& p = predicted[i];
        text += fmt::format("{:>5} {:<32} {:<16} {:<6} {:<5} {:>10.6g} {:>10.6g} {:>21} {:>+7.1f}%{}{}\n", row.line,
                            row.function, row.core, place_of(row.code), place_of(row.data), row.cycles, p.cycles,
                            fmt::format("{:.6g} to {:.6g}", p.low, p.high), 100 * fit.rows[i].error,
                            fit.rows[i].inside ? "" : "  outside", fit.rows[i].missed ? "  MISSED" : "");
    }
    if (!fit.lines.empty()) {
        text += fmt::format("\n{:<38} {:>5} {:>9} {:>9} {:>10} {:>10}\n", "cycles an instruction and beside them",
                            "rows", "measured", "predicted", "measured", "predicted");
        for (const RowLine& line : fit.lines) {
            text +=
                fmt::format("{:<38} {:>5} {:>9.3f} {:>9.3f} {:>10.1f} {:>10.1f}\n",
                            fmt::format("{} {} {}", line.function, place_of(line.code), place_of(line.data)), line.rows,
                            line.measured_slope, line.predicted_slope, line.measured_constant, line.predicted_constant);
        }
    }
    text += fmt::format("\n{:>5} {:<32} {:>8}  {}\n", "line", "the worst rows", "error", "lost to, cycles as measured");
    for (std::size_t n = 0; n < std::min(worst_rows, rows.size()); ++n) {
        const std::size_t i = fit.worst[n];
        text += fmt::format("{:>5} {:<32} {:>+7.1f}%  {}\n", rows[i].line, rows[i].function, 100 * fit.rows[i].error,
                            losses_of(predicted[i]));
    }
    if (!fit.left_out.empty()) {
        text += left_out_of(fit.left_out);
    }
    text += fmt::format(
        "\nmedian error {:.2f} %, worst {:+.1f} %; {} of {} rows within {:.0f} % or {:.0f} cycles\n"
        "{:.1f} % of the rows inside the band; its median half-width {:.1f} %, mean interval score {:.1f} %\n",
        100 * fit.median_error, 100 * fit.worst_error, rows.size() - fit.missed, rows.size(), 100 * allowed_share,
        allowed_cycles, 100 * fit.inside, 100 * fit.median_half_width, 100 * fit.mean_interval_score);
    return text;
}

std::string to_json(const std::string& name, const std::vector<MeasuredCall>& rows,
                    const std::vector<PredictedCall>& predicted, const RowsFit& fit) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["schema"] = "glsum-silicon-rows-1";
    json["file"] = name;
    json["rows"] = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const MeasuredCall& row = rows[i];
        Json stalls = Json::object();
        for (std::size_t e = 0; e < timing::effect_count; ++e) {
            stalls[std::string(timing::effect_names[e])] = predicted[i].lost[e];
        }
        json["rows"].push_back({{"line", row.line},
                                {"elf", row.elf.string()},
                                {"function", row.function},
                                {"core", row.core},
                                {"placement", {{"code", row.code}, {"data", row.data}}},
                                {"per", row.per},
                                {"measured", row.cycles},
                                {"predicted", predicted[i].cycles},
                                {"low", predicted[i].low},
                                {"high", predicted[i].high},
                                {"instructions", predicted[i].instructions},
                                {"error", fit.rows[i].error},
                                {"inside_band", fit.rows[i].inside},
                                {"missed", fit.rows[i].missed},
                                {"interval_score", fit.rows[i].interval_score},
                                {"stalls", stalls}});
    }
    json["slopes"] = Json::array();
    for (const RowLine& line : fit.lines) {
        json["slopes"].push_back(
            {{"function", line.function},
             {"core", line.core},
             {"placement", {{"code", line.code}, {"data", line.data}}},
             {"rows", line.rows},
             {"cycles_per_instruction", {{"measured", line.measured_slope}, {"predicted", line.predicted_slope}}},
             {"constant", {{"measured", line.measured_constant}, {"predicted", line.predicted_constant}}}});
    }
    json["left_out"] = Json::array();
    for (const GroupLeftOut& one : fit.left_out) {
        json["left_out"].push_back({{"group", one.group},
                                    {"rows", one.rows},
                                    {"author", one.is_author},
                                    {"half_width", one.from_others.half_width},
                                    {"inside", one.from_others.inside},
                                    {"interval_score", one.from_others.interval_score},
                                    {"scale", one.scale},
                                    {"band",
                                     {{"half_width", one.as_it_is.half_width},
                                      {"inside", one.as_it_is.inside},
                                      {"interval_score", one.as_it_is.interval_score}}}});
    }
    json["median_error"] = fit.median_error;
    json["worst_error"] = fit.worst_error;
    json["inside_band"] = fit.inside;
    json["median_half_width"] = fit.median_half_width;
    json["mean_interval_score"] = fit.mean_interval_score;
    json["missed"] = fit.missed;
    return json.dump(1) + "\n";
}

}  // namespace qemu
