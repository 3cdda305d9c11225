// What a record takes over from a log.
#include "gap/drive/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drive/log.hpp"

namespace {

TEST(Record, TakesFurtherInputsAndASimulation) {
    drive::Log log;
    log.name = "l.csv";
    log.more_inputs.resize(2);
    for (int i = 0; i < 40; ++i) {
        log.time_s.push_back(0.1 * i);
        log.input.push_back(i < 20 ? 0.0 : 1.0);
        log.output.push_back(i);
        log.more_inputs[0].push_back(2.0 * i);
        log.more_inputs[1].push_back(3.0 * i);
        log.simulated.push_back(i + 0.5);
        log.line.push_back(static_cast<std::size_t>(i + 2));
    }
    const gap::Record record = gap::to_record(log);
    EXPECT_EQ(record.more_inputs, log.more_inputs);
    EXPECT_EQ(record.simulated, log.simulated);
}

}  // namespace
