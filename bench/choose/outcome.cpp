#include "bench/choose/outcome.hpp"

namespace choose {

std::string to_text(Standing standing) {
    switch (standing) {
        case Standing::chosen:
            return "chosen";
        case Standing::runner_up:
            return "runner-up";
        case Standing::dominated:
            return "dominated";
        case Standing::costlier:
            return "costlier";
        case Standing::too_costly:
            return "too costly";
        case Standing::too_large:
            return "too large";
        case Standing::inaccurate:
            return "too inaccurate";
        case Standing::wrong:
            return "wrong";
    }
    return "unknown";
}

}  // namespace choose
