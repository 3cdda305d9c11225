// The paper's three plants, (10) to (12), for tests.
#pragma once

#include "drive/model.hpp"

namespace plants {

inline drive::Model fopdt() { return drive::make_fopdt(1.0, 0.4934, 1.2279); }
inline drive::Model sopdt() { return drive::make_sopdt(1.0, 0.319, 1.064); }
inline drive::Model niopdt() {
    drive::Model model;
    model.kind = drive::Kind::niopdt;
    model.denominator = {{0.18234, 1.9909}, {0.65536, 0.98319}, {0.9992, 0.0}};
    model.delay_s = 1.0;
    return model;
}

}  // namespace plants
