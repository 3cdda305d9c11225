#include "cli/blind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "bench/files.hpp"
#include "bench/progress.hpp"
#include "bench/sha256.hpp"
#include "cli/drive_files.hpp"
#include "drive/stand/blind/cases.hpp"
#include "gap/drive/start.hpp"
#include "qemu/failure.hpp"

namespace cli {

void write_blind_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder) {
    if (folder.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "stand --blind: expected --out FOLDER");
    }
    std::error_code error;
    if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: expected a folder that is new or empty, found files in it", folder.string()));
    }
    std::vector<stand::blind::Case> cases;
    {
        bench::Progress progress("blind cases", count);
        cases = stand::blind::make_cases(count, seed, jobs, [&] { progress.advance(); });
    }
    std::vector<stand::blind::Truth> truths;
    for (const stand::blind::Case& made : cases) {
        truths.push_back(made.truth);
    }
    std::filesystem::create_directories(folder, error);
    bench::write_file(folder / "truth.sealed.json", stand::blind::seal(seed, truths));
    const std::string hash = bench::sha256_of(folder / "truth.sealed.json");
    bench::write_file(folder / "truth.sha256", bench::sha256_line(hash, "truth.sealed.json"));
    fmt::print("sha256 of the sealed truth: {}\n", hash);
    std::fflush(stdout);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto place = folder / stand::blind::name_of_case(i + 1);
        std::filesystem::create_directories(place, error);
        bench::write_file(place / "model.json", cases[i].model);
        bench::write_file(place / "train.csv", cases[i].train);
        bench::write_file(place / "validate.csv", cases[i].validate);
    }
    fmt::print("{} cases, seed {}, in {}\n", cases.size(), seed, folder.string());
}

gap::Question blind_question(const std::filesystem::path& folder) {
    const auto logs = [&](const std::string& name) {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".csv" && entry.path().filename().string().starts_with(name)) {
                found.push_back(entry.path());
            }
        }
        std::sort(found.begin(), found.end());
        return read_records(found, {});
    };
    return {gap::form_of(read_model((folder / "model.json").string())),
            false,
            logs("train"),
            logs("validate"),
            std::nullopt,
            gap::Metric::simulation,
            {},
            1};
}

}  // namespace cli
