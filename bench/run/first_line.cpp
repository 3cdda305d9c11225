#include "bench/run/first_line.hpp"

#include <cstdio>
#include <memory>

namespace bench {

std::string first_line(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    const auto next = [&] { return pipe ? std::fgetc(pipe.get()) : EOF; };
    std::string line;
    for (int c = next(); c != EOF && c != '\n'; c = next()) {
        line += static_cast<char>(c);
    }
    return line;
}

}  // namespace bench
