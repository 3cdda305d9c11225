// What cannot be fitted is refused before it is begun, with what was expected and what was found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "drive/fit.hpp"
#include "drive/response.hpp"

namespace {

using testing::HasSubstr;

drive::Record step_of(std::size_t samples) {
    drive::Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (std::size_t k = 0; k < samples; ++k) {
        record.time_s.push_back(0.3 * static_cast<double>(k));
    }
    record.output = drive::respond(drive::make_fopdt(2.0, 0.8, 0.0), record.changes, record.time_s);
    return record;
}

drive::Form gain_and_time() {
    drive::Form form(drive::Kind::fopdt, drive::make_fopdt(1.5, 1.0, 0.0));
    form.parameter("delay_s").fixed = true;
    return form;
}

std::string refusal_of(const drive::Form& form, const std::vector<drive::Record>& records) {
    try {
        (void)drive::fit(form, records, {});
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "";
}

// One sample more than parameters leaves nothing to tell the noise from; one more than that does. Records count
// together.
TEST(FitRefusals, AsManySamplesAsParametersAndOneMoreAreTooFew) {
    const drive::Form form = gain_and_time();
    EXPECT_THAT(refusal_of(form, {step_of(2)}), HasSubstr("more samples than 2 free parameters, found 2"));
    EXPECT_THAT(refusal_of(form, {step_of(3)}), HasSubstr("more samples than 2 free parameters, found 3"));
    EXPECT_EQ(refusal_of(form, {step_of(4)}), "");
    EXPECT_EQ(refusal_of(form, {step_of(2), step_of(2)}), "");
    EXPECT_NEAR(drive::fit(form, {step_of(4)}, {}).model.gain, 2.0, 1e-5);
}

TEST(FitRefusals, SomethingIsFreeAndBeginsWithinItsBounds) {
    drive::Form form = gain_and_time();
    drive::Parameter& gain = form.parameter("gain");
    gain.lower = 1.0;
    gain.upper = 3.0;
    for (const double value : {1.0, 1.5, 3.0}) {
        gain.value = value;
        EXPECT_EQ(refusal_of(form, {step_of(20)}), "") << value;
    }
    gain.value = 0.9;
    EXPECT_THAT(refusal_of(form, {step_of(20)}),
                HasSubstr("gain: expected a start within its bounds 1 and 3, found 0.9"));
    gain.value = 3.1;
    EXPECT_THAT(refusal_of(form, {step_of(20)}),
                HasSubstr("gain: expected a start within its bounds 1 and 3, found 3.1"));
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = true;
    }
    EXPECT_THAT(refusal_of(form, {step_of(20)}), HasSubstr("at least one free parameter"));
}

}  // namespace
