#include "bench/run/first_line.hpp"

#include <cstdio>
#include <memory>

namespace bench {

std::string first_line(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    char line[1024] = "";
    if (pipe && std::fgets(line, sizeof line, pipe.get()) == nullptr) {
        return "";
    }
    std::string text(line);
    text.erase(text.find_last_not_of('\n') + 1);
    return text;
}

}  // namespace bench
