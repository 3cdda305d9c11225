// The simulation that ran did so in fractions of 31 or 15 bits, on values or on increments.
#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/effect.hpp"

namespace gap {

const Effect& fixed_point();

namespace {

constexpr const char* kernels[] = {"ring_plain_q31", "ring_plain_q15"};

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.deployed_step_s > 0.0)) {
        return {};
    }
    return {{"format", "bits", 15.0, 31.0, 31.0, {31.0, 15.0, 31.0, 15.0}, true},
            {"increments", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0}, true},
            {"step_s", "s", 0.0, 1e6, 0.0, {scales.deployed_step_s}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.deployed = Deployed{values[2], 0.0, kernels[values[0] > 20.0 ? 0 : 1], values[1] > 0.5};
}

// The format as the word that kernels have for it.
std::vector<Written> to_contract(const Effect& effect, std::span<const Fitted> fitted) {
    std::vector<Written> written = numbers_to_contract(effect, fitted);
    written[0] = {"format", std::string(fitted[0].value > 20.0 ? "q31" : "q15")};
    return written;
}

std::vector<double> from_contract(const Effect& effect, const Contracted& contracted) {
    const auto found = contracted.find("format");
    const auto* format = found == contracted.end() ? nullptr : std::get_if<std::string>(&found->second);
    if (format == nullptr || (*format != "q31" && *format != "q15")) {
        throw glsum::Failure(glsum::Exit::bad_input, "fixed_point: expected format q31 or q15");
    }
    Contracted numbers = contracted;
    numbers["format"] = *format == "q31" ? 31.0 : 15.0;
    return numbers_from_contract(effect, numbers);
}

}  // namespace

const Effect& fixed_point() {
    static const Effect effect{
        .name = "fixed_point",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::deployed,
        .numbers = {{"format"},
                    {"increments", Number::Given::otherwise, 0.0},
                    {"step_s", Number::Given::otherwise, 0.0}},
        .of_fitted_base = true,
        .to_contract = to_contract,
        .from_contract = from_contract,
    };
    return effect;
}

}  // namespace gap
