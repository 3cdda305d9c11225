// The firmware's answers from anywhere. The first byte says how many rows are expected.
#include "qemu/emulate/answers.hpp"

#include <sstream>
#include <string>

#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) {
        return 0;
    }
    const std::string text = fuzz::to_text(data + 1, size - 1);
    for (const bool measured : {false, true}) {
        fuzz::refused_or([&] {
            qemu::Answers answers(data[0]);
            std::size_t rows = 0;
            std::istringstream lines(text);
            for (std::string line; std::getline(lines, line);) {
                rows += measured ? answers.take_measured(line).has_value() : answers.take_replayed(line).has_value();
            }
            answers.check_complete();
            fuzz::expect(rows == data[0]);
        });
    }
    return 0;
}
