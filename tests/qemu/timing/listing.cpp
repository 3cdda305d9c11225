#include "listing.hpp"

#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "base/scratch.hpp"
#include "qemu/timing/decoded.hpp"

namespace listing {
namespace {

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    std::array<char, 65536> buffer;
    for (std::size_t got; (got = fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;) {
        text.append(buffer.data(), got);
    }
    return text;
}

}  // namespace

std::vector<Line> disassemble(const std::filesystem::path& file) {
    std::istringstream text(output_of("arm-none-eabi-objdump -d -w '" + file.string() + "'"));
    std::vector<Line> lines;
    for (std::string row; std::getline(text, row);) {
        // "   8:\tf8d1 2004 \tldr.w\tr2, [r1, #4]"
        std::vector<std::string> parts;
        std::istringstream cells(row);
        for (std::string cell; std::getline(cells, cell, '\t');) {
            parts.push_back(cell);
        }
        if (parts.size() < 3 || parts[0].empty() || parts[0].back() != ':' || parts[2].starts_with(".")) {
            continue;
        }
        Line line{};
        line.address = static_cast<std::uint32_t>(std::stoul(parts[0], nullptr, 16));
        std::istringstream halves(parts[1]);
        std::string first;
        std::string second;
        halves >> first >> second;
        if (first.size() != 4) {
            continue;  // data
        }
        line.encoding = static_cast<std::uint32_t>(std::stoul(first + second, nullptr, 16));
        line.bytes = second.empty() ? 2 : 4;
        line.mnemonic = parts[2].substr(0, parts[2].find(' '));
        line.operands = parts.size() > 3 ? parts[3] : "";
        line.operands = line.operands.substr(0, line.operands.find_first_of("<;@"));
        if (line.mnemonic.starts_with("b") || line.mnemonic.starts_with("cb")) {
            // A branch's target is an address in hexadecimal, which may look like a register.
            static const std::regex target("(^|,\\s*)[0-9a-f]+\\s*$");
            line.operands = std::regex_replace(line.operands, target, "");
        }
        lines.push_back(line);
    }
    return lines;
}

std::vector<Line> assemble(const std::string& text) {
    const base::Scratch scratch;
    std::ofstream(scratch.file("probe.s")) << ".syntax unified\n.thumb\n.text\n" << text << '\n';
    const std::string object = scratch.file("probe.o").string();
    const std::string said = output_of("arm-none-eabi-as -mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard -o '" +
                                       object + "' '" + scratch.file("probe.s").string() + "' 2>&1");
    if (!std::filesystem::exists(object)) {
        throw std::runtime_error("the assembler said: " + said);
    }
    return disassemble(object);
}

std::set<unsigned> registers_in(const std::string& operands) {
    static const std::regex word("\\b(r|s|d)([0-9]+)\\b|\\b(sp|lr|pc|ip|fp|sl|sb)\\b|(-)(?=[rsd])");
    std::set<unsigned> found;
    bool range = false;
    unsigned previous = 0;
    bool is_double = false;
    for (auto it = std::sregex_iterator(operands.begin(), operands.end(), word); it != std::sregex_iterator(); ++it) {
        if ((*it)[4].matched) {
            range = true;
            continue;
        }
        unsigned number = 0;
        is_double = (*it)[1] == "d";
        if ((*it)[3].matched) {
            const std::string name = (*it)[3];
            number = name == "sp"   ? 13
                     : name == "lr" ? 14
                     : name == "pc" ? 15
                     : name == "ip" ? 12
                     : name == "fp" ? 11
                     : name == "sl" ? 10
                                    : 9;
        } else {
            number = static_cast<unsigned>(std::stoul((*it)[2]));
            if ((*it)[1] == "s") {
                number += timing::registers::s0;
            } else if (is_double) {
                number = timing::registers::s0 + 2 * number;
            }
        }
        for (unsigned one = range ? previous : number; one <= number + (is_double ? 1 : 0); ++one) {
            found.insert(one);
        }
        range = false;
        previous = number;
    }
    return found;
}

}  // namespace listing
