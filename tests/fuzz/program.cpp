// Any program: instructions and accesses, six bytes each, told to the decoder and the counter by instruction. Whatever
// it counts, its log is read back, and a call is a branch.
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "qemu/stream/call_counter.hpp"
#include "qemu/stream/thumb.hpp"
#include "tests/fuzz/refused.hpp"

namespace {
constexpr std::uint32_t entries[] = {0x100, 0x104, 0x200};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qemu::CallCounter counter({std::begin(entries), std::end(entries)});
    // An address holds one instruction for a whole run, as the plugin promises.
    std::unordered_map<std::uint32_t, qemu::Instruction> known;
    for (; size >= 6; data += 6, size -= 6) {
        std::uint16_t address;
        std::uint32_t encoding;
        std::memcpy(&address, data, 2);
        std::memcpy(&encoding, data + 2, 4);
        if ((address & 1U) != 0) {
            counter.accesses({encoding, 4, (address & 2U) != 0});
            continue;
        }
        const std::uint8_t bytes = qemu::bytes_from(static_cast<std::uint16_t>(encoding >> 16));
        const qemu::Instruction told{address, bytes == 2 ? encoding >> 16 : encoding, bytes,
                                     static_cast<std::uint32_t>(known.size())};
        const qemu::Instruction& instruction = known.try_emplace(address, told).first->second;
        (void)qemu::stores(instruction);
        fuzz::expect(!qemu::is_call(instruction) || qemu::is_branch(instruction));
        counter.executes(instruction);
    }
    std::stringstream log;
    counter.write(log);
    try {
        const qemu::CallLog read = qemu::read_call_log(log);
        fuzz::expect(counter.fault().empty() && read.runs.size() == counter.runs().size());
        for (std::size_t i = 0; i < read.runs.size(); ++i) {
            fuzz::expect(read.runs[i].entry == counter.runs()[i].entry &&
                         read.runs[i].calls == counter.runs()[i].calls &&
                         read.runs[i].counts == counter.runs()[i].counts);
        }
        fuzz::expect(read.reached == counter.reached());
    } catch (const std::runtime_error&) {  // a fault, or a call that did not return
    }
    return 0;
}
