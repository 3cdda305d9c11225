#include "gap/cycles/locate.hpp"

#include <algorithm>
#include <cmath>

namespace gap::cycles {

WhereInRows locate(const Evidence& evidence, const Cycles& base) {
    std::map<std::string, double> kernels;
    std::map<std::string, double> placements;
    std::map<std::string, Rows> lines;
    double sum = 0.0;
    for (const std::size_t i : evidence.to_judge()) {
        const auto& row = evidence.rows()[i];
        const double off = std::fabs(evidence.measured()[i] - base[i]) / row.per;
        sum += off;
        kernels[row.kernel] += off;
        placements[placement_of(row)] += off;
        lines[row.kernel + " " + placement_of(row)].push_back(i);
    }
    double slope = 0.0;
    double constant = 0.0;
    for (const auto& [name, rows] : lines) {
        std::vector<double> taps;
        std::vector<double> rest;
        for (const std::size_t i : rows) {
            taps.push_back(evidence.rows()[i].taps);
            rest.push_back(evidence.measured()[i] - base[i]);
        }
        const qemu::FittedLine line = qemu::fit_line(taps, rest);
        for (const double one : taps) {
            slope += std::fabs(line.slope * one);
            constant += std::fabs(line.constant);
        }
    }
    const auto shares = [](const std::map<std::string, double>& parts, double all) {
        std::vector<NamedShare> found;
        for (const auto& [name, part] : parts) {
            found.push_back({name, all > 0.0 ? part / all : 1.0 / static_cast<double>(parts.size())});
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const NamedShare& a, const NamedShare& b) { return a.share > b.share; });
        return found;
    };
    return {shares(kernels, sum), shares(placements, sum),
            shares({{"slope", slope}, {"constant", constant}}, slope + constant)};
}

}  // namespace gap::cycles
