// A verdict's page: which of its lines stand for what.
#include "gap/verdict/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace {

using testing::AllOf;
using testing::HasSubstr;

gap::Verdict verdict() {
    return {gap::Outcome::unknown, {"simulation", 0.5, 0.1, 0.05}, {{"none", 0.5, 0.0}}, gap::OfDrive{}, "rest", {}};
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

// What a simulation leaves is taken off from its first sample on, of what was chosen as of the base.
TEST(VerdictPage, DrawsWhatTheChosenLeaves) {
    gap::OfDrive of{};
    of.chosen = "backlash";
    const gap::Curve curve{"ramp.csv", {0.0, 1.0, 2.0}, {0.0, 0.5, 1.0}, {-1.0, 0.0, 1.0}, {0.5, 0.0, -0.5}};
    const std::string page = gap::to_html(verdict(), of, {{curve}});
    // From -0.5 to 1.5 on 288 px: 1 to 0 by the base, -0.5 to 1.5 by the chosen; of what they leave -1 to 1 on 128 px.
    EXPECT_THAT(page, AllOf(HasSubstr("<polyline class=\"base\" points=\"64.0,80.0 577.0,152.0 1090.0,224.0 \"/>"),
                            HasSubstr("<polyline class=\"after\" points=\"64.0,296.0 577.0,152.0 1090.0,8.0 \"/>"),
                            HasSubstr("<polyline class=\"base\" points=\"64.0,136.0 577.0,72.0 1090.0,8.0 \"/>"),
                            HasSubstr("<polyline class=\"after\" points=\"64.0,40.0 577.0,72.0 1090.0,104.0 \"/>")));
}

// The first two simulations of the next record in the colours of what helps and of the base, which is dashed; further
// ones dim.
TEST(VerdictPage, KeysTheNextRecordsLines) {
    gap::OfDrive of{};
    of.chosen = "none";
    const gap::NextRecord next{
        "step", {0.0, 1.0}, {0.0, 1.0}, {{"a", {0.0, 1.0}}, {"b", {0.0, 1.0}}, {"c", {0.0, 1.0}}, {"d", {0.0, 1.0}}}};
    const std::string page = gap::to_html(verdict(), of, {{}, next});
    EXPECT_THAT(
        page,
        AllOf(HasSubstr("<p class=\"key\"><span style=\"color:var(--measured)\"><i></i>measured</span>"
                        "<span style=\"color:var(--base)\"><i style=\"border-top-style:dashed\"></i>base</span></p>"),
              HasSubstr("<p class=\"key\"><span style=\"color:var(--after)\"><i></i>a</span>"
                        "<span style=\"color:var(--base)\"><i style=\"border-top-style:dashed\"></i>b</span>"
                        "<span style=\"color:var(--dim)\"><i></i>c</span>"
                        "<span style=\"color:var(--dim)\"><i></i>d</span></p>")));
    EXPECT_EQ(count_of(page, "<polyline class=\"after\""), 2U);  // on a screen and on a phone
    EXPECT_EQ(count_of(page, "<polyline class=\"base\""), 2U);
    EXPECT_EQ(count_of(page, "<polyline class=\"other\""), 4U);
}

}  // namespace
