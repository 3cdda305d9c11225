#include "bench/generate/literals.hpp"

#include <fmt/format.h>

namespace generate {
namespace {

template <class Real>
std::string real(Real value) {
    const std::string text = fmt::format("{}", value);
    return text + (text.find_first_of(".e") == std::string::npos ? ".0" : "");
}

}  // namespace

std::string literal(double value) { return real(value); }
std::string literal(float value) { return real(value) + "F"; }
std::string literal(std::int32_t value) { return value == INT32_MIN ? "INT32_MIN" : std::to_string(value); }
std::string literal(std::uint32_t bits) { return fmt::format("0x{:08X}U", bits); }
std::string literal(std::uint64_t bits) { return fmt::format("UINT64_C(0x{:016X})", bits); }

std::string array(const std::string& type, const std::string& name, std::span<const std::string> literals) {
    std::string text = "static const " + type + " " + name + "[" + std::to_string(literals.size()) + "] = {\n";
    std::string line;
    for (const std::string& literal : literals) {
        if (line.size() + literal.size() + 6 > 118) {
            text += "   " + line + "\n";
            line.clear();
        }
        line += " " + literal + ",";
    }
    return text + "   " + line + "\n};";
}

}  // namespace generate
