// A result file from anywhere: read, grouped, and shown as a table and as CSV.
#include "bench/report/table.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/groups.hpp"
#include "bench/rows/result_file.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::refused_or([&] {
        const bench::Results results = bench::parse_results(fuzz::to_text(data, size), "file");
        (void)bench::to_table(bench::group(results.rows), true);
        (void)bench::to_csv(results.rows);
        // What was taken is written, and taken again, as it was.
        bench::Json file;
        file["context"] = results.context;
        file["benchmarks"] = results.rows;
        const bench::Results again = bench::parse_results(file.dump(), "file");
        fuzz::expect(again.context == results.context && again.rows == results.rows);
    });
    return 0;
}
