#include "bench/choose/fared.hpp"

namespace choose {

std::string to_text(Fate fate) {
    switch (fate) {
        case Fate::chosen:
            return "chosen";
        case Fate::runner_up:
            return "runner-up";
        case Fate::dominated:
            return "dominated";
        case Fate::dearer:
            return "dearer";
        case Fate::too_dear:
            return "too dear";
        case Fate::too_large:
            return "too large";
        case Fate::inaccurate:
            return "too inaccurate";
        case Fate::wrong:
            return "wrong";
    }
    return "unknown";
}

}  // namespace choose
