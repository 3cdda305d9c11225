#include "drive/stand/blind/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stand::blind {
namespace {

double wilson(const Share& share, double side) {
    if (share.all == 0) {
        return side < 0.0 ? 0.0 : 1.0;
    }
    const double n = static_cast<double>(share.all);
    const double p = static_cast<double>(share.hits) / n;
    constexpr double z = 1.959963984540054;  // 97.5 % of the normal distribution
    const double middle = p + z * z / (2.0 * n);
    const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    return std::clamp((middle + side * half) / (1.0 + z * z / n), 0.0, 1.0);
}

}  // namespace

double Share::value() const { return all == 0 ? 0.0 : static_cast<double>(hits) / static_cast<double>(all); }
double Share::low() const { return wilson(*this, -1.0); }
double Share::high() const { return wilson(*this, 1.0); }

std::vector<Confidence> calibrate(std::span<const Claim> claims) {
    std::vector<Confidence> bins;
    for (const double from : {0.0, 0.5, 0.7, 0.8, 0.9, 0.95}) {
        if (!bins.empty()) {
            bins.back().to = from;
        }
        bins.push_back({from, 1.0 + 1e-12, {}});
    }
    for (const Claim& claim : claims) {
        for (Confidence& bin : bins) {
            if (claim.confidence >= bin.from && claim.confidence < bin.to) {
                bin.claimed += claim.confidence;
                bin.right.count(claim.right);
            }
        }
    }
    for (Confidence& bin : bins) {
        bin.claimed /= static_cast<double>(std::max<std::size_t>(bin.right.all, 1));
    }
    return bins;
}

double brier_score(std::span<const Claim> claims) {
    double square = 0.0;
    for (const Claim& claim : claims) {
        const double error = claim.confidence - (claim.right ? 1.0 : 0.0);
        square += error * error;
    }
    return claims.empty() ? 0.0 : square / static_cast<double>(claims.size());
}

Share right_of_the_sure(std::span<const Claim> claims) {
    Share share;
    for (const Claim& claim : claims) {
        if (claim.confidence >= sure) {
            share.count(claim.right);
        }
    }
    return share;
}

Share sure_of_the_right(std::span<const Claim> claims) {
    Share share;
    for (const Claim& claim : claims) {
        if (claim.right) {
            share.count(claim.confidence >= sure);
        }
    }
    return share;
}

base::Picture picture_of_calibration(std::span<const Claim> claims) {
    std::string rows;
    for (const Confidence& bin : calibrate(claims)) {
        if (bin.right.all > 0) {
            rows += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} \"{} of {}\"\n", bin.claimed, bin.right.value(),
                                bin.right.low(), bin.right.high(), bin.right.hits, bin.right.all);
        }
    }
    const Share certain = right_of_the_sure(claims);
    const std::string title =
        certain.all > 0
            ? fmt::format("Of {} answers with a confidence of 0.9 or more {} are right", certain.all, certain.hits)
            : fmt::format("None of {} answers has a confidence of 0.9 or more", claims.size());
    // gnuplot refuses a block without rows; one outside the axes shows nothing.
    return {fmt::format("$bins << EOD\n{}EOD\n"
                        "set title \"{}\\nBrier score {:.3f}, {} answers that name causes\" noenhanced\n"
                        "set xlabel \"confidence that an answer is given with\"\n"
                        "set ylabel \"share of such answers that is right\"\n"
                        "set grid lc rgb \"#dddddd\"\n"
                        "set border 3\n"
                        "set tics nomirror 0.1\n"
                        "set xrange [0:1.04]\n"
                        "set yrange [0:1.04]\n"
                        "set key top left\n"
                        "plot x with lines lw 2 dt 2 lc rgb \"#666666\" title \"as often right as it says\", \\\n"
                        "  $bins using 1:2:3:4 with yerrorbars pt 7 ps 1.2 lw 2 lc rgb \"{}\" title \"answers, with "
                        "95 % intervals\", \\\n"
                        "  $bins using 1:2:5 with labels offset -1,0.9 right notitle\n",
                        rows.empty() ? "-1 -1 -1 -1 \"\"\n" : rows, title, brier_score(claims), claims.size(),
                        base::palette[0]),
            700, 620};
}

}  // namespace stand::blind
