// The list of peers; each is one file that defines its function.
#include "bench/peers/peer.hpp"

namespace bench {

#define GLSUM_PEER(library) std::unique_ptr<PeerDot> make_##library(const std::vector<float>& coefficients);
#include "bench/peers/peers.def"
#undef GLSUM_PEER

const std::vector<Peer>& peers() {
    static const std::vector<Peer> list = {
#define GLSUM_PEER(library) {"peer_" #library "_f32", make_##library},
#include "bench/peers/peers.def"
#undef GLSUM_PEER
    };
    return list;
}

}  // namespace bench
