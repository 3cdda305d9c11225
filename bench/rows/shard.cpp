#include "bench/rows/shard.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "base/failure.hpp"

namespace bench {

Shard parse_shard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto index = std::from_chars(text.data(), end, shard.index);
    const bool slash = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
    const auto count = slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
    if (!slash || count.ec != std::errc{} || count.ptr != end || shard.index < 1 || shard.index > shard.count ||
        shard.count > Shard::most) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("--shard: expected I/N with 1 <= I <= N <= {}, found {}", Shard::most, text));
    }
    return shard;
}

}  // namespace bench
