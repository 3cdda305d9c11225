#include "gap/drive/moves.hpp"

#include <cmath>

namespace gap {

std::vector<Move> moves_of(const Record& record, double before, double least) {
    std::vector<Move> moves;
    for (std::size_t i = 0; i < record.size(); ++i) {
        if (std::fabs(record.input[i] - before) > least) {
            moves.push_back({record.time_s[i] - record.time_s.front(), before, record.input[i]});
        }
        before = record.input[i];
    }
    return moves;
}

}  // namespace gap
