#include "bench/generate/controller/check_source.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>

#include "bench/generate/text.hpp"

namespace generate {
namespace {

std::string list_of(const std::vector<float>& numbers) {
    std::string text;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        text += fmt::format("{:a}F,{}", numbers[k], k % 8 == 7 ? "\n" : " ");
    }
    return text;
}

// The library's outputs, as bits.
std::string expected_of(const ControllerSpec& spec, const CheckRecord& record) {
    SteppedController stepped(spec);
    std::string text;
    for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
        const float output = stepped.step(record.setpoint[k], record.measured[k]);
        text += fmt::format("0x{:08X}U,{}", std::bit_cast<std::uint32_t>(output), k % 8 == 7 ? "\n" : " ");
    }
    return text;
}

// In C. A sum of one coefficient has no table.
std::string table_bytes(const WrittenController& controller) {
    std::string sum = "0U";
    if (integral_sum(controller.spec).taps > 1) {
        sum += fmt::format(" + sizeof {}_integral_f32_table", controller.prefix);
    }
    if (controller.spec.controller.gains.kd != 0.0 && derivative_sum(controller.spec).taps > 1) {
        sum += fmt::format(" + sizeof {}_derivative_f32_table", controller.prefix);
    }
    return sum;
}

}  // namespace

CheckRecord check_record() {
    constexpr std::size_t count = 4000;
    constexpr float levels[] = {1.0F, 0.4F, -0.7F, 0.1F, 0.9F};
    std::mt19937 chance(1);
    CheckRecord record;
    float reading = 0.0F;
    for (std::size_t k = 0; k < count; ++k) {
        const float setpoint = levels[k / 230 % std::size(levels)];
        const float noise = std::ldexp(static_cast<float>(chance() >> 8U), -23) - 1.0F;
        const float size = k < count / 4 * 3 ? 1.0F : 100.0F;
        record.setpoint.push_back(size * setpoint);
        record.measured.push_back(size * (reading + 0.01F * noise));
        reading += 0.01F * (setpoint - reading);
    }
    return record;
}

std::string check_source(const std::vector<WrittenController>& controllers) {
    const CheckRecord record = check_record();
    std::string text = fmt::format(
        "#include <stdint.h>\nenum {{ samples = {} }};\nstatic const float setpoints[samples] = {{\n{}}};\n"
        "static const float readings[samples] = {{\n{}}};\n",
        record.setpoint.size(), list_of(record.setpoint), list_of(record.measured));
    std::string entries;
    for (const WrittenController& controller : controllers) {
        text += fmt::format(R"(#include "{0}.h"
static {0}_f32_instance line_{0};
static const uint32_t expected_{0}[samples] = {{
{1}}};
static uint32_t check_{0}(void)
{{
    uint32_t k;
    {0}_init_f32(&line_{0});
    for (k = 0U; k < samples; ++k) {{
        const float output = {0}_step_f32(&line_{0}, setpoints[k], readings[k]);
        uint32_t bits;
        memcpy(&bits, &output, sizeof bits);
        if (bits != expected_{0}[k]) {{
            return k + 1U;
        }}
    }}
    return {0}_self_check_f32(&line_{0}) == 0U ? 0U : UINT32_MAX;
}}
)",
                            controller.prefix, expected_of(controller.spec, record));
        entries += fmt::format("    check_{},\n", controller.prefix);
    }
    return text + "static uint32_t (*const entries[])(void) = {\n" + entries + "};\n";
}

std::string target_source(const std::vector<WrittenController>& controllers) {
    std::string text;
    std::string calls;
    std::string entries;
    std::string sizes;
    for (const WrittenController& controller : controllers) {
        for (const char* sum : {"INTEGRAL", "DERIVATIVE"}) {
            text += fmt::format(
                "#define {}_{}_F32_TABLE_ATTRIBUTES __attribute__((section(\".data.tables\"), aligned(8)))\n",
                upper(controller.prefix), sum);
        }
        calls += fmt::format(R"(float count_{0}({0}_f32_instance *S, float setpoint, float measured);
__attribute__((noipa, flatten)) float count_{0}({0}_f32_instance *S, float setpoint, float measured)
{{
    return {0}_step_f32(S, setpoint, measured);
}}
static void call_{0}(unsigned k)
{{
    (void)count_{0}(&line_{0}, setpoints[k % samples], readings[k % samples]);
    __asm__ volatile(""); /* or the call would become a jump, which is no call to the plugin */
}}
)",
                             controller.prefix);
        entries += fmt::format("    call_{},\n", controller.prefix);
        sizes += fmt::format("    {{sizeof line_{}, {}}},\n", controller.prefix, table_bytes(controller));
    }
    return text + check_source(controllers) + calls + "static void (*const calls[])(unsigned) = {\n" + entries +
           "};\nstatic const uint32_t sizes[][2] = {\n" + sizes +
           fmt::format(R"(}};
void glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned call));
extern const unsigned glsum_verified_count;
unsigned glsum_verify(unsigned number);
const unsigned glsum_verified_count = {0}U * (sizeof entries / sizeof entries[0]);
unsigned glsum_verify(unsigned number)
{{
    const unsigned controller = number / {0}U;
    uint32_t wrong;
    if (number % {0}U != 0U) {{
        return (unsigned)sizes[controller][number % {0}U - 1U];
    }}
    wrong = entries[controller]();
    glsum_make_calls({1}U, 0U, calls[controller]);
    return (unsigned)wrong;
}}
)",
                       answers_a_controller, controller_calls.taps);
}

}  // namespace generate
