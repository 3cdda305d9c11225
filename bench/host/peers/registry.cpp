// The list of peers; each is one file that defines its function. Only the standard library has a dot product of
// integers.
#include "bench/host/peers/peer.hpp"

namespace bench {

#define GLSUM_PEER(library) std::unique_ptr<F32Dot> make_##library(const std::vector<float>& coefficients);
#include "bench/host/peers/peers.def"
#undef GLSUM_PEER

std::unique_ptr<Q31Dot> make_std_q31(const std::vector<std::int32_t>& coefficients);

const std::vector<Peer>& peers() {
    static const std::vector<Peer> list = {
#define GLSUM_PEER(library) {"peer_" #library "_f32", make_##library},
#include "bench/host/peers/peers.def"
#undef GLSUM_PEER
        {"peer_std_q31", make_std_q31},
    };
    return list;
}

}  // namespace bench
