// A study of records that step, for tests of candidates in it.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/study.hpp"

namespace gap_test {

// 30 s of half-second samples: at rest for 8 of them, then a step.
inline gap::Record stepped(std::size_t rest = 8) {
    gap::Record record;
    record.name = "stepped";
    record.usual_interval_s = 0.5;
    for (std::size_t i = 0; i <= 60; ++i) {
        record.time_s.push_back(0.5 * static_cast<double>(i));
        record.input.push_back(i < rest ? 0.0 : 2.0);
        record.output.push_back(i < rest ? 1.0 : 1.0 + 4.0 * (1.0 - std::exp(-0.25 * static_cast<double>(i - rest))));
    }
    return record;
}

struct Made {
    std::vector<gap::Record> records;
    gap::Study study;
    Made(const drive::Model& model, std::vector<gap::Record> of, bool refit)
        : records(std::move(of)), study{{gap::form_of(model), refit},
                                        gap::scales_of(model, records, {}),
                                        {},
                                        gap::all_count(records),
                                        0.01,
                                        0.004,
                                        0} {
        for (const gap::Record& record : records) {
            study.courses.emplace_back(record, 1);
        }
    }
};

inline drive::Model lag() { return drive::make_fopdt(2.0, 3.0, 0.0); }

}  // namespace gap_test
