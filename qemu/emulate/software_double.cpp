#include "qemu/emulate/software_double.hpp"

#include <map>
#include <regex>

namespace qemu {

bool is_double_routine(const std::string& symbol) {
    static const std::regex routine(
        "__aeabi_c?d(add|sub|rsub|mul|div|neg|r?cmp[a-z]+|2[a-z]+)|__aeabi_(f|i|ui|l|ul)2d|"
        "__(add|sub|mul|div)df3|__negdf2|__(eq|ne|lt|le|gt|ge|cmp|unord)df2|__fix(uns)?df[sd]i|__float(un)?[sd]idf|"
        "__extendsfdf2|__truncdfsf2");
    return symbol.starts_with("__") && std::regex_match(symbol, routine);
}

std::vector<timing::AddressRange> double_routines(const Elf& elf) {
    std::map<std::uint32_t, std::uint32_t> ends;  // by begin: a routine has several names
    for (const auto& [name, address] : elf.symbols()) {
        if (is_double_routine(name)) {
            ends[address] = elf.end_of_function(address);
        }
    }
    std::vector<timing::AddressRange> ranges;
    for (const auto& [begin, end] : ends) {
        ranges.push_back({begin, end});
    }
    return ranges;
}

timing::TimingRequest for_program(timing::TimingRequest request, const Elf& elf) {
    request.double_routines = double_routines(elf);
    return request;
}

}  // namespace qemu
