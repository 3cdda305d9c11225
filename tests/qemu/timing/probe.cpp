#include "probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <regex>
#include <stdexcept>

#include "qemu/timing/cortex_m4/pipeline.hpp"
#include "qemu/timing/decode.hpp"

namespace probe {
namespace {

using timing::Decoded;
using timing::Role;

// The memory operand of a line: "[r1, #4]!", "[r1], #-4", "[r1, r2, lsl #2]", "r1!, {..}".
struct Place {
    unsigned base = 0;
    int before = 0;
    int after = 0;
};

unsigned register_named(const std::string& name) {
    const auto found = listing::registers_in(name);
    if (found.size() != 1) {
        throw std::runtime_error("expected a register, found " + name);
    }
    return *found.begin();
}

Place place_of(const listing::Line& line, const Decoded& d) {
    Place place;
    const std::string name = d.mnemonic;
    const int bytes = 4 * d.registers;
    if (name == "push" || name == "vpush") {
        return {13, -bytes, -bytes};
    }
    if (name == "pop" || name == "vpop") {
        return {13, 0, bytes};
    }
    std::smatch parts;
    static const std::regex bracket("\\[([a-z0-9]+)(?:, #(-?[0-9]+))?[^\\]]*\\](!)?(?:, #(-?[0-9]+))?");
    if (std::regex_search(line.operands, parts, bracket)) {
        place.base = register_named(parts[1]);
        place.before = parts[2].matched ? std::stoi(parts[2]) : 0;
        place.after = parts[3].matched ? place.before : parts[4].matched ? std::stoi(parts[4]) : 0;
        return place;
    }
    // LDM and its kin.
    place.base = register_named(line.operands.substr(0, line.operands.find_first_of("!,")));
    const bool down = name.ends_with("db");
    const bool writes = line.operands.find('!') != std::string::npos;
    place.before = down ? -bytes : 0;
    place.after = !writes ? 0 : down ? -bytes : bytes;
    return place;
}

std::int32_t branch_offset(std::uint32_t e, std::uint8_t bytes) {
    const auto sign = [](std::uint32_t value, unsigned bits) {
        return static_cast<std::int32_t>(value << (32 - bits)) >> (32 - bits);
    };
    if (bytes == 2) {
        if ((e & 0xF000) == 0xD000) {
            return 4 + 2 * sign(e & 0xFF, 8);
        }
        return (e & 0xF800) == 0xE000 ? 4 + 2 * sign(e & 0x7FF, 11) : 0x100;  // cbz: forward
    }
    const std::uint32_t s = e >> 26 & 1;
    const std::uint32_t j1 = e >> 13 & 1;
    const std::uint32_t j2 = e >> 11 & 1;
    if ((e & 0x1000) == 0) {
        return 4 + 2 * sign(s << 19 | j2 << 18 | j1 << 17 | (e >> 16 & 0x3F) << 11 | (e & 0x7FF), 20);
    }
    const std::uint32_t i1 = (j1 ^ s ^ 1) & 1;
    const std::uint32_t i2 = (j2 ^ s ^ 1) & 1;
    return 4 + 2 * sign(s << 23 | i1 << 22 | i2 << 21 | (e >> 16 & 0x3FF) << 11 | (e & 0x7FF), 24);
}

bool accesses_data(const Decoded& d) {
    return d.registers > 0 && (d.branch == timing::Branch::none || d.branch == timing::Branch::back);
}

struct Text {
    std::vector<listing::Line> lines;
    std::vector<timing::Prepared> prepared;
    std::vector<Place> places;  // of those that access memory
};

// Each text is assembled and decoded once.
const Text& text_of(const std::string& assembly) {
    static std::map<std::string, Text> texts;
    const auto [at, is_new] = texts.try_emplace(assembly);
    Text& text = at->second;
    if (is_new) {
        text.lines = listing::assemble(assembly);
        timing::ItBlock it;
        for (const listing::Line& line : text.lines) {
            text.prepared.emplace_back(timing::decode(line.encoding, line.bytes, it.condition(), it.inside()));
            const Decoded& d = text.prepared.back().decoded;
            text.places.push_back(accesses_data(d) ? place_of(line, d) : Place{});
            if (d.kind == timing::Kind::if_then) {
                it.begin(line.encoding);
            } else {
                it.advance();
            }
        }
    }
    return text;
}

}  // namespace

Setting core(const std::string& name) {
    // Each file is read once: a test asks for a core thousands of times.
    static std::map<std::string, Setting> settings;
    const auto [at, is_new] = settings.try_emplace(name);
    if (is_new) {
        const timing::CoreFile file = timing::read_core(TEST_CORES, name);
        at->second = {file.sets[0].figures, file.placement, file.off, {}, 1, file.core};
    }
    return at->second;
}

template <class Model>
Outcome walk(const std::string& assembly, const Setting& setting) {
    const auto& [lines, prepared, places] = text_of(assembly);
    std::map<unsigned, std::uint32_t> registers;
    for (unsigned reg = 0; reg < 13; ++reg) {
        registers[reg] = 0x20000000U + 0x100 * reg;
    }
    registers[13] = 0x20010000U;
    registers[15] = 0;
    for (const auto& [reg, address] : setting.registers) {
        registers[reg] = address;
    }
    Model model(setting.figures, setting.placement, setting.off);
    Outcome outcome;
    std::map<std::size_t, unsigned> turns;
    std::vector<std::size_t> returns;
    for (std::size_t i = 0; i < lines.size();) {
        const Decoded& d = prepared[i].decoded;
        outcome.unknown += d.kind == timing::Kind::unknown ? 1 : 0;
        std::vector<qemu::Access> accesses;
        if (accesses_data(d)) {
            const Place& place = places[i];
            const std::uint32_t first = registers[place.base] + static_cast<std::uint32_t>(place.before);
            const bool one_of_eight = std::string(d.mnemonic) == "vldr" && d.registers == 2;
            for (unsigned n = 0; n < (one_of_eight ? 1U : d.registers); ++n) {
                accesses.push_back({first + 4 * n, one_of_eight ? std::uint8_t{8} : d.access_bytes, d.is_store()});
            }
            registers[place.base] += static_cast<std::uint32_t>(place.after);
        }
        std::size_t next = i + 1;
        if (d.branch == timing::Branch::back && !returns.empty()) {
            next = returns.back();
            returns.pop_back();
        } else if (d.branch == timing::Branch::direct || d.branch == timing::Branch::conditional ||
                   d.branch == timing::Branch::call) {
            const std::uint32_t target =
                lines[i].address + static_cast<std::uint32_t>(branch_offset(lines[i].encoding, lines[i].bytes));
            const bool backward = target <= lines[i].address;
            const bool calls = d.branch == timing::Branch::call;
            if (calls) {
                returns.push_back(i + 1);
            }
            if (calls || (backward ? ++turns[i] < setting.turns : d.branch == timing::Branch::direct)) {
                next = static_cast<std::size_t>(
                    std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.address == target; }) -
                    lines.begin());
            }
        }
        const std::uint32_t next_address =
            next < lines.size() ? lines[next].address : lines[i].address + lines[i].bytes;
        outcome.positions.push_back(model.execute(prepared[i], lines[i].address, accesses, next_address));
        i = next;
    }
    outcome.losses = model.losses();
    return outcome;
}

Outcome run(const std::string& assembly, const Setting& setting) {
    return setting.core == timing::Core::cortex_m4
               ? walk<timing::ModelOf<timing::cortex_m4::Pipeline>>(assembly, setting)
               : walk<timing::Model>(assembly, setting);
}

std::string lines_of(const char* text) {
    std::string lines(text);
    std::replace(lines.begin(), lines.end(), ';', '\n');
    return lines + "\n";
}

double steady_cycles(const std::string& assembly, const Setting& setting) {
    const auto position_behind = [&](int copies) {
        std::string text = ".p2align 3\n";
        for (int i = 0; i < copies; ++i) {
            text += assembly + "\n";
        }
        // Two bundles of their own make the end the same, whatever the last copy leaves behind.
        return run(text + "dsb\n", setting).positions.back();
    };
    return static_cast<double>(position_behind(24) - position_behind(16)) / 2.0 / 8.0;
}

double steady_turns(const std::string& assembly, Setting setting) {
    const auto position_behind = [&](unsigned turns) {
        setting.turns = turns;
        return run(".p2align 3\n" + assembly + "\ndsb\n", setting).positions.back();
    };
    return static_cast<double>(position_behind(24) - position_behind(16)) / 2.0 / 8.0;
}

double steady(const char* text, How how, const Setting& setting) {
    return how == How::copies ? steady_cycles(lines_of(text), setting) : steady_turns(lines_of(text), setting);
}

void expect_losses_to_sum(const char* text, const std::string& core_name) {
    Setting setting = core(core_name);
    setting.turns = 5;
    const Outcome outcome = run(lines_of(text), setting);
    EXPECT_EQ(outcome.positions.back() + 1,
              static_cast<std::int64_t>(outcome.positions.size()) +
                  std::accumulate(outcome.losses.begin(), outcome.losses.end(), std::int64_t{0}))
        << text << " on " << core_name;
}

void expect_effects_to_switch_off(const char* text, const std::string& core_name) {
    for (std::size_t effect = 0; effect < timing::effect_count; ++effect) {
        Setting setting = core(core_name);
        setting.off.set(effect);
        EXPECT_EQ(run(lines_of(text), setting).losses[effect], 0) << text;
    }
}

}  // namespace probe
