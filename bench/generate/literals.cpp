#include "bench/generate/literals.hpp"

#include <fmt/format.h>

namespace generate {

std::string real_literal(const std::string& type, double value) {
    std::string text = type == "float" ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
    text += text.find_first_of(".e") == std::string::npos ? ".0" : "";
    return text + (type == "float" ? "F" : "");
}

std::string bits_literal(std::uint64_t bits, bool wide) {
    return wide ? fmt::format("UINT64_C(0x{:016X})", bits) : fmt::format("0x{:08X}U", bits);
}

std::string array(const std::string& type, const std::string& name, const std::vector<std::string>& literals) {
    std::string text = "static const " + type + " " + name + "[" + std::to_string(literals.size()) + "] = {\n";
    std::string line;
    for (const std::string& literal : literals) {
        if (line.size() + literal.size() + 6 > 118) {
            text += "   " + line + "\n";
            line.clear();
        }
        line += " " + literal + ",";
    }
    return text + "   " + line + "\n};\n";
}

std::vector<std::string> literals(const Numbers& numbers) {
    std::vector<std::string> texts;
    for (const double real : numbers.reals) {
        texts.push_back(real_literal(numbers.type, real));
    }
    for (const std::int64_t integer : numbers.integers) {
        texts.push_back(integer == INT32_MIN ? "INT32_MIN" : std::to_string(integer));
    }
    return texts;
}

std::vector<std::string> words_of_pairs(const std::vector<std::int64_t>& coefficients) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < coefficients.size(); i += 2) {
        const auto low = static_cast<std::uint16_t>(coefficients.at(i));
        const auto high = static_cast<std::uint16_t>(coefficients.at(i + 1));
        texts.push_back(bits_literal(static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 16, false));
    }
    return texts;
}

std::vector<std::string> literals(std::span<const std::uint64_t> bits, bool wide) {
    std::vector<std::string> texts;
    for (const std::uint64_t one : bits) {
        texts.push_back(bits_literal(one, wide));
    }
    return texts;
}

}  // namespace generate
