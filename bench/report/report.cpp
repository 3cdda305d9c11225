#include "bench/report/report.hpp"

#include <algorithm>

#include "base/files.hpp"
#include "bench/report/classic.hpp"
#include "bench/report/curves.hpp"
#include "bench/report/difference.hpp"
#include "bench/report/plot.hpp"
#include "bench/rows/csv.hpp"

namespace bench::report {

std::vector<std::filesystem::path> write_report(const Input& input, const Input* other,
                                                const std::filesystem::path& html) {
    std::vector<std::filesystem::path> written;
    const auto beside = [&](const char* end) {
        std::filesystem::path path = html;
        path.replace_extension();
        return written.emplace_back(path += end);
    };
    written.push_back(html);
    base::write_file(html, make_page(input, other));
    write_csv(beside(".csv"), input.results.rows);
    write_tidy_csv(beside("-tidy.csv"), input.results.rows);

    const std::vector<Group> groups = group(input.results.rows);
    const std::vector<Cost> costs = costs_of(groups);
    const std::vector<CurvePoint> points = curve_points(groups, costs);
    const WorstBounds bounds = worst_of_signals(input.bounds);
    write_curves(beside("-curves.csv"), points, costs, bounds);
    if (other != nullptr) {
        base::write_file(beside("-difference.csv"), to_csv(differences(input.results.rows, other->results.rows)));
    }
    if (std::any_of(points.begin(), points.end(), [](const CurvePoint& point) { return point.entry->error_max; })) {
        std::filesystem::path stem = html;
        stem.replace_extension();
        plot_error(groups, bounds, stem);
        beside(".svg");
        beside(".png");
        plot_costs(std::filesystem::path(stem) += "-cost", points, costs);
        beside("-cost.svg");
        beside("-cost.png");
        if (!gain_costs(points, costs).empty()) {
            plot_gains(stem += "-fronts", points, costs);
            beside("-fronts.svg");
            beside("-fronts.png");
        }
    }
    return written;
}

}  // namespace bench::report
