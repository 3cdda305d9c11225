// make_results ROWS FILE.json: a pretended result file of that many rows, to see what the tools make of a large one.
#include <cstdio>
#include <cstdlib>

#include "tests/report/pretend_results.hpp"

int main(int argc, char** argv) {
    const std::size_t rows = argc == 3 ? std::strtoul(argv[1], nullptr, 10) : 0;
    if (rows == 0) {
        std::fprintf(stderr, "make_results: expected ROWS FILE.json\n");
        return 2;
    }
    const bench::Results results = test::pretend_results(rows, 1);
    bench::write_results(argv[2], results.context, results.rows);
}
