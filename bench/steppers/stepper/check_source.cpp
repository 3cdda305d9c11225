#include "bench/steppers/stepper/check_source.hpp"

#include <fmt/format.h>

#include "bench/texts/text.hpp"

namespace generate {
namespace {

template <class Number>
std::string list_of(const std::vector<Number>& numbers, const char* form) {
    std::string text;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        text += fmt::format(fmt::runtime(form), numbers[k]) + (k % 8 == 7 ? ",\n" : ", ");
    }
    return text;
}

std::string input_name(const WrittenStepper& stepper, std::size_t argument) {
    return fmt::format("input{}_{}", argument, stepper.prefix);
}

// The arguments of a call: their sample of number `index`, a C expression; or their declarations or names.
std::string arguments(const WrittenStepper& stepper, const std::string& index) {
    std::string text;
    for (std::size_t argument = 0; argument < stepper.inputs.size(); ++argument) {
        text += fmt::format(", {}[{}]", input_name(stepper, argument), index);
    }
    return text;
}
std::string parameters(const WrittenStepper& stepper, const char* before) {
    std::string text;
    for (std::size_t argument = 0; argument < stepper.inputs.size(); ++argument) {
        text += fmt::format(", {}x{}", before, argument);
    }
    return text;
}

// In C. A sum of one coefficient has no table.
std::string table_bytes(const WrittenStepper& stepper) {
    std::string sum = "0U";
    for (const std::string& table : stepper.tables) {
        sum += fmt::format(" + sizeof {}_{}_f32_table", stepper.prefix, table);
    }
    return sum;
}

}  // namespace

std::string check_source(const std::vector<WrittenStepper>& steppers) {
    std::string text = "#include <stdint.h>\n";
    std::string entries;
    for (const WrittenStepper& stepper : steppers) {
        for (std::size_t argument = 0; argument < stepper.inputs.size(); ++argument) {
            text += fmt::format("static const float {}[{}] = {{\n{}}};\n", input_name(stepper, argument),
                                stepper.inputs[argument].size(), list_of(stepper.inputs[argument], "{:a}F"));
        }
        text += fmt::format(R"(#include "{0}.h"
static {0}_f32_instance line_{0};
static const uint32_t expected_{0}[{2}] = {{
{1}}};
static uint32_t check_{0}(void)
{{
    uint32_t k;
    {0}_init_f32(&line_{0});
    for (k = 0U; k < {2}U; ++k) {{
        const float output = {0}_step_f32(&line_{0}{3});
        uint32_t bits;
        memcpy(&bits, &output, sizeof bits);
        if (bits != expected_{0}[k]) {{
            return k + 1U;
        }}
    }}
    return {0}_self_check_f32(&line_{0}) == 0U ? 0U : UINT32_MAX;
}}
)",
                            stepper.prefix, list_of(stepper.expected, "0x{:08X}U"), stepper.expected.size(),
                            arguments(stepper, "k"));
        entries += fmt::format("    check_{},\n", stepper.prefix);
    }
    return text + "static uint32_t (*const entries[])(void) = {\n" + entries + "};\n";
}

std::string target_source(const std::vector<WrittenStepper>& steppers) {
    std::string text;
    std::string calls;
    std::string entries;
    std::string sizes;
    for (const WrittenStepper& stepper : steppers) {
        for (const std::string& table : stepper.tables) {
            text += fmt::format(
                "#define {}_{}_F32_TABLE_ATTRIBUTES __attribute__((section(\".data.tables\"), aligned(8)))\n",
                upper(stepper.prefix), upper(table));
        }
        calls += fmt::format(R"(float count_{0}({0}_f32_instance *S{1});
__attribute__((noipa, flatten)) float count_{0}({0}_f32_instance *S{1})
{{
    return {0}_step_f32(S{2});
}}
static void call_{0}(unsigned k)
{{
    (void)count_{0}(&line_{0}{3});
    __asm__ volatile(""); /* or the call would become a jump, which is no call to the plugin */
}}
)",
                             stepper.prefix, parameters(stepper, "float "), parameters(stepper, ""),
                             arguments(stepper, fmt::format("k % {}U", stepper.expected.size())));
        entries += fmt::format("    call_{},\n", stepper.prefix);
        sizes += fmt::format("    {{sizeof line_{}, {}}},\n", stepper.prefix, table_bytes(stepper));
    }
    return text + check_source(steppers) + calls + "static void (*const calls[])(unsigned) = {\n" + entries +
           "};\nstatic const uint32_t sizes[][2] = {\n" + sizes +
           fmt::format(R"(}};
void glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned call));
extern const unsigned glsum_verified_count;
unsigned glsum_verify(unsigned number);
const unsigned glsum_verified_count = {0}U * (sizeof entries / sizeof entries[0]);
unsigned glsum_verify(unsigned number)
{{
    const unsigned stepper = number / {0}U;
    uint32_t wrong;
    if (number % {0}U != 0U) {{
        return (unsigned)sizes[stepper][number % {0}U - 1U];
    }}
    wrong = entries[stepper]();
    glsum_make_calls({1}U, 0U, calls[stepper]);
    return (unsigned)wrong;
}}
)",
                       answers_a_stepper, stepper_calls.taps);
}

}  // namespace generate
