// The catalogue against the types it is made from, and against what names promise.
#include "glsum/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

using glsum::CatalogueEntry;
using glsum::find_kernel;
using glsum::Forgotten;

static_assert(glsum::catalogue.size() == glsum::Registry::count);
static_assert(find_kernel("ring_plain_f32")->format == "f32", "at compile time");

// The names of those that `holds` is true of, without the words behind the first: "modes", "modessum", ...
template <class Holds>
std::set<std::string> histories_of(Holds holds) {
    std::set<std::string> histories;
    for (const CatalogueEntry& entry : glsum::catalogue) {
        if (holds(entry)) {
            histories.insert(std::string(entry.history));
        }
    }
    return histories;
}
std::set<std::string> histories_of_family(std::string_view family) {
    return histories_of([&](const CatalogueEntry& entry) { return entry.family.word == family; });
}
std::set<std::string> histories_of(Forgotten forgotten) {
    return histories_of([&](const CatalogueEntry& entry) { return entry.forgotten == forgotten; });
}

TEST(Catalogue, HasAKernelForEachLineWithTheWordsOfItsName) {
    std::set<std::string> names;
    for (const CatalogueEntry& entry : glsum::catalogue) {
        EXPECT_TRUE(names.insert(std::string(entry.name)).second) << entry.name;
        EXPECT_EQ(find_kernel(entry.name), &entry);
        if (entry.name == "null") {
            EXPECT_TRUE(entry.history.empty() && entry.technique.empty() && entry.format.empty());
            EXPECT_EQ(entry.family.word, "");
        } else {
            EXPECT_EQ(std::string(entry.history) + "_" + std::string(entry.technique) + "_" + std::string(entry.format),
                      entry.name);
        }
    }
    std::vector<std::string> in_order;
    glsum::Registry::for_each([&]<class K>() { in_order.emplace_back(K::name()); });
    EXPECT_TRUE(std::equal(in_order.begin(), in_order.end(), glsum::catalogue.begin(), glsum::catalogue.end(),
                           [](const std::string& name, const CatalogueEntry& entry) { return name == entry.name; }));
    EXPECT_EQ(find_kernel("ring_plain_f33"), nullptr);
    EXPECT_EQ(find_kernel("ring_plain"), nullptr);
    EXPECT_EQ(find_kernel(""), nullptr);
}

TEST(Catalogue, SaysWhatIsKeptAndWhatIsForgotten) {
    using Words = std::set<std::string>;
    EXPECT_EQ(histories_of_family(""), Words{""});
    EXPECT_EQ(histories_of_family("window"),
              (Words{"shift", "ring", "mirror", "mirrordelta", "mirrorhold", "mirrorlinear"}));
    EXPECT_EQ(histories_of_family("lookahead"), Words{"block"});
    EXPECT_EQ(histories_of_family("transposed"), Words{"transposed"});
    EXPECT_EQ(histories_of_family("exponentials"), (Words{"modes", "modessum", "modesdelta"}));
    EXPECT_EQ(histories_of_family("filter"), (Words{"cascade", "cascadedelta"}));
    EXPECT_EQ(histories_of_family("logmemory"), Words{"nested"});
    EXPECT_EQ(histories_of(Forgotten::increments), (Words{"mirrordelta", "modesdelta", "cascadedelta"}));
    EXPECT_EQ(histories_of(Forgotten::held), Words{"mirrorhold"});
    EXPECT_EQ(histories_of(Forgotten::line), Words{"mirrorlinear"});
    EXPECT_EQ(histories_of([](const CatalogueEntry& entry) { return entry.integrator; }), Words{"modessum"});
    EXPECT_EQ(histories_of([](const CatalogueEntry& entry) { return entry.modes; }),
              (Words{"modes", "modessum", "modesdelta", "cascade", "cascadedelta"}));
    EXPECT_EQ(histories_of([](const CatalogueEntry& entry) { return entry.blocks; }), Words{"nested"});
}

// Of those that round a product and its addition once, the technique that rounds both.
TEST(Catalogue, SaysWhatIsFused) {
    std::map<std::string, std::string> unfused;
    for (const CatalogueEntry& entry : glsum::catalogue) {
        if (entry.fused) {
            unfused[std::string(entry.technique)] = entry.unfused;
        } else {
            EXPECT_EQ(entry.unfused, entry.technique) << entry.name;
        }
    }
    unfused.erase("simdfma");  // not of every build
    EXPECT_EQ(unfused, (std::map<std::string, std::string>{{"firfma", "fir"},
                                                           {"hornerfma", "horner"},
                                                           {"hornersplitfma", "hornersplit"},
                                                           {"multifma", "multi"},
                                                           {"oldestfma", "oldest"},
                                                           {"plainfma", "plain"}}));
}

// By what its technique says, whatever its word looks like.
struct Sofma : glsum::Plain {
    static constexpr std::string_view word = "sofma";
};
struct OnceRounded : glsum::Fused<Sofma> {
    static constexpr std::string_view word = "once";
};

TEST(Catalogue, RecognisesNothingByAPartOfAWord) {
    constexpr CatalogueEntry rounds_both = glsum::catalogue_entry<glsum::Sum<glsum::Ring, Sofma, glsum::F32>>();
    EXPECT_EQ(rounds_both.name, "ring_sofma_f32");
    EXPECT_FALSE(rounds_both.fused);
    EXPECT_EQ(rounds_both.unfused, "sofma");
    constexpr CatalogueEntry once = glsum::catalogue_entry<glsum::Sum<glsum::Ring, OnceRounded, glsum::F32>>();
    EXPECT_TRUE(once.fused);
    EXPECT_EQ(once.unfused, "sofma");
}

TEST(Catalogue, SaysWhichNumbersAKernelComputesIn) {
    for (const CatalogueEntry& entry : glsum::catalogue) {
        const std::string format(entry.format);
        EXPECT_EQ(entry.in_double, format == "f64" || format == "f32a64") << entry.name;
        EXPECT_EQ(entry.sample_bytes == 8, format == "f64") << entry.name;
        EXPECT_EQ(entry.sample_bytes == 2, format == "q15" || format == "q15c31") << entry.name;
        EXPECT_EQ(entry.sample_bytes == 4, format == "f32" || format == "f32a64" || format == "q31" || format.empty())
            << entry.name;
        EXPECT_EQ(entry.floating_point, format == "f64" || format == "f32" || format == "f32a64") << entry.name;
        EXPECT_EQ(entry.exact_sums, format == "q31" || format == "q15" || format == "q15c31") << entry.name;
    }
}

TEST(Catalogue, SaysWhereAKernelRunsAndInHowManySteps) {
    for (const CatalogueEntry& entry : glsum::catalogue) {
        const std::string technique(entry.technique);
        EXPECT_EQ(entry.host_only, technique == "simd" || technique == "simdfma") << entry.name;
    }
    glsum::Registry::for_each(
        []<class K>() { EXPECT_EQ(find_kernel(K::name())->in_halves, glsum::InHalves<K>) << K::name(); });
    EXPECT_TRUE(find_kernel("block_plain_q31")->in_halves);
    EXPECT_FALSE(find_kernel("ring_plain_q31")->in_halves);
}

TEST(Catalogue, SaysWhichOrdersAKernelTakes) {
    for (const CatalogueEntry& entry : glsum::catalogue) {
        EXPECT_TRUE(entry.takes_order(0.5)) << entry.name;
        EXPECT_TRUE(entry.takes_order(2.0)) << entry.name;
        EXPECT_FALSE(entry.takes_order(2.1)) << entry.name;
        EXPECT_FALSE(entry.takes_order(-2.0)) << entry.name;
        // Of increments the sum is of order v - 1.
        EXPECT_EQ(entry.takes_order(-1.5), entry.forgotten != Forgotten::increments) << entry.name;
    }
}

}  // namespace
