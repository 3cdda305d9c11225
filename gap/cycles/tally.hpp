// How many secrets of each kind were named, and how sure that is.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace gap::cycles {

class Tally {
public:
    void count(const std::string& kind, bool named);
    /// A line a kind: the share with Clopper and Pearson's 95 % interval.
    [[nodiscard]] std::string to_text() const;

private:
    struct Counts {
        std::size_t named = 0;
        std::size_t all = 0;
    };
    std::map<std::string, Counts> of_;
};

}  // namespace gap::cycles
