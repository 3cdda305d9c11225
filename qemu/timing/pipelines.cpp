#include "qemu/timing/pipelines.hpp"

#include "qemu/timing/cortex_m4/pipeline.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/model.hpp"

namespace timing {

std::unique_ptr<Pipelines> pipelines_of(const CoreFile& core) {
    // All sets are given the delays of the nominal one's memory.
    const std::int64_t longest_fetch = Memory(core.sets[0].figures, core.placement).longest_fetch();
    switch (core.core) {
        case Core::cortex_m4:
            return std::make_unique<PipelinesOf<cortex_m4::Pipeline>>(core, longest_fetch);
        case Core::cortex_m7:
            break;
    }
    return std::make_unique<PipelinesOf<Pipeline>>(core, longest_fetch);
}

}  // namespace timing
