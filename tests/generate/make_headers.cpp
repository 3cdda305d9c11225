// make_headers FOLDER: every kernel that can be generated, at several orders and lengths, as headers, and all.c, which
// includes them all for targets/firmware/verify.cpp and tests/generate/main.c, which run their self-checks.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "bench/generate/header.hpp"
#include "bench/sweep/designs.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "make_headers: expected a folder\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    struct Case {
        double order;
        std::size_t taps;
    };
    // Orders that a kernel does not take are left out. Each kind of scale and shift (v < 0, 0 < v <= 1, 1 < v), no past
    // at all, groups of four and their rests: three of them for a kernel, the other three for the next, which has its
    // technique or its format.
    const Case cases[] = {{0.5, 1}, {1.9909, 2}, {0.98319, 40}, {-0.5, 101}, {0.5, 63}, {-1.9, 150}};
    std::string includes;
    std::string calls;
    int number = 0;
    std::size_t turn = 0;
    for (const std::string& kernel : generate::generatable()) {
        ++turn;
        for (std::size_t c = turn % 2; c < std::size(cases); c += 2) {
            const Case& test = cases[c];
            if (!bench::serves(kernel, test.order)) {
                continue;
            }
            const std::string prefix = fmt::format("g{}", number++);
            const std::string file = prefix + ".h";
            std::ofstream out(folder / file);
            out << generate::make_header({.kernel = kernel,
                                          .order = test.order,
                                          .taps = test.taps,
                                          .step_s = 0.001,
                                          .prefix = prefix,
                                          .provenance = {}});
            const std::string format = generate::format_word(kernel);
            includes += fmt::format("#include \"{}\"\n", file);
            calls += fmt::format(
                "    if (number == {0}U) {{\n        static {1}_{2}_instance line;\n"
                "        return {1}_self_check_{2}(&line);\n    }}\n",
                number - 1, prefix, format);
            if (!out.flush()) {
                return 1;
            }
        }
    }
    std::ofstream all(folder / "all.c");
    all << includes << "#ifdef __cplusplus\nextern \"C\" {\n#endif\nextern const unsigned glsum_verified_count;\n"
        << "const unsigned glsum_verified_count = " << number << "U;\nunsigned glsum_verify(unsigned number);\n"
        << "unsigned glsum_verify(unsigned number)\n{\n"
        << calls << "    return 1U;\n}\n"
        << "#ifdef __cplusplus\n}\n#endif\n";
    return all.flush() ? 0 : 1;
}
