#include "qemu/emulate/unwinding.hpp"

#include <string>
#include <vector>

namespace qemu {

timing::Unwinding unwinding_of(const Elf& elf) {
    timing::Unwinding unwinding;
    for (const char* name : {"__restore_core_regs", "longjmp"}) {
        if (const auto begin = elf.symbol(name)) {
            unwinding.restorers.push_back({*begin, elf.end_of_function(*begin)});
        }
    }
    if (unwinding.restorers.empty()) {
        return unwinding;
    }
    const std::vector<Function> functions = elf.functions_like({"*"});
    for (const Function& function : functions) {
        // GCC moves what catches to a part of its own.
        const auto whole = elf.symbols().find(function.name.substr(0, function.name.find(".cold")));
        unwinding.functions[function.address] = whole != elf.symbols().end() ? whole->second : function.address;
    }
    unwinding.functions[functions.back().address + functions.back().bytes] = 0;
    return unwinding;
}

}  // namespace qemu
