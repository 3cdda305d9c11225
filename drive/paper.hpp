// What of [Matusiak2020] can be checked without its measurements, claim by claim.
#pragma once

#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "drive/model.hpp"

namespace drive {

/// The three models, (10) to (12).
struct PaperModels {
    Model fopdt;
    Model sopdt;
    Model niopdt;
};

enum class Holds { yes, no, with_reservation };

/// A statement of the paper, what we find, and whether it holds.
struct Claim {
    std::string claim;
    std::string paper;
    std::string ours;
    Holds holds;
};

/// The claims, in the paper's order: stability (Figs. 5 to 7), lengths over 600, the definition of NRMSE, Tables 2 and
/// 3 against the distances between the models, which model is nearest, memory on the F746.
[[nodiscard]] std::vector<Claim> check_paper(const PaperModels& models);

/// Model (12) after 5 s, its dead time excluded and included, with `digits` digits.
struct PaperValue {
    std::string without_delay;
    std::string with_delay;
};
[[nodiscard]] PaperValue value_at_5_s(const Model& niopdt, int digits = 10);

/// Fig. 8: the step responses of the three models.
[[nodiscard]] base::Picture picture_of_step_responses(const PaperModels& models);

/// How (12) ends at h = 1 ms: in single precision in the textbook form, with 600 terms in double, in increments in
/// single precision, exactly.
struct Precision {
    std::string how;
    double after_5_s;  ///< without the dead time
    double largest_error;
};
[[nodiscard]] std::vector<Precision> compare_precisions(const Model& niopdt);
[[nodiscard]] base::Picture picture_of_precisions(const Model& niopdt);

}  // namespace drive
