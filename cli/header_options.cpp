#include "cli/header_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "base/glob.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/texts/text.hpp"

namespace cli {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

}  // namespace

std::optional<double> input_full_scale(const std::string& format, const std::optional<double>& scale, const char* of) {
    if (!format.empty() && format != "f32" && format != "q31") {
        refuse(fmt::format("--format: expected f32 or q31, found {}", format));
    }
    if (format != "q31") {
        if (scale) {
            refuse("--input-scale: expected --format q31 beside it");
        }
        return std::nullopt;
    }
    if (!scale) {
        refuse(fmt::format("--format q31: expected --input-scale, the full scale of {}", of));
    }
    if (!(*scale > 0.0 && std::isfinite(*scale))) {
        refuse(fmt::format("--input-scale: expected a number above 0, found {}", *scale));
    }
    return scale;
}

std::vector<std::string> named_kernels(const std::string& glob, double order) {
    std::vector<std::string> kernels = generate::generatable();
    std::erase_if(kernels, [&](const std::string& kernel) { return !base::matches(glob, kernel); });
    if (kernels.size() > 1) {
        std::erase_if(kernels, [&](const std::string& kernel) {
            const bool serves = bench::serves(kernel, order);
            if (!serves) {
                fmt::print("{} is left out: it does not take order {}\n", kernel, order);
            }
            return !serves;
        });
    }
    if (kernels.empty()) {
        kernels = {glob};  // make_header says why not
    }
    return kernels;
}

std::size_t to_taps(const std::string& text, const std::string& kernel, double order, std::size_t samples) {
    const auto length = text == "full" ? std::nullopt : bench::parse_length(text, 0);
    if (!length || length->taps > 8000) {
        refuse(
            fmt::format("--taps: expected 1 to 8000 with --kernel, or 2+7 of a kernel with modes or blocks, found {}",
                        text.empty() ? "nothing" : text));
    }
    if (length->modes) {
        const std::vector<std::string> known = generate::generatable();
        const bench::Length written = bench::as_counted(kernel, *length);
        const bench::Length parted = std::find(known.begin(), known.end(), kernel) == known.end()
                                         ? written
                                         : bench::length_of(kernel, order, written.taps, samples);
        if (parted.text() != written.text()) {
            refuse(fmt::format("--taps: {} at order {} with as many coefficients has {}, found {}", kernel, order,
                               parted.text(), text));
        }
        return written.taps;
    }
    return length->taps;
}

generate::Spec to_spec(const HeaderOptions& options, const Budget& budget, const std::string& kernel,
                       std::size_t taps) {
    generate::Spec spec;
    spec.kernel = kernel;
    spec.order = budget.order;
    spec.taps = taps;
    spec.step_s = budget.step_s;
    spec.prefix = !options.prefix.empty() ? options.prefix
                  : options.out.empty()   ? spec.prefix
                                          : generate::prefix_of_file(options.out);
    spec.horizon = samples_of(budget);
    spec.licence = options.licence;
    return spec;
}

}  // namespace cli
