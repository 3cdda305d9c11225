#include <fmt/format.h>

#include <algorithm>

#include "base/rounded_up.hpp"
#include "bench/studies/bands.hpp"

namespace bench {
namespace {

std::string percent(double error) { return base::rounded_up(100.0 * error); }

const BandRival* find(const std::vector<BandRival>& compared, const char* way, double order,
                      const glsum::design::Band& band, const std::string& taps) {
    for (const BandRival& one : compared) {
        if (one.rival.way == way && one.rival.order == order && one.rival.band == band && one.rival.taps == taps) {
            return &one;
        }
    }
    return nullptr;
}

// Both filters of so many poles in one form; empty where a kernel cannot hold one of them.
std::string line(const std::vector<BandRival>& compared, double order, const glsum::design::Band& band,
                 std::size_t poles, bool cascade) {
    const std::string taps = fmt::format("1+{}", poles);
    const BandRival* const oustaloup = find(compared, rivals[cascade ? 1 : 0].way, order, band, taps);
    const BandRival* const charef = find(compared, rivals[cascade ? 3 : 2].way, order, band, taps);
    if (oustaloup == nullptr || charef == nullptr) {
        return "";
    }
    return fmt::format("  {:<12} {:>5}  {:<8} {:>6.1f} {:>5} {:>8} % {:>8} % {:>8} %  {:<25} {:>5} {:>6.1f}\n",
                       fmt::format("{}..{}", band.low_hz, band.high_hz), poles, cascade ? "cascade" : "parallel",
                       oustaloup->rival.model_cycles, oustaloup->rival.bytes, percent(oustaloup->rival.error),
                       percent(charef->rival.error), percent(oustaloup->ours.error),
                       oustaloup->ours.way + " " + oustaloup->ours.taps, oustaloup->ours.bytes,
                       std::min(oustaloup->ratio(), charef->ratio()));
}

}  // namespace

std::string to_table(const BandStudy& study, const std::vector<BandPoint>& points) {
    const std::vector<BandRival> compared = compare_bands(points);
    std::string text;
    for (const double order : study.orders) {
        text += fmt::format("\nOrder {}\n  {:<12} {:>5}  {:<8} {:>6} {:>5} {:>10} {:>10} {:>10}  {:<25} {:>5} {:>6}\n",
                            order, "band, Hz", "poles", "form", "cycles", "bytes", "Oustaloup", "Charef", "fitted",
                            "kernel", "bytes", "factor");
        for (const auto& band : study.bands) {
            for (const std::size_t poles : study.poles) {
                for (const bool cascade : {false, true}) {
                    text += line(compared, order, band, poles, cascade);
                }
            }
        }
    }
    std::vector<double> ratios;
    for (const BandRival& one : compared) {
        ratios.push_back(one.ratio());
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty()) {
        const auto behind = std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio < 1.0; });
        text += fmt::format(
            "\nOf {} comparisons at equal cycles the fitted filter errs more in {}; the other's error is {:.3g} to "
            "{:.3g} times its own, {:.3g} times in the median.\n",
            ratios.size(), behind, ratios.front(), ratios.back(), ratios[ratios.size() / 2]);
    }
    return text;
}

}  // namespace bench
