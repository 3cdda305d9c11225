// Shards from anywhere: texts divided by a zero byte, merged.
#include <string>
#include <utility>
#include <vector>

#include "bench/rows/merge.hpp"
#include "bench/rows/shard.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string all = fuzz::to_text(data, size);
    fuzz::refused_or([&] { (void)bench::parse_shard(all); });
    fuzz::refused_or([&] {
        std::vector<bench::NamedResults> shards;
        std::size_t rows = 0;
        for (std::size_t begin = 0; begin <= all.size() && shards.size() < 4;) {
            const std::size_t end = std::min(all.find('\0', begin), all.size());
            const std::string name = "shard " + std::to_string(shards.size());
            shards.push_back({name, bench::parse_results(all.substr(begin, end - begin), name)});
            rows += shards.back().results.rows.size();
            begin = end + 1;
        }
        const bool mixed = size % 2 == 1;
        const bench::Results merged = bench::merge(std::move(shards), mixed);
        fuzz::expect(merged.rows.size() == rows && !merged.context.contains("shard"));
    });
    return 0;
}
