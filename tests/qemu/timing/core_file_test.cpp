// Core files: those of the repository are whole, and damaged ones are told apart with file and line.
#include "qemu/timing/core_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/timing_log.hpp"

namespace {

const std::filesystem::path cores(TEST_CORES);

TEST(CoreFile, TheNamedCoresAreThere) {
    EXPECT_EQ(timing::core_names(cores),
              (std::vector<std::string>{"cortex-m4-zerowait", "m7-ideal", "stm32f746-flash", "stm32f746-flash-art",
                                        "stm32f746-flash-nocache", "stm32f746-itcm", "stm32f767-axi", "stm32f767-flash",
                                        "stm32f767-itcm", "stm32h743-axi", "stm32h743-dtcm", "stm32h743-itcm",
                                        "stm32h747-axi", "stm32h747-dtcm", "stm32h747-m4"}));
    for (const std::string& name : timing::core_names(cores)) {
        const timing::CoreFile core = timing::read_core(cores, name);
        EXPECT_GE(core.sets.size(), 2U) << name;
        EXPECT_EQ(core.sets[0].name, "nominal");
        EXPECT_NE(core.text.find("note = \"" + core.note), std::string::npos) << name;
        EXPECT_FALSE(core.note.empty()) << name;
        for (const timing::Origin& origin : core.origins) {
            EXPECT_FALSE(origin.source.empty()) << origin.key;
            if (origin.mark == timing::Mark::fitted) {  // on which rows?
                EXPECT_TRUE(origin.source.find("H747 rows") != std::string::npos ||
                            origin.source.find("AES") != std::string::npos)
                    << origin.key;
            }
        }
    }
}

// Larger caches and other clocks are the only news of a chip whose core is the same.
TEST(CoreFile, ChipsDifferInCachesAndMemories) {
    const auto figures = [](const char* name) { return timing::read_core(cores, name).sets[0].figures; };
    EXPECT_EQ(figures("stm32f746-flash").cache_data_bytes, 4096);
    EXPECT_EQ(figures("stm32f767-flash").cache_data_bytes, 16384);
    EXPECT_EQ(figures("stm32f767-flash").cache_instruction_bytes, 16384);
    const std::pair<const char*, std::int64_t> wait_states[] = {
        {"stm32f746-flash", 7}, {"stm32f767-flash", 7}, {"stm32h747-dtcm", 2}, {"stm32h743-dtcm", 4}};
    for (const auto& [name, states] : wait_states) {
        EXPECT_EQ(timing::Memory(figures(name), {}).flash_wait_states(), states) << name;
    }
    EXPECT_EQ(figures("stm32f767-itcm").result_load_word, figures("stm32h743-itcm").result_load_word);
}

TEST(CoreFile, OnlyTheIdealCoreHasEverythingOff) {
    EXPECT_TRUE(timing::read_core(cores, "m7-ideal").off.all());
    EXPECT_TRUE(timing::read_core(cores, "stm32f746-itcm").off.none());
}

// Changes the text of a copy of the cores and reads one of them.
std::string message_after(const std::string& file, const std::string& from, const std::string& to,
                          const std::string& read = "stm32f746-itcm") {
    const base::Scratch scratch;
    const auto folder = scratch.file("cores");
    std::filesystem::copy(cores, folder);
    std::ostringstream text;
    text << std::ifstream(folder / file).rdbuf();
    std::string changed = text.str();
    const auto at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    std::ofstream(folder / file) << changed;
    try {
        (void)timing::read_core(folder, read);
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "";
}

TEST(CoreFile, DamageIsNamedWithFileAndLine) {
    const std::string base = "_cortex-m7.toml";
    EXPECT_EQ(message_after(base, "# ", "# "), "");
    EXPECT_NE(message_after(base, "two_loads_pair", "three_loads_pair").find("issue.three_loads_pair: no such row"),
              std::string::npos);
    EXPECT_NE(message_after(base, "two_loads_pair = { value = 1", "two_loads_pair = { value = true")
                  .find("issue.two_loads_pair: expected value = a whole number"),
              std::string::npos);
    EXPECT_NE(message_after(base, "two_loads_pair = { value = 1", "two_loads_pair = { value = -1").find("at least 0"),
              std::string::npos);
    EXPECT_NE(message_after(base, "mark = \"measured\"", "mark = \"guessed\"").find("expected a mark"),
              std::string::npos);
    EXPECT_NE(message_after(base, "[rows.read]", "[rows.reads]").find("reads.accumulator: no such row"),
              std::string::npos);
    EXPECT_NE(message_after(base, "[rows.read]", "[rows.read").find("_cortex-m7.toml:"), std::string::npos);
    EXPECT_NE(message_after(base, "# ", std::string(1u << 20, '#')).find("_cortex-m7.toml: expected a core file of at"),
              std::string::npos);
    EXPECT_NE(message_after(base, "store_data = ", "# ").find("expected the row read.store_data"), std::string::npos);
    EXPECT_NE(message_after(base, "fits = false", "fits = 0").find("fits: expected true or false"), std::string::npos);
    EXPECT_NE(
        message_after(base, "store.late_fp_cost = ", "memory.clock_hz = ").find("no row that a rival set may change"),
        std::string::npos);
    EXPECT_NE(message_after("_stm32f746.toml", "line_bytes = { value = 32", "line_bytes = { value = 33")
                  .find("_stm32f746.toml:9: cache.line_bytes: expected a power of two, found 33"),
              std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "base = \"_stm32f746\"", "base = \"_none\"").find(":1: base"),
              std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "\"dtcm\"", "\"tcm\"").find("expected dtcm or axi, found tcm"),
              std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "note", "notes").find("notes: no such key"), std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "note", "effects_off = [\"friction\"]\nnote")
                  .find("no such effect: friction"),
              std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "note", "mechanisms = [\"oracle\"]\nnote")
                  .find("stm32f746-itcm.toml:2: mechanisms: no such mechanism: oracle"),
              std::string::npos);
    EXPECT_NE(message_after("stm32f746-itcm.toml", "note", "mechanisms = 1\nnote").find("expected mechanisms = ["),
              std::string::npos);
}

// A file names its core, and has the rows of that core and no others'.
TEST(CoreFile, EachCoreHasRowsOfItsOwn) {
    EXPECT_EQ(timing::read_core(cores, "cortex-m4-zerowait").core, timing::Core::cortex_m4);
    EXPECT_EQ(timing::read_core(cores, "stm32h747-m4").core, timing::Core::cortex_m4);
    EXPECT_EQ(timing::read_core(cores, "stm32h747-dtcm").core, timing::Core::cortex_m7);
    const auto m4 = [](const std::string& from, const std::string& to) {
        return message_after("_cortex-m4.toml", from, to, "cortex-m4-zerowait");
    };
    EXPECT_EQ(m4("# ", "# "), "");
    EXPECT_NE(m4("\"cortex-m4\"", "\"cortex-m5\"").find("core: expected cortex-m7 or cortex-m4, found cortex-m5"),
              std::string::npos);
    EXPECT_NE(m4("[rows.use]", "[rows.read]\naddress = { value = 1, mark = \"assumed\", source = \"x\" }\n[rows.use]")
                  .find("read.address: no row of a cortex-m4"),
              std::string::npos);
    EXPECT_NE(m4("use.loaded_address_ahead =", "read.address =").find("read.address: no row of a cortex-m4"),
              std::string::npos);
    EXPECT_NE(m4("fp_next = ", "# ").find("expected the row use.fp_next"), std::string::npos);
    EXPECT_NE(message_after("_cortex-m7.toml", "[rows.read]",
                            "[rows.use]\nfp_next = { value = 1, mark = \"assumed\", source = \"x\" }\n[rows.read]")
                  .find("use.fp_next: no row of a cortex-m7"),
              std::string::npos);
}

TEST(CoreFile, OneThatCannotBeReadIsNamed) {
    const base::Scratch scratch;
    std::filesystem::create_directory(scratch.file("folder.toml"));
    try {
        (void)timing::read_core(scratch.file(""), "folder");
        FAIL();
    } catch (const glsum::Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("folder.toml: no such core file"), std::string::npos)
            << failure.what();
    }
}

TEST(CoreFile, ACoreOrEffectThatDoesNotExistIsNamedWithThoseThatDo) {
    try {
        (void)timing::read_core(cores, "m8");
        FAIL();
    } catch (const glsum::Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("m7-ideal"), std::string::npos);
    }
    timing::TimingRequest request;
    request.cores_folder = cores.string();
    request.cores = {{"m7-ideal", "", "", true, "", {"backlash"}}};
    EXPECT_THROW((void)timing::cores_of(request), glsum::Failure);
    request.cores = {{"stm32f746-itcm", "", "", true, "publshed", {}}};
    EXPECT_THROW((void)timing::cores_of(request), glsum::Failure);
    request.cores = {{"stm32f746-itcm", "flash", "axi", true, "published", {"load_use"}}};
    const auto changed = timing::cores_of(request);
    EXPECT_TRUE(changed[0].off[timing::index(timing::Effect::load_use)]);
    EXPECT_EQ(changed[0].placement.code, timing::CodePlace::flash);
    EXPECT_EQ(changed[0].placement.data, timing::DataPlace::axi);
    ASSERT_EQ(changed[0].sets.size(), 1U);
    EXPECT_EQ(changed[0].sets[0].name, "published");
    EXPECT_GT(changed[0].sets[0].figures.measurement_maintenance, 0);
    // Every cycle effect has a switch: what lies beside a call costs nothing then, whatever the rule set.
    for (const std::string effect : {"single_issue",
                                     "result_latency",
                                     "load_use",
                                     "load_bank_conflict",
                                     "fpu_latency",
                                     "mac_latency",
                                     "double_precision_in_software",
                                     "branch_mispredict",
                                     "store_buffer",
                                     "unaligned_access",
                                     "fetch_alignment",
                                     "icache_misses",
                                     "dcache_misses",
                                     "flash_wait_states",
                                     "cache_maintenance",
                                     "call_overhead",
                                     "clock_ratio",
                                     "interrupt_load",
                                     "bus_contention",
                                     "different_binary"}) {
        request.cores = {{"stm32h747-dtcm", "", "", true, "", {effect}}};
        const timing::CoreFile core = timing::cores_of(request)[0];
        EXPECT_EQ(core.off.count(), timing::effect_named(effect) ? 1U : 0U) << effect;
        EXPECT_EQ(core.double_in_software_off, effect == "double_precision_in_software");
        for (const timing::RuleSet& set : core.sets) {
            EXPECT_EQ(set.figures.measurement_counter_reads == 0, effect == "call_overhead") << effect;
            EXPECT_EQ(set.figures.measurement_maintenance == 0, effect == "cache_maintenance") << effect;
        }
    }
}

// What a fuzzer begins with has to be read to its end: else it never gets behind a row that went.
TEST(CoreFile, TheFuzzersWholeFileIsOne) {
    const timing::CoreFile core = timing::read_core_file(cores / "../../tests/fuzz/seeds/core_file/whole.toml", cores);
    EXPECT_EQ(core.sets.size(), timing::read_core(cores, "stm32f746-itcm").sets.size());
    EXPECT_TRUE(std::all_of(core.origins.begin(), core.origins.end(),
                            [](const timing::Origin& row) { return row.file.ends_with("whole.toml"); }));
}

TEST(CoreFile, AFileAnywhereIsBasedOnWhatLiesBesideItOrInTheFolder) {
    const base::Scratch scratch;
    const auto write = [&](const char* name, const std::string& text) { std::ofstream(scratch.file(name)) << text; };
    write("mine.toml", "base = \"own-base\"\nnote = \"mine\"\nplacement = { code = \"flash\", data = \"axi\" }\n");
    write("own-base.toml",
          "base = \"_stm32f746\"\n[rows.memory]\nclock_hz = { value = 200000000, mark = \"assumed\", source = \"a "
          "test\" }\n");
    const timing::CoreFile core = timing::read_core_file(scratch.file("mine.toml"), cores);
    EXPECT_EQ(core.name, "mine");
    EXPECT_EQ(core.placement.code, timing::CodePlace::flash);
    EXPECT_EQ(core.sets[0].figures.memory_clock_hz, 200'000'000);
    EXPECT_EQ(core.sets[0].figures.cache_data_bytes, 4096);
    // Named by its path, or as one of the folder.
    EXPECT_EQ(timing::read_named_core(cores, scratch.file("mine.toml").string()).name, "mine");
    EXPECT_EQ(timing::read_named_core(cores, "stm32f746-itcm").name, "stm32f746-itcm");
    // Beside it comes first.
    write("_stm32f746.toml", "base = \"_stm32h747\"\n");
    EXPECT_EQ(timing::read_core_file(scratch.file("mine.toml"), cores).sets[0].figures.cache_data_bytes, 16384);
    write("own-base.toml", "base = \"mine\"\n");
    EXPECT_THROW((void)timing::read_core_file(scratch.file("mine.toml"), cores), glsum::Failure);
    EXPECT_THROW((void)timing::read_core_file(scratch.file("none.toml"), cores), glsum::Failure);
    EXPECT_THROW((void)timing::read_core_file(scratch.file(""), cores), glsum::Failure);
    EXPECT_TRUE(timing::names_core_file("./mine"));
    EXPECT_TRUE(timing::names_core_file("mine.toml"));
    EXPECT_FALSE(timing::names_core_file("stm32f746-itcm"));
}

TEST(TimingRequest, PlacesRangesAndReadsACoreFileByItsPath) {
    const base::Scratch scratch;
    const std::string file = scratch.file("a core.toml").string();
    std::ofstream(file) << "base = \"m7-ideal\"\nplacement = { code = \"flash\", data = \"dtcm\" }\n";
    timing::TimingRequest request;
    request.cores_folder = cores.string();
    request.cores = {{"a core", "", ""}, {"m7-ideal", "", ""}};
    request.cores[0].name = "mine";
    request.cores[0].file = file;
    request.cores[0].ranges = {{0x100, 0x200, timing::Place::dtcm}, {0x20000000, 0x20000010, timing::Place::axi}};
    std::stringstream text;
    timing::write_timing_request(text, request);
    const auto read = timing::cores_of(timing::read_timing_request(text));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].name, "a core");
    EXPECT_EQ(read[0].placement.code, timing::CodePlace::flash);
    ASSERT_EQ(read[0].placement.ranges.size(), 2U);
    EXPECT_EQ(read[0].placement.ranges[0].begin, 0x100U);
    EXPECT_EQ(read[0].placement.ranges[0].end, 0x200U);
    EXPECT_EQ(read[0].placement.ranges[0].place, timing::Place::dtcm);
    EXPECT_EQ(read[0].placement.ranges[1].place, timing::Place::axi);
    EXPECT_TRUE(read[1].placement.ranges.empty());
    EXPECT_EQ(read[1].name, "m7-ideal");
}

TEST(TimingRequest, IsReadAsItWasWritten) {
    timing::TimingRequest request;
    request.cores_folder = "/a folder/cores";
    request.double_routines = {{16, 32}, {48, 50}};
    request.cores = {{"one", "itcm", ""}, {"two", "", "axi", false, "chain", {"load_use", "single_issue"}}};
    std::stringstream text;
    timing::write_timing_request(text, request);
    const timing::TimingRequest read = timing::read_timing_request(text);
    EXPECT_EQ(read.cores_folder, request.cores_folder);
    ASSERT_EQ(read.double_routines.size(), 2U);
    EXPECT_EQ(read.double_routines[1].begin, 48U);
    EXPECT_EQ(read.double_routines[1].end, 50U);
    ASSERT_EQ(read.cores.size(), 2U);
    EXPECT_EQ(read.cores[0].code, "itcm");
    EXPECT_EQ(read.cores[0].data, "");
    EXPECT_TRUE(read.cores[0].instruction_cache);
    EXPECT_FALSE(read.cores[1].instruction_cache);
    EXPECT_EQ(read.cores[0].set, "");
    EXPECT_TRUE(read.cores[0].without.empty());
    EXPECT_EQ(read.cores[1].set, "chain");
    EXPECT_EQ(read.cores[1].without, request.cores[1].without);
}

}  // namespace
