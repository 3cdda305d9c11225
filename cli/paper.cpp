// glsum paper: what of [Matusiak2020] can be checked, with our number beside it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/build_info.hpp"
#include "base/gnuplot.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "drive/paper.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path models = std::filesystem::path(build_info::source_folder) / "drive" / "models";
    Output json;
    std::filesystem::path out;
    std::filesystem::path plots;
};

const char* word_for(drive::Holds holds) {
    switch (holds) {
        case drive::Holds::yes:
            return "holds";
        case drive::Holds::no:
            return "does not hold";
        case drive::Holds::with_reservation:
            break;
    }
    return "with a reservation";
}

struct Found {
    drive::PaperValue value;
    std::vector<drive::Precision> precisions;
    std::vector<drive::Claim> claims;
};

std::string to_json(const Found& found) {
    nlohmann::ordered_json json{{"niopdt_5_s", found.value.without_delay},
                                {"niopdt_5_s_with_delay", found.value.with_delay}};
    for (const auto& precision : found.precisions) {
        json["precisions"].push_back(
            {{"how", precision.how}, {"after_5_s", precision.after_5_s}, {"error_max", precision.largest_error}});
    }
    for (const auto& claim : found.claims) {
        json["claims"].push_back(
            {{"claim", claim.claim}, {"paper", claim.paper}, {"ours", claim.ours}, {"verdict", word_for(claim.holds)}});
    }
    return json.dump(2) + "\n";
}

std::string to_text(const Found& found) {
    std::string text =
        fmt::format("Model (12), unit step, at 5 s: {} without its dead time, {} with it\n\n{:<54} {:>10} {:>14}\n",
                    found.value.without_delay, found.value.with_delay, "stepped at h = 1 ms, full memory unless said",
                    "at 5 s", "largest error");
    for (const auto& precision : found.precisions) {
        text +=
            fmt::format("{:<54} {:>10.5f} {:>14.2e}\n", precision.how, precision.after_5_s, precision.largest_error);
    }
    for (const auto& claim : found.claims) {
        text += fmt::format("\n{}: {}\n", claim.claim, word_for(claim.holds));
        text += claim.paper.empty() ? "" : fmt::format("  paper: {}\n", claim.paper);
        text += fmt::format("  here:  {}\n", claim.ours);
    }
    return text;
}

void run(const Options& options) {
    const drive::PaperModels models{read_model(options.models / "fopdt.json"),
                                    read_model(options.models / "sopdt.json"),
                                    read_model(options.models / "niopdt.json")};
    const Found found{drive::value_at_5_s(models.niopdt), drive::compare_precisions(models.niopdt),
                      drive::check_paper(models)};
    put_either(
        options.json, [&] { return to_json(found); }, [&] { return to_text(found); }, options.out);
    if (!options.plots.empty()) {
        base::draw(drive::picture_of_step_responses(models), options.plots / "step_responses");
        base::draw(drive::picture_of_precisions(models.niopdt), options.plots / "precision");
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer("Example: glsum paper --plots results/drive");
    command.add_option("--models", options->models, "Folder with fopdt.json, sopdt.json and niopdt.json")
        .default_str("drive/models");
    options->json.add_to(command, "--json", "All of it");
    command.add_option("--out", options->out, "File; printed if not given");
    command.add_option("--plots", options->plots, "Folder for step_responses and precision, .svg and .png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
