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

}  // namespace

std::string to_table(const BandStudy& study, const std::vector<BandPoint>& points) {
    const std::vector<BandRival> compared = compare_bands(points);
    std::string text;
    for (const double order : study.orders) {
        text += fmt::format("\nOrder {}\n  {:<12} {:>5} {:>7} {:>10} {:>10} {:>10}  {:<22} {:>6}\n", order, "band, Hz",
                            "poles", "cycles", "Oustaloup", "Charef", "fitted", "kernel", "factor");
        for (const auto& band : study.bands) {
            for (const std::size_t poles : study.poles) {
                const std::string taps = fmt::format("1+{}", poles);
                const BandRival* oustaloup = find(compared, oustaloup_way, order, band, taps);
                const BandRival* charef = find(compared, charef_way, order, band, taps);
                if (oustaloup == nullptr || charef == nullptr) {
                    continue;
                }
                text += fmt::format(
                    "  {:<12} {:>5} {:>7.1f} {:>8} % {:>8} % {:>8} %  {:<22} {:>6.1f}\n",
                    fmt::format("{}..{}", band.low_hz, band.high_hz), poles, oustaloup->rival.model_cycles,
                    percent(oustaloup->rival.error), percent(charef->rival.error), percent(oustaloup->ours.error),
                    oustaloup->ours.way + " " + oustaloup->ours.taps, std::min(oustaloup->ratio(), charef->ratio()));
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
