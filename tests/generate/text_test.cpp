// Words of C: places that are filled, names, literals that read back to the same bits, and tables of them.
#include "bench/texts/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/generate/literals.hpp"
#include "bench/texts/guards.hpp"
#include "tests/generate/text_of_header.hpp"
#include "tests/refusal.hpp"

namespace {

using generate::literal;
using generate::Places;

std::string refused_by_fill(const std::string& text) {
    try {
        (void)generate::fill(text, Places{{"x", "1"}});
    } catch (const std::out_of_range& found) {
        return found.what();
    }
    return "";
}

TEST(Text, APlaceIsFilledAndAllElseStays) {
    const Places places{{"x", "1"}, {"long name", "@22@"}, {"", "none"}};
    EXPECT_EQ(generate::fill("a @x@b@long name@@x@ c", places), "a 1b@22@1 c");
    EXPECT_EQ(generate::fill("@x@", places), "1");
    EXPECT_EQ(generate::fill("@@", places), "none");
    EXPECT_EQ(generate::fill("no place", places), "no place");
    EXPECT_EQ(generate::fill("", places), "");
    EXPECT_EQ(refused_by_fill("a @y@ b"), "no such place: y");
    EXPECT_EQ(refused_by_fill("a @x@ b @x c"), "a place without an end: @x c");
    EXPECT_EQ(refused_by_fill("a @x@ b"), "");
}

TEST(Text, WordsAreReplacedAndWhatReplacesThemStays) {
    EXPECT_EQ(generate::replaced("aXbXX", "X", "XX"), "aXXbXXXX");
    EXPECT_EQ(generate::replaced("*/ and */", "*/", "* /"), "* / and * /");
    EXPECT_EQ(generate::replaced("abcabc", "abc", "d"), "dd");
    EXPECT_EQ(generate::replaced("abc", "x", "y"), "abc");
    EXPECT_EQ(generate::upper("own_f32_Past"), "OWN_F32_PAST");
    EXPECT_EQ(generate::licence_line("MIT"), "Licence: MIT.\n");
    EXPECT_EQ(generate::licence_line(""), "");
}

// The vectors of FNV-1a's authors for 64 bits, and a byte above 127, which is taken without a sign.
TEST(Text, AFingerprintIsAHashOfItsBytes) {
    EXPECT_EQ(generate::fingerprint(""), "CBF29CE484222325");
    EXPECT_EQ(generate::fingerprint("a"), "AF63DC4C8601EC8C");
    EXPECT_EQ(generate::fingerprint("foobar"), "85944171F73967E8");
    EXPECT_EQ(generate::fingerprint("\xFF"), "AF64724C8602EB6E");
}

TEST(Text, AnIdentifierIsOneOfCWithRoomBehindIt) {
    for (const char* word : {"a", "_", "Z9", "a_1", "x0"}) {
        EXPECT_TRUE(generate::is_identifier(word)) << word;
    }
    for (const char* word : {"", "9", "9a", "a-b", "a b", "a.b", "\xC3\xA4", "a@", "a[", "a`", "a/"}) {
        EXPECT_FALSE(generate::is_identifier(word)) << word;
    }
    EXPECT_TRUE(generate::is_identifier(std::string(60, 'a')));
    EXPECT_FALSE(generate::is_identifier(std::string(61, 'a')));
}

TEST(Text, APrefixOfAFileHasRoomBehindItToo) {
    EXPECT_EQ(generate::prefix_of_file("folder.d/sum.v2.h"), "sum_v2");
    EXPECT_EQ(generate::prefix_of_file(std::string(60, 'a') + ".h"), std::string(60, 'a'));
    EXPECT_EQ(generate::prefix_of_file(std::string(61, 'a') + ".h"), "glsum_" + std::string(54, 'a'));
    EXPECT_EQ(generate::prefix_of_file("9.h"), "glsum_9");
}

TEST(Literals, OfSinglePrecisionEndAtItsLargest) {
    EXPECT_EQ(generate::float_literal(1.0), "1.0F");
    EXPECT_EQ(generate::float_literal(-0.1), "-0.1F");
    EXPECT_EQ(generate::float_literal(1e30), "1e+30F");
    const double most = std::numeric_limits<float>::max();
    for (const double beyond : {most, 2.0 * most, std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(std::strtof(generate::float_literal(beyond).c_str(), nullptr), std::numeric_limits<float>::max());
        EXPECT_EQ(std::strtof(generate::float_literal(-beyond).c_str(), nullptr), -std::numeric_limits<float>::max());
    }
}

// In C a number without a point or an exponent would be an integer.
TEST(Literals, ReadBackToTheSameBits) {
    EXPECT_EQ(literal(1.0), "1.0");
    EXPECT_EQ(literal(-2.0F), "-2.0F");
    EXPECT_EQ(literal(0.5), "0.5");
    EXPECT_EQ(literal(0.5F), "0.5F");
    EXPECT_EQ(literal(1e300), "1e+300");
    for (const double value : {0.1, 1.0 / 3.0, 1e-320, -123456789.125}) {
        EXPECT_EQ(std::strtod(literal(value).c_str(), nullptr), value);
    }
    EXPECT_EQ(literal(std::int32_t{-7}), "-7");
    EXPECT_EQ(literal(std::int32_t{INT32_MAX}), "2147483647");
    EXPECT_EQ(literal(std::int32_t{INT32_MIN + 1}), "-2147483647");
    // 2147483648 is no int, and so is its negation none.
    EXPECT_EQ(literal(std::int32_t{INT32_MIN}), "INT32_MIN");
    EXPECT_EQ(literal(std::uint32_t{0xAB}), "0x000000ABU");
    EXPECT_EQ(literal(std::uint64_t{0xAB}), "UINT64_C(0x00000000000000AB)");
    const std::array<std::int32_t, 3> numbers = {1, -2, 3};
    EXPECT_EQ(generate::literals(std::span<const std::int32_t>(numbers)), (std::vector<std::string>{"1", "-2", "3"}));
}

TEST(Literals, TypesAreThoseOfC) {
    EXPECT_STREQ(generate::c_type<double>(), "double");
    EXPECT_STREQ(generate::c_type<float>(), "float");
    EXPECT_STREQ(generate::c_type<std::uint64_t>(), "uint64_t");
    EXPECT_STREQ(generate::c_type<std::uint32_t>(), "uint32_t");
    EXPECT_STREQ(generate::c_type<std::int64_t>(), "int64_t");
    EXPECT_STREQ(generate::c_type<std::int32_t>(), "int32_t");
    EXPECT_STREQ(generate::c_type<std::int16_t>(), "int16_t");
}

// Of 118 letters, the end of the line included, the margin takes four and each number a comma and a space between.
TEST(Literals, ATableHasAsManyNumbersALineAsItHolds) {
    const auto table = [](const std::vector<std::string>& numbers) {
        return generate::array("float", "own_table", numbers);
    };
    EXPECT_EQ(table({"1.0F"}), "static const float own_table[1] = {\n    1.0F,\n};");
    EXPECT_EQ(table({"1", "2", "3"}), "static const float own_table[3] = {\n    1, 2, 3,\n};");
    const std::string wide(100, '7');
    const std::string fits(10, '8');
    const std::string does_not(11, '9');
    EXPECT_EQ(std::string("    " + wide + ", " + fits + ",\n").size(), 118U);
    EXPECT_EQ(table({wide, fits, "1"}),
              "static const float own_table[3] = {\n    " + wide + ", " + fits + ",\n    1,\n};");
    EXPECT_EQ(table({wide, does_not, "1"}),
              "static const float own_table[3] = {\n    " + wide + ",\n    " + does_not + ", 1,\n};");
}

TEST(Guards, AHeaderMayBeIncludedAgainButNoOtherOfItsName) {
    const base::Scratch folder;
    const auto write = [&](const char* file, const char* design, const char* identity) {
        generate::write_file(folder.file(file),
                             generate::include_guard("own_f32", design, identity) + "int own = 1;\n#endif\n");
    };
    write("own.h", "order 0.5", "00FF");
    write("same.h", "order 0.5", "00FF");
    write("other.h", "order 0.7", "00FE");
    const auto include = [&](const std::string& second) {
        generate::write_file(folder.file("two.c"), "#include \"own.h\"\n#include \"" + second + "\"\n");
        generate::compile("cc -std=c99 -fsyntax-only '" + folder.file("two.c").string() + "'", "cc");
    };
    EXPECT_NO_THROW(include("own.h"));
    EXPECT_NO_THROW(include("same.h"));
    const std::string refused = test::refusal(glsum::Exit::check_failed, [&] { include("other.h"); });
    EXPECT_TRUE(test::says(refused, "own_f32 was included before as: order 0.5"));
    EXPECT_TRUE(test::says(refused, "the one of the message above and order 0.7"));
}

// On ARM a float is kept in a register of single precision, where the core has those: bit 2 of __ARM_FP.
TEST(Guards, AProductIsKeptInARegisterOfItsPrecision) {
    const std::string floating = generate::floating_guard("own_f32");
    EXPECT_TRUE(test::says(floating, "(__ARM_FP & 4)"));
    EXPECT_TRUE(test::says(floating, "#define OWN_F32_KEEP(value) __asm__(\"\" : \"+t\"(value))"));
}

}  // namespace
