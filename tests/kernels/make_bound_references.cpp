// make_bound_references FOLDER: what bound_references.hpp reads.
#include <cstdio>
#include <exception>

#include "tests/kernels/bound_references.hpp"

int main(int count, char** words) {
    if (count != 2) {
        std::fputs("make_bound_references FOLDER\n", stderr);
        return 2;
    }
    try {
        test::write_bound_references(words[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_bound_references: %s\n", error.what());
        return 1;
    }
    return 0;
}
