#include "bench/host/benchmark_run.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <sstream>

#include "base/failure.hpp"
#include "base/progress.hpp"

namespace bench {
namespace {

// Writes what Google Benchmark's own JSON reporter writes, and shows the progress.
class Reporter : public benchmark::JSONReporter {
public:
    explicit Reporter(std::size_t benchmarks) : progress_("host timing", benchmarks) {
        SetOutputStream(&out_);
        SetErrorStream(&errors_);
    }
    void ReportRuns(const std::vector<Run>& runs) override {
        // A variation of counters that are 0, as the coefficients of one tap are, is no number, and NaN no JSON.
        std::vector<Run> finite = runs;
        for (Run& run : finite) {
            std::erase_if(run.counters, [](const auto& counter) { return !std::isfinite(counter.second.value); });
        }
        JSONReporter::ReportRuns(finite);
        if (!runs.empty() && runs.front().run_type != Run::RT_Aggregate) {
            progress_.advance();
        }
    }
    [[nodiscard]] Json json() const { return Json::parse(out_.str()); }

private:
    base::Progress progress_;
    std::ostringstream out_;
    std::ostringstream errors_;
};

// "--benchmark_min_time=0.02" as this Google Benchmark wants it.
std::string with_unit(const std::string& flag) {
#ifdef GLSUM_TIMES_HAVE_UNITS
    const bool bare =
        flag.starts_with("--benchmark_min_time=") && std::isdigit(static_cast<unsigned char>(flag.back()));
    return bare ? flag + "s" : flag;
#else
    return flag;
#endif
}

}  // namespace

void set_benchmark_flags(const std::vector<std::string>& flags) {
    static std::vector<std::string> words;  // Google Benchmark keeps the pointer to the first
    words = {"glsum bench"};
    std::ranges::transform(flags, std::back_inserter(words), with_unit);
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    int count = static_cast<int>(argv.size());
    benchmark::Initialize(&count, argv.data());
    if (count > 1) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: not a flag of Google Benchmark {}", argv[1], "(--benchmark_...)"));
    }
}

Json run_benchmarks(std::size_t benchmarks) {
    Reporter reporter(benchmarks);
    const std::size_t ran = benchmark::RunSpecifiedBenchmarks(&reporter);
    benchmark::ClearRegisteredBenchmarks();
    if (ran == 0) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             "--benchmark_filter: expected to match some timing, found none that it does");
    }
    return reporter.json();
}

}  // namespace bench
