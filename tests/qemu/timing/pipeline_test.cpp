// The core's rules, one at a time: instructions of one's own, and what each of them waits for.
#include <gtest/gtest.h>

#include <memory>

#include "listing.hpp"
#include "probe.hpp"
#include "qemu/timing/decode.hpp"
#include "qemu/timing/model.hpp"

namespace {

// What a program that runs from the ITCM, a few times over, loses to an effect in its last turn, in half cycles.
// \param accesses  of each instruction: address or 0 for none carried out
std::int64_t lost(const std::string& program, const std::vector<std::uint32_t>& accesses, timing::Effect effect) {
    const timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    timing::Model model(core.sets[0].figures, core.placement, core.off);
    std::vector<std::unique_ptr<timing::Prepared>> sites;
    std::vector<std::uint32_t> addresses;
    std::uint32_t address = 0x100;
    for (const listing::Line& line : listing::assemble(program)) {
        sites.push_back(std::make_unique<timing::Prepared>(timing::decode(line.encoding, line.bytes)));
        addresses.push_back(address);
        address += line.bytes;
    }
    std::int64_t before = 0;
    for (int turn = 0; turn < 8; ++turn) {
        before = model.losses()[timing::index(effect)];
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const timing::Decoded& d = sites[i]->decoded;
            std::vector<qemu::Access> made;
            if (accesses[i] != 0) {
                made.push_back({accesses[i], d.access_bytes, d.is_store()});
            }
            model.execute(*sites[i], addresses[i], made, i + 1 < sites.size() ? addresses[i + 1] : addresses[0]);
        }
    }
    return model.losses()[timing::index(effect)] - before;
}

// The DTCM's two banks hold even and odd words: two loads of one bank do not go together, of two banks they do, and
// a load whose condition fails asks for none.
TEST(Pipeline, LoadsMeetInABankWhereBothAreCarriedOut) {
    const std::string two = "nop.w\nnop.w\nldr.w r2,[r0]\nldr.w r3,[r1]\nnop.w\nnop.w\nb.w .-20\n";
    const auto conflict = timing::Effect::load_bank_conflict;
    EXPECT_GT(lost(two, {0, 0, 0x20000000, 0x20000008, 0, 0, 0}, conflict), 0);
    EXPECT_EQ(lost(two, {0, 0, 0x20000000, 0x20000004, 0, 0, 0}, conflict), 0);
    EXPECT_EQ(lost(two, {0, 0, 0, 0x20000008, 0, 0, 0}, conflict), 0);
    EXPECT_EQ(lost(two, {0, 0, 0x20000000, 0, 0, 0, 0}, conflict), 0);
}

// Additions that do not need each other: the unit takes one after the other, or each in its turn.
TEST(Pipeline, ASerialUnitOverlapsNothing) {
    const timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    probe::Setting setting = probe::core("stm32f746-itcm");
    const std::string apart = "vadd.f32 s0,s1,s2\nvadd.f32 s3,s4,s5\nvadd.f32 s6,s7,s8\nvadd.f32 s9,s10,s11\n";
    const double overlapping = probe::steady_cycles(apart, setting);
    setting.figures.mechanisms.serial_fpu = true;
    const double serial = probe::steady_cycles(apart, setting);
    EXPECT_DOUBLE_EQ(serial, 4.0 * static_cast<double>(core.sets[0].figures.fp_add_to_operand));
    EXPECT_LT(overlapping, serial);
    const std::string integer = "add r0,r1,r2\nadd r3,r4,r5\n";
    EXPECT_DOUBLE_EQ(probe::steady_cycles(integer, setting), 1.0);
}

// What the data of an FP store costs the next load of its bank: a cycle, as long as it comes within the window behind
// it, and once. In half cycles, of loads behind so many instructions that issue two a cycle.
TEST(Pipeline, AnFpStoreIsLateForTheNextLoadOfItsBank) {
    probe::Setting setting = probe::core("stm32f746-itcm");
    const auto lost_behind = [&](int nops, const std::string& loads) {
        std::string text = "vstr s0,[r0]\n";
        for (int i = 0; i < nops; ++i) {
            text += "nop.w\n";
        }
        return probe::run(text + loads, setting).losses[timing::index(timing::Effect::load_bank_conflict)];
    };
    EXPECT_EQ(setting.figures.store_late_fp_window, 8);
    for (const int window : {1, 8}) {
        setting.figures.store_late_fp_window = window;
        for (const int nops : {1, 2, 3, 4, 14, 15, 16, 17}) {
            const int place = nops + 1;  // half cycles behind the store
            const int waits = place / 2 <= window ? 2 - place % 2 : 0;
            EXPECT_EQ(lost_behind(nops, "ldr.w r2,[r1]\n"), waits) << window << ' ' << nops;
            EXPECT_EQ(lost_behind(nops, "ldr.w r2,[r1]\nnop.w\nldr.w r3,[r1]\n"), waits) << window << ' ' << nops;
            EXPECT_EQ(lost_behind(nops, "ldr.w r2,[r1,#4]\n"), 0) << window << ' ' << nops;
        }
    }
}

// However long a store keeps its word, a load looks back at eight of them.
TEST(Pipeline, ALoadMeetsAnyOfTheLastEightStores) {
    probe::Setting setting = probe::core("stm32f746-itcm");
    setting.figures.store_to_load = 40;
    for (int others = 0; others < 12; ++others) {
        std::string text = "str.w r0,[r1]\n";
        for (int i = 0; i < others; ++i) {
            text += "str.w r0,[r2]\n";
        }
        const auto positions = probe::run(text + "ldr.w r3,[r1]\n", setting).positions;
        EXPECT_EQ(positions.back() / 2 - positions.front() / 2, others < 8 ? 40 : others) << others;
    }
}

// A MAC is barred for so many cycles behind the last cycle of a transfer, which moves two registers a cycle.
TEST(Pipeline, AMacIsBarredBehindTheLastRegisterOfATransfer) {
    for (const int barred : {1, 2}) {
        probe::Setting setting = probe::core("stm32f746-itcm");
        setting.figures.fp_mac_bar_after_load = setting.figures.fp_mac_bar_after_store = barred;
        for (const int registers : {2, 3, 4, 5, 8}) {
            const std::string list = "r0,{s0-s" + std::to_string(registers - 1) + "}\nvfma.f32 s20,s21,s22\n";
            for (const char* transfer : {"vldm ", "vstm "}) {
                const auto positions = probe::run(transfer + list, setting).positions;
                EXPECT_EQ(positions.at(1) / 2 - positions.at(0) / 2, (registers - 1) / 2 + barred + 1)
                    << transfer << registers;
            }
        }
    }
}

// While the core waits, fetching goes on until the queue is full; how many words then follow at once tells its length.
TEST(Pipeline, FetchesAQueueOfWordsAheadOfTheirUse) {
    timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    // A queue holds a word at least, and 8 at most.
    for (const auto& [queue, holds] :
         {std::pair(1, 1), std::pair(2, 2), std::pair(4, 4), std::pair(8, 8), std::pair(0, 1), std::pair(9, 8)}) {
        core.sets[0].figures.fetch_queue = queue;
        timing::Pipeline pipeline(core.sets[0].figures, 40, core.off);
        const auto prepared = [](const std::string& text) {
            const listing::Line line = listing::assemble(text + "\n").front();
            return timing::Prepared(timing::decode(line.encoding, line.bytes));
        };
        timing::Event load;
        load.accesses = 1;
        load.access_bytes = 4;
        load.load_delay = 400;
        const timing::Prepared first = prepared("ldr.w r2,[r0]");  // the pipeline looks back at it
        const timing::Prepared second = prepared("add.w r3,r2,r2");
        pipeline.execute(first, load);
        pipeline.execute(second, {});
        timing::Event word;  // two instructions each, and longer on its way than the queue lasts
        word.words = 1;
        word.fetch_delays[0] = 32;
        word.fetch_effect = timing::Effect::flash_wait_states;
        const timing::Prepared nop = prepared("nop.w");
        const auto late = timing::index(timing::Effect::flash_wait_states);
        int at_once = 0;
        while (pipeline.losses[late] == 0 && at_once < 20) {
            pipeline.execute(nop, word);
            pipeline.execute(nop, {});
            at_once += pipeline.losses[late] == 0 ? 1 : 0;
        }
        EXPECT_EQ(at_once, holds) << queue;
    }
}

}  // namespace
