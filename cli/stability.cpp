// glsum stability: Matignon's theorem on a model.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/failure.hpp"
#include "base/gnuplot.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "drive/pictures.hpp"
#include "drive/stability.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path model;
    double base_order = 0.0;
    Output json;
    std::filesystem::path out;
    std::filesystem::path plot;
};

std::string to_json(const drive::StabilityVerdict& judged) {
    nlohmann::ordered_json json{{"verdict", name_of(judged.verdict)},
                                {"base_order", judged.base_order},
                                {"order_rounding", judged.rounding},
                                {"degree", judged.roots.size()},
                                {"limit_rad", judged.limit_rad},
                                {"unstable_by_roots", judged.unstable_by_roots},
                                {"unstable_by_argument", judged.unstable_by_argument},
                                {"largest_residual", judged.largest_residual}};
    if (std::isfinite(judged.smallest_angle_rad)) {
        json["smallest_angle_rad"] = judged.smallest_angle_rad;
    }
    json["poles"] = nlohmann::ordered_json::array();
    for (const auto& pole : judged.poles) {
        json["poles"].push_back({{"real", pole.real()}, {"imaginary", pole.imag()}});
    }
    return json.dump(2) + "\n";
}

std::string to_text(const drive::StabilityVerdict& judged, const drive::Model& model, const std::string& name) {
    std::string text = fmt::format("{}\n{}: {}\n", name, drive::to_text(model), name_of(judged.verdict));
    text += fmt::format("  {} roots in s^{}; nearest to the positive axis at {:.7g} rad, the limit is {:.7g} rad\n",
                        judged.roots.size(), judged.base_order, judged.smallest_angle_rad, judged.limit_rad);
    text +=
        fmt::format("  inside the limit: {} by roots (largest residual {:.1e}), {} by the argument principle\n",
                    judged.unstable_by_roots, judged.largest_residual,
                    judged.unstable_by_argument < 0 ? "on the axis" : fmt::format("{}", judged.unstable_by_argument));
    if (judged.rounding > 0.0) {
        text += fmt::format("  making the orders multiples of {} changed them by up to {:.2g}\n", judged.base_order,
                            judged.rounding);
    }
    for (const auto& pole : judged.poles) {
        if (pole.imag() >= 0.0) {
            text += fmt::format("  pole {:.6g}{}\n", pole.real(),
                                pole.imag() == 0.0 ? "" : fmt::format(" +- {:.6g} i", pole.imag()));
        }
    }
    return text;
}

void run(const Options& options) {
    const drive::Model model = read_model(options.model);
    const double base_order = options.base_order == 0.0 ? drive::usual_base_order(model) : options.base_order;
    const drive::StabilityVerdict judged = drive::judge_stability(model, base_order);
    put_either(
        options.json, [&] { return to_json(judged); }, [&] { return to_text(judged, model, options.model.string()); },
        options.out);
    if (!options.plot.empty()) {
        base::draw(drive::picture_of_roots(judged, drive::to_text(model)), options.plot);
    }
    if (!judged.agree()) {
        throw glsum::Failure(
            glsum::Exit::check_failed,
            fmt::format("{}: {} unstable poles by roots of the rounded orders, {} by the argument principle on the "
                        "orders as they are: take a smaller base order",
                        options.model.string(), judged.unstable_by_roots, judged.unstable_by_argument));
    }
    if (judged.verdict != drive::Stability::stable) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: {}", options.model.string(), name_of(judged.verdict)));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "A dead time does not change the verdict of an open loop.\n"
        "Example: glsum stability --model drive/models/niopdt.json --plot roots");
    command.add_option("--model", options->model, "Model JSON").required();
    command
        .add_option(
            "--base-order,--q", options->base_order,
            "Base order q: the orders are rounded to its multiples; usually 0.01, and 1 where all orders are whole")
        .within(0, 2);
    options->json.add_to(command, "--json", "All of it");
    command.add_option("--out", options->out, "File; printed if not given");
    command.add_option("--plot", options->plot, "Also draw the roots: STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
