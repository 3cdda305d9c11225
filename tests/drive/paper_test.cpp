// What `glsum paper` says of each claim: its numbers by hand from the printed tables, or from the responses themselves.
#include "drive/paper.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <regex>

#include "drive/indices.hpp"
#include "drive/pictures.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Holds;
using testing::HasSubstr;
using testing::Not;

const drive::PaperModels models{plants::fopdt(), plants::sopdt(), plants::niopdt()};

drive::Model without_delay() {
    drive::Model model = plants::niopdt();
    model.delay_s = 0.0;
    return model;
}

std::vector<double> times() {
    std::vector<double> all;
    for (int k = 0; k <= 5000; ++k) {
        all.push_back(0.001 * k);
    }
    return all;
}

std::vector<double> response_of(const drive::Model& model) {
    drive::StepResponse step(model);
    std::vector<double> all;
    for (const double t : times()) {
        all.push_back(step(t));
    }
    return all;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        largest = std::max(largest, std::fabs(a[k] - b[k]));
    }
    return largest;
}

TEST(Paper, EachClaimIsJudgedByItsNumbers) {
    const auto claims = drive::check_paper(models);
    ASSERT_EQ(claims.size(), 10U);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(claims[i].paper, "stable");
        EXPECT_EQ(claims[i].holds, Holds::yes) << claims[i].claim << claims[i].ours;
        EXPECT_THAT(claims[i].ours, HasSubstr("stable: "));
        EXPECT_THAT(claims[i].ours, HasSubstr("by the argument principle 0 unstable"));
    }
    // The sectors end at q pi/2; in s^0.01 model (12) has as many roots as its largest order has hundredths, about.
    EXPECT_THAT(claims[0].ours, HasSubstr("limit 0.0157 rad"));
    EXPECT_THAT(claims[0].ours, HasSubstr("199 roots"));
    EXPECT_THAT(claims[1].ours, HasSubstr("2 roots, nearest at 3.1416 rad, limit 1.5708 rad"));
    EXPECT_THAT(claims[2].ours, HasSubstr("1 roots, nearest at 3.1416 rad, limit 1.5708 rad"));

    // Lengths: each error is that of a simulation of so many taps.
    EXPECT_EQ(claims[3].holds, Holds::with_reservation);
    const auto exact = response_of(without_delay());
    const std::vector<double> input(exact.size(), 1.0);
    for (const std::size_t taps : {100U, 200U, 300U, 600U, 1000U, 2000U}) {
        drive::Scheme scheme;
        scheme.taps = taps;
        const double plain = farthest(drive::simulate(without_delay(), scheme, input).output, exact);
        scheme.increments = true;
        const double increments = farthest(drive::simulate(without_delay(), scheme, input).output, exact);
        EXPECT_THAT(claims[3].ours, HasSubstr(fmt::format("{}: {:.1e} ({:.1e})", taps, plain, increments)));
    }

    // 1 - sqrt(ISE / h) / 5000 of the three ISE, and ISE / (1 - fit)^2: by hand.
    EXPECT_EQ(claims[4].holds, Holds::no);
    EXPECT_THAT(claims[4].ours, HasSubstr("gives 99.947 %, 99.965 %, 99.980 % for those ISE"));
    EXPECT_THAT(claims[4].ours, HasSubstr("h = 0.882, 0.884, 0.879 by the three rows"));
    const auto niopdt = response_of(models.niopdt);
    double mean = 0.0;
    double square = 0.0;
    for (const double y : niopdt) {
        mean += y / 5001.0;
        square += y * y;
    }
    EXPECT_THAT(claims[4].ours,
                HasSubstr(fmt::format("(12) itself has {:.2f} over 5 s", 0.001 * (square - 5001.0 * mean * mean))));

    // Of the printed roots of the ISE 0.08314, 0.05480, 0.03112 and IAE 0.12005, 0.07859, 0.04656: sums, differences.
    const std::vector<double> all[] = {response_of(models.fopdt), response_of(models.sopdt), niopdt};
    const char* const sides[2][3] = {{"in [0.0283, 0.1379]", "in [0.0520, 0.1143]", "in [0.0237, 0.0859]"},
                                     {"in [0.0415, 0.1986]", "in [0.0735, 0.1666]", "in [0.0320, 0.1251]"}};
    const char* const pairs[] = {"FOPDT-SOPDT", "FOPDT-NIOPDT", "SOPDT-NIOPDT"};
    const std::pair<int, int> which[] = {{0, 1}, {0, 2}, {1, 2}};
    for (int kind = 0; kind < 2; ++kind) {
        const drive::Claim& claim = claims[5 + kind];
        for (int i = 0; i < 3; ++i) {
            const auto apart = drive::compute_indices(times(), all[which[i].first], all[which[i].second]);
            EXPECT_THAT(claim.ours,
                        HasSubstr(fmt::format("{} {:.4f} {}", pairs[i], kind == 0 ? std::sqrt(apart.ise) : apart.iae,
                                              sides[kind][i])));
        }
        EXPECT_EQ(claim.holds, claim.ours.find(" NO") == std::string::npos ? Holds::yes : Holds::no) << claim.ours;
    }
    EXPECT_EQ(claims[7].holds, Holds::with_reservation);
    EXPECT_EQ(claims[8].holds, Holds::with_reservation);
    const double nearest = std::sqrt(drive::compute_indices(times(), all[2], all[1]).ise);
    EXPECT_THAT(claims[8].ours, HasSubstr(fmt::format("(12) and (11) are {:.4f} apart", nearest)));
    // 5000 samples of 4 bytes; a table for each order, or one.
    EXPECT_EQ(claims[9].holds, Holds::with_reservation);
    EXPECT_THAT(claims[9].ours, HasSubstr("20000 B of past and 20000 B for each order's table, 80000 B with the two of "
                                          "(12); one merged table: 40000 B. 600 terms: 4800 B"));
}

// A model that fits worse than the table says breaks the inequalities, and the claim with them.
TEST(Paper, ModelsThatAreTooFarApartDoNotFitTheTables) {
    drive::PaperModels others = models;
    others.sopdt.delay_s = 0.5;
    const auto claims = drive::check_paper(others);
    for (const int i : {5, 6}) {
        EXPECT_EQ(claims[i].holds, Holds::no) << claims[i].ours;
        EXPECT_THAT(claims[i].ours, HasSubstr(" NO"));
    }
    others.niopdt.denominator[1].coefficient = -0.1;
    EXPECT_EQ(drive::check_paper(others)[0].holds, Holds::no);
}

// The tables' digits are worth a thousandth: by so much may a distance exceed the sum of its sides.
TEST(Paper, ADistanceMayExceedItsSidesByAThousandth) {
    const std::vector<double> niopdt = response_of(models.niopdt);
    const std::vector<double> sopdt = response_of(models.sopdt);
    for (const bool squares : {true, false}) {
        const double sides = squares ? std::sqrt(3.0031e-3) + std::sqrt(9.6876e-4) : 7.8585e-2 + 4.6558e-2;
        for (const double exceeds : {1.0005, 1.0015}) {
            double low = 1.0;
            double high = 1.2;
            for (int i = 0; i < 40; ++i) {
                const double gain = 0.5 * (low + high);
                std::vector<double> scaled = sopdt;
                std::ranges::transform(scaled, scaled.begin(), [&](double y) { return gain * y; });
                const auto apart = drive::compute_indices(times(), niopdt, scaled);
                ((squares ? std::sqrt(apart.ise) : apart.iae) < exceeds * sides ? low : high) = gain;
            }
            drive::PaperModels others = models;
            others.sopdt.gain *= low;
            const std::string said = drive::check_paper(others)[squares ? 5 : 6].ours;
            const bool refused = std::regex_search(said, std::regex("SOPDT-NIOPDT [^;]* NO"));
            EXPECT_EQ(refused, exceeds > 1.001) << said;
        }
    }
}

// By as much it may stay below their difference: models that are multiples of one are as far apart as their gains.
TEST(Paper, ADistanceMayStayAThousandthBelowTheDifferenceOfItsSides) {
    const std::vector<double> base = response_of(models.sopdt);
    const auto size = drive::compute_indices(times(), base, std::vector<double>(base.size(), 0.0));
    for (const double part : {0.9985, 0.9995}) {
        drive::PaperModels others{models.sopdt, models.sopdt, models.sopdt};
        others.sopdt.gain += part * (std::sqrt(3.0031e-3) - std::sqrt(9.6876e-4)) / std::sqrt(size.ise);
        others.fopdt.gain += part * (1.2005e-1 - 4.6558e-2) / size.iae;
        const auto claims = drive::check_paper(others);
        const auto refused = [&](std::size_t claim, const char* pair) {
            return std::regex_search(claims[claim].ours, std::regex(std::string(pair) + " [^;]* NO"));
        };
        EXPECT_EQ(refused(5, "SOPDT-NIOPDT"), part < 0.999) << claims[5].ours;
        EXPECT_EQ(refused(6, "FOPDT-NIOPDT"), part < 0.999) << claims[6].ours;
    }
}

TEST(Paper, TheValueAfterFiveSecondsIsThePublishedOne) {
    const auto value = drive::value_at_5_s(models.niopdt);
    EXPECT_EQ(value.without_delay, "0.9977144659");
    EXPECT_NEAR(std::stod(value.with_delay), drive::StepResponse(models.niopdt)(5.0), 1e-9);
    EXPECT_EQ(value.with_delay.size(), value.without_delay.size());
    EXPECT_EQ(drive::value_at_5_s(models.niopdt, 4).without_delay, "0.9977");
}

// The table of docs/drive-models.md.
TEST(Paper, PrecisionsEndWhereThePageSays) {
    const std::pair<const char*, double> expected[] = {{"single precision, merged table, newest first", 1.147},
                                                       {"single precision, a sum for each order, newest first", 1.292},
                                                       {"single precision, oldest first", 0.9975},
                                                       {"double, 600 terms", 0.987},
                                                       {"single precision in increments, 600 terms", 0.9977},
                                                       {"single precision in increments", 0.9977},
                                                       {"double", 0.998},
                                                       {"exact", 0.9977}};
    const auto found = drive::compare_precisions(models.niopdt);
    ASSERT_EQ(found.size(), std::size(expected));
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].how, expected[i].first);
        const double digits = expected[i].second * 1000.0 == std::round(expected[i].second * 1000.0) ? 5.1e-4 : 1.1e-4;
        EXPECT_NEAR(found[i].after_5_s, expected[i].second, i == 4 ? 7e-3 : digits) << found[i].how;
    }
    // 600 terms are 600.
    const auto exact = response_of(without_delay());
    const auto error_of_600 = [&](bool increments, const std::string& kernel) {
        const drive::Scheme scheme{.taps = 600, .increments = increments, .kernel = kernel};
        return farthest(drive::simulate(without_delay(), scheme, std::vector<double>(exact.size(), 1.0)).output, exact);
    };
    EXPECT_NEAR(found[3].largest_error, error_of_600(false, ""), 1e-12);
    EXPECT_NEAR(found[4].largest_error, error_of_600(true, "ring_oldest_f32"), 1e-12);
    EXPECT_NEAR(found[4].largest_error, 6.8e-3, 1e-4);
    EXPECT_NEAR(found[5].largest_error, 5.4e-4, 1e-5);
    EXPECT_NEAR(found[6].largest_error, 5.4e-4, 1e-5);
    EXPECT_EQ(found[7].largest_error, 0.0);
    EXPECT_NEAR(found[7].after_5_s, 0.9977144659, 1e-9);
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

TEST(Paper, PicturesShowTheThreeModelsAndEveryPrecision) {
    const auto steps = drive::picture_of_step_responses(models).script;
    EXPECT_EQ(count_of(steps, "<< EOD"), 3U);
    for (const char* model : {"(10) ", "(11) ", "(12) "}) {
        EXPECT_THAT(steps, HasSubstr(std::string("title \"") + model));
    }
    EXPECT_THAT(steps, HasSubstr(fmt::format("\n5 {:.7g}\n", drive::StepResponse(models.sopdt)(5.0))));
    const auto precisions = drive::picture_of_precisions(models.niopdt).script;
    EXPECT_EQ(count_of(precisions, "<< EOD"), 7U);
    EXPECT_EQ(count_of(precisions, "set logscale y"), 1U) << "most lie within a line's width of the exact response";
    for (const auto& precision : drive::compare_precisions(models.niopdt)) {
        const std::string title = "title \"" + precision.how + "\"";
        EXPECT_EQ(count_of(precisions, title), precision.how == "exact" ? 0U : 1U) << title;
    }
}

TEST(Pictures, CurvesHoldTheirPoints) {
    const std::vector<drive::Curve> curves = {{"log", {0.0, 0.5, 1.0}, {1.0, std::nan(""), 3.0}, true},
                                              {"model", {0.0, 1.0}, {0.25, 0.75}},
                                              {"best", {0.0, 1.0}, {0.125, 0.5}}};
    const auto script = drive::picture_of_curves(curves, "a title", "rad").script;
    EXPECT_THAT(script, HasSubstr("$d0 << EOD\n0 1\n1 3\nEOD\n$d1 << EOD\n0 0.25\n1 0.75\nEOD\n$d2"));
    EXPECT_THAT(script, HasSubstr("set title \"a title\" noenhanced"));
    EXPECT_THAT(script, HasSubstr("set ylabel \"rad\""));
    // Samples are grey points, the last curve is solid, and no two lines before it look alike.
    EXPECT_THAT(script, HasSubstr("$d0 using 1:2 with points pt 7 ps 0.5 lc rgb \"#AAAAAA\" title \"log\""));
    std::smatch dash;
    EXPECT_TRUE(std::regex_search(
        script, dash, std::regex("\\$d1 using 1:2 with lines lw 2 dt ([2-9]) lc rgb \"([^\"]*)\" title \"model\"")));
    std::smatch solid;
    EXPECT_TRUE(std::regex_search(
        script, solid, std::regex("\\$d2 using 1:2 with lines lw 2 dt 1 lc rgb \"([^\"]*)\" title \"best\"")));
    EXPECT_NE(dash[2], solid[1]);
    // Long titles stand below one another, with room for each.
    EXPECT_THAT(script, HasSubstr("maxcols 3 width 2\nset bmargin 5\n"));
    const std::string wide(70, 'x');
    const auto tall =
        drive::picture_of_curves({{wide, {0.0, 1.0}, {1.0, 2.0}}, {wide, {0.0, 1.0}, {2.0, 1.0}}}, "t", "u");
    EXPECT_THAT(tall.script, HasSubstr("maxcols 1 width 2\nset bmargin 6\n"));
    EXPECT_EQ(tall.height, 500U);
    // Of a long record at most some thousand points.
    drive::Curve longer{"long", {}, {}};
    for (int k = 0; k < 20000; ++k) {
        longer.time_s.push_back(k);
        longer.value.push_back(k);
    }
    const auto thinned = drive::picture_of_curves({longer}, "t", "u").script;
    EXPECT_LT(count_of(thinned, "\n"), 5100U);
    EXPECT_GT(count_of(thinned, "\n"), 2500U);
}

TEST(Pictures, TheTitleOfRootsSaysHowFarTheyKeep) {
    drive::StabilityVerdict judged;
    judged.base_order = 0.01;
    judged.limit_rad = 0.0157;
    judged.verdict = drive::Stability::stable;
    EXPECT_THAT(drive::picture_of_roots(judged, "m").script, HasSubstr("title \"Stable: there is no root\\nm\""));
    judged.roots = {{0.5, 0.005}, {0.5, -0.005}, {-2.0, 0.0}};
    judged.smallest_angle_rad = judged.limit_rad;
    judged.verdict = drive::Stability::borderline;
    EXPECT_THAT(drive::picture_of_roots(judged, "m").script,
                HasSubstr("\"Borderline: the nearest root (of 3) lies on the edge of the unstable sector\\nm\""));
    judged.smallest_angle_rad = 0.5 * judged.limit_rad;
    judged.unstable_by_roots = 2;
    judged.verdict = drive::Stability::unstable;
    EXPECT_THAT(drive::picture_of_roots(judged, "m").script,
                HasSubstr("\"Unstable: roots in the unstable sector, 2 of 3, the farthest in at 0.5 of its angle"));
}

TEST(Pictures, TheTitleOfAFitSaysWhatItReached) {
    drive::Record record;
    record.time_s = {0.0, 1.0, 2.0, 3.0};
    record.output = {0.0, 0.0, 1.0, 1.0};
    // Of sum (y - 0.5)^2 = 1 the fit leaves 4 * 0.01, the start 4 * 0.04.
    const auto script =
        drive::picture_of_fit(record, {0.2, 0.2, 0.8, 0.8}, {0.1, 0.1, 0.9, 0.9}, drive::make_fopdt(1.0, 2.0, 0.0))
            .script;
    EXPECT_THAT(script, HasSubstr("set title \"The fit explains 96 % of the variance: a residual of 0.1 rms, the "
                                  "start's is 0.2\\n1 / (2 s + 1)\" noenhanced"));
    EXPECT_THAT(script, HasSubstr("title \"measured\""));
    EXPECT_THAT(script, HasSubstr("\n1 0.1\n2 0.9\n"));
}

TEST(Pictures, RootsLieBesideTheSectorOfTheLimit) {
    for (const double limit : {0.0157, 1.5708}) {
        drive::StabilityVerdict judged;
        judged.base_order = limit / 1.5708;
        judged.limit_rad = limit;
        judged.roots = {{0.5, 0.125}, {0.5, -0.125}, {-2.0, 0.0}};
        judged.verdict = drive::Stability::stable;
        judged.smallest_angle_rad = 1.25 * limit;
        const auto script = drive::picture_of_roots(judged, "a model").script;
        EXPECT_THAT(script, HasSubstr("$roots << EOD\n0.5 0.125\n0.5 -0.125\n-2 0\nEOD\n"));
        EXPECT_THAT(script, HasSubstr("roots of P(s^q), q = "));
        EXPECT_THAT(script,
                    HasSubstr("title \"Stable: no root (of 3) comes nearer than 1.25 times the angle of the unstable "
                              "sector\\na model\""));
        // Every corner of the shaded sector lies on its edges or at the picture's side, above as below.
        static const std::regex polygon(
            "xrange \\[([^:]*):([^\\]]*)\\]\nset yrange \\[([^:]*):([^\\]]*)\\]\nset object 1 polygon "
            "from 0,0 to ([^,]*),([^ ]*) to ([^,]*),([^ ]*) to ([^,]*),([^ ]*) to ([^,]*),([^ ]*) to 0,0");
        std::size_t panels = 0;
        for (std::sregex_iterator at(script.begin(), script.end(), polygon); at != std::sregex_iterator(); ++at) {
            ++panels;
            std::vector<double> n;
            for (std::size_t i = 1; i < at->size(); ++i) {
                n.push_back(std::stod((*at)[i]));
            }
            const double slope = std::tan(std::min(limit, 1.5706));
            EXPECT_EQ(n[2], -n[3]);
            EXPECT_LE(n[4], n[1] * (1 + 1e-6));
            EXPECT_NEAR(n[5], std::min(n[3], n[1] * slope), 1e-4 * n[3]);
            EXPECT_NEAR(n[4] * slope, n[5], 1e-4 * n[3]);
            EXPECT_NEAR(n[6], n[1], 1e-4);
            EXPECT_NEAR(n[7], n[5], 1e-4);
            EXPECT_NEAR(n[8], n[6], 1e-9);
            EXPECT_NEAR(n[9], -n[7], 1e-9);
            EXPECT_NEAR(n[10], n[4], 1e-9);
            EXPECT_NEAR(n[11], -n[5], 1e-9);
            // All roots are in the first panel, the one nearest to the axis in the second.
            EXPECT_GT(n[1], panels == 1 ? 2.0 : 0.5154);
            EXPECT_LT(n[0], panels == 1 ? -2.0 : 0.0);
            EXPECT_GT(n[3], 0.125);
        }
        EXPECT_EQ(panels, limit > 0.5 ? 1U : 2U);
    }
}

TEST(Pictures, AModelsTitleHasFourDigits) {
    drive::Model model = plants::niopdt();
    model.delay_s = 1.23456789;
    EXPECT_THAT(drive::short_text(model), HasSubstr("1.235"));
    EXPECT_THAT(drive::short_text(model), HasSubstr("0.1823"));
    EXPECT_THAT(drive::short_text(model), HasSubstr("0.9832"));
    EXPECT_THAT(drive::short_text(model), Not(HasSubstr("0.98319")));
    model.numerator = {{1.23456, 0.0}};
    EXPECT_THAT(drive::short_text(model), HasSubstr("1.235"));
    drive::Model gain = drive::make_fopdt(2.3456789, 0.5, 0.0);
    EXPECT_THAT(drive::short_text(gain), HasSubstr("2.346"));
    EXPECT_THAT(drive::short_text(gain), Not(HasSubstr("2.3456")));
}

// The second panel is 1.3 times as wide as the root nearest to the axis by its angle, and as high as 1.6 times that
// root, or as three times the sector is wide there.
TEST(Pictures, TheSecondPanelHoldsTheNearestRootAndTheSector) {
    const auto second = [](double limit_rad, const std::vector<std::complex<double>>& roots) {
        drive::StabilityVerdict judged;
        judged.base_order = 0.01;
        judged.limit_rad = limit_rad;
        judged.roots = roots;
        judged.verdict = drive::Stability::stable;
        judged.smallest_angle_rad = 1.0;
        const auto script = drive::picture_of_roots(judged, "m").script;
        static const std::regex ranges("xrange \\[([^:]*):([^\\]]*)\\]\nset yrange \\[([^:]*):([^\\]]*)\\]");
        std::sregex_iterator at(script.begin(), script.end(), ranges);
        ++at;
        std::vector<double> found;
        for (std::size_t i = 1; i < at->size(); ++i) {
            found.push_back(std::stod((*at)[i]));
        }
        return found;
    };
    const auto expect = [](const std::vector<double>& found, double right, double height) {
        ASSERT_EQ(found.size(), 4U);
        EXPECT_NEAR(found[0], -0.05 * right, 1e-4);
        EXPECT_NEAR(found[1], right, 1e-4);
        EXPECT_NEAR(found[2], -height, 1e-4);
        EXPECT_NEAR(found[3], height, 1e-4);
    };
    // The nearest by its angle is not the first, nor the smallest, nor the last.
    const std::vector<std::complex<double>> roots = {std::polar(5.0, 1.0), std::polar(2.0, -0.4), std::polar(1.0, 2.0)};
    expect(second(0.1, roots), 2.6, 1.6 * 2.0 * std::sin(0.4));
    expect(second(0.2, roots), 2.6, 3.0 * 2.6 * std::sin(0.2));
    // What lies to the left is shown as high as at 1.5 rad.
    expect(second(0.1, {std::polar(2.0, 2.5)}), 2.6, 1.6 * 2.0 * std::sin(1.5));
}

// Three of up to 28 letters side by side, or two of up to 47: 850 in all, 7.5 a letter and 70 for the line.
TEST(Pictures, TitlesHaveRoomForTheirLetters) {
    const auto curve = [](std::size_t letters) {
        return drive::Curve{std::string(letters, 'x'), {0.0, 1.0}, {1.0, 2.0}};
    };
    const auto script = [&](std::size_t letters) {
        return drive::picture_of_curves({curve(3), curve(letters), curve(5)}, "t", "u").script;
    };
    EXPECT_THAT(script(28), HasSubstr("maxcols 3 width 2\nset bmargin 5\n"));
    EXPECT_THAT(script(29), HasSubstr("maxcols 2 width 2\nset bmargin 6\n"));
    EXPECT_THAT(script(47), HasSubstr("maxcols 2 width 2\nset bmargin 6\n"));
    EXPECT_THAT(script(48), HasSubstr("maxcols 1 width 2\nset bmargin 7\n"));
}

}  // namespace
