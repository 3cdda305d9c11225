#include "bench/steppers/stepper/check_source.hpp"

#include <fmt/format.h>

#include <bit>

#include "bench/generate/literals.hpp"
#include "bench/texts/text.hpp"

namespace generate {
namespace {

template <class ToText>
std::string list_of(const std::vector<std::uint32_t>& numbers, ToText&& to_text) {
    std::string text;
    for (const std::uint32_t number : numbers) {
        text += to_text(number) + ",\n";
    }
    return text;
}

const char* number_of(const WrittenStepper& stepper) { return stepper.format == "q31" ? "int32_t" : "float"; }

std::string inputs_of(const WrittenStepper& stepper, std::size_t argument) {
    return list_of(stepper.inputs[argument], [&](std::uint32_t bits) {
        return stepper.format == "q31" ? literal(std::bit_cast<std::int32_t>(bits))
                                       : fmt::format("{:a}F", std::bit_cast<float>(bits));
    });
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
std::string parameters(const WrittenStepper& stepper, const std::string& before) {
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
        sum += fmt::format(" + sizeof {}_{}_{}_table", stepper.prefix, table, stepper.format);
    }
    return sum;
}

}  // namespace

std::string check_source(const std::vector<WrittenStepper>& steppers) {
    std::string text = "#include <stdint.h>\n";
    std::string entries;
    for (const WrittenStepper& stepper : steppers) {
        for (std::size_t argument = 0; argument < stepper.inputs.size(); ++argument) {
            text +=
                fmt::format("static const {} {}[{}] = {{\n{}}};\n", number_of(stepper), input_name(stepper, argument),
                            stepper.inputs[argument].size(), inputs_of(stepper, argument));
        }
        text += fmt::format(R"(#include "{0}.h"
static {0}_{4}_instance line_{0};
static const uint32_t expected_{0}[{2}] = {{
{1}}};
static uint32_t check_{0}(void)
{{
    uint32_t k;
    {0}_init_{4}(&line_{0});
    for (k = 0U; k < {2}U; ++k) {{
        const {5} output = {0}_step_{4}(&line_{0}{3});
        uint32_t bits;
        memcpy(&bits, &output, sizeof bits);
        if (bits != expected_{0}[k]) {{
            return k + 1U;
        }}
    }}
    return {0}_self_check_{4}(&line_{0}) == 0U ? 0U : UINT32_MAX;
}}
)",
                            stepper.prefix, list_of(stepper.expected, [](std::uint32_t bits) { return literal(bits); }),
                            stepper.expected.size(), arguments(stepper, "k"), stepper.format, number_of(stepper));
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
            text += fmt::format("#define {}_TABLE_ATTRIBUTES __attribute__((section(\".data.tables\"), aligned(8)))\n",
                                upper(fmt::format("{}_{}_{}", stepper.prefix, table, stepper.format)));
        }
        calls += fmt::format(
            R"({4} count_{0}({0}_{5}_instance *S{1});
__attribute__((noipa, flatten)) {4} count_{0}({0}_{5}_instance *S{1})
{{
    return {0}_step_{5}(S{2});
}}
static void call_{0}(unsigned k)
{{
    (void)count_{0}(&line_{0}{3});
    __asm__ volatile(""); /* or the call would become a jump, which is no call to the plugin */
}}
)",
            stepper.prefix, parameters(stepper, std::string(number_of(stepper)) + " "), parameters(stepper, ""),
            arguments(stepper, fmt::format("k % {}U", stepper.expected.size())), number_of(stepper), stepper.format);
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
