#include "drive/fit_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "drive/model_file.hpp"

namespace drive {

std::string to_text(const Fit& fit, const std::string& record, const Indices& indices) {
    std::string text =
        fmt::format("{}\n\n{:<16} {:>14} {:>32}\n", to_text(fit.model), "parameter", "estimate", "95 % interval");
    for (const Estimate& estimate : fit.parameters) {
        if (!estimate.fixed) {
            text += fmt::format("{:<16} {:>14.7g} {:>16.7g} {:>15.7g}\n", estimate.name, estimate.value, estimate.low,
                                estimate.high);
        } else if (estimate.name != "offset" || estimate.value != 0.0) {
            text += fmt::format("{:<16} {:>14.7g} {:>32}\n", estimate.name, estimate.value, "fixed");
        }
    }
    if (fit.free_names.size() > 1) {
        text += "\ncorrelation     ";
        for (const std::string& name : fit.free_names) {
            text += fmt::format(" {:>8.8}", name);
        }
        for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
            text += fmt::format("\n{:<16}", fit.free_names[static_cast<std::size_t>(i)]);
            for (Eigen::Index j = 0; j <= i; ++j) {
                text += fmt::format(" {:>8.3f}", fit.correlation(i, j));
            }
        }
        text += "\n";
    }
    text += fmt::format(
        "\nsum of squares {:.6g}, residuals {:.4g}{}, lag one {:.3f}; fit (NRMSE) {:.2f} % on {}\n{} iterations: {}",
        fit.sum_of_squares, fit.noise_deviation,
        fit.noise_model.empty() ? "" : fmt::format(" after whitening by AR({})", fit.noise_model.size()), fit.lag_one,
        100.0 * indices.nrmse_fit, record, fit.iterations, fit.stopped);
    text += fit.starts == 1 ? "\n" : fmt::format("; {} of {} starts end here\n", fit.starts_that_agree, fit.starts);
    return text;
}

std::string to_json(const Fit& fit, const std::string& record, const Indices& indices) {
    using Json = nlohmann::ordered_json;
    Json json{{"model", Json::parse(to_json(fit.model))}, {"offset", fit.offset}};
    json["parameters"] = Json::array();
    for (const Estimate& estimate : fit.parameters) {
        Json row{{"name", estimate.name}, {"value", estimate.value}, {"fixed", estimate.fixed}};
        if (!estimate.fixed) {
            row["deviation"] = estimate.deviation;  // infinite becomes null
            row["interval"] = {estimate.low, estimate.high};
        }
        json["parameters"].push_back(row);
    }
    Json correlation = Json::array();
    for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
        correlation.push_back(std::vector<double>(fit.correlation.row(i).begin(), fit.correlation.row(i).end()));
    }
    json["correlation"] = {{"names", fit.free_names}, {"matrix", correlation}};
    json["sum_of_squares"] = fit.sum_of_squares;
    json["noise_deviation"] = fit.noise_deviation;
    json["noise_model"] = fit.noise_model;
    json["lag_one"] = fit.lag_one;
    json["iterations"] = fit.iterations;
    json["stopped"] = fit.stopped;
    json["starts"] = fit.starts;
    json["starts_that_agree"] = fit.starts_that_agree;
    json["nrmse_fit"] = indices.nrmse_fit;
    json["nrmse_of"] = record;
    json["warnings"] = fit.warnings;
    return json.dump(2) + "\n";
}

}  // namespace drive
