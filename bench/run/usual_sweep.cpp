#include "bench/run/usual_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/failure.hpp"
#include "base/glob.hpp"
#include "bench/host/peers/peer.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/catalogue.hpp"

namespace bench {

Sweep usual_sweep(bool quick) {
    Sweep sweep;
    sweep.signals.assign(std::begin(signal_names), std::end(signal_names));
    std::vector<std::string> taps;
    if (quick) {
        sweep.samples = 1000;
        sweep.orders = {0.5, 0.98319, 1.9909, -0.5};
        sweep.design_errors = {1e-4};
        taps = {"50", "100", "200", "600", "full"};
    } else {
        sweep.samples = 5000;
        sweep.orders = {0.2, 0.3, 0.5, 0.7, 0.9, 0.98319, 1.5, 1.9909, -0.5};
        taps = {"50", "75", "100", "150", "200", "300", "400", "500", "600", "800", "1000", "full"};
    }
    sweep.lengths = lengths_of(taps, sweep.samples);
    return sweep;
}

std::vector<Length> lengths_of(const std::vector<std::string>& words, std::size_t samples) {
    std::vector<Length> lengths;
    for (const std::string& word : words) {
        const auto length = parse_length(word, samples);
        if (!length) {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                fmt::format("--taps: expected a number of at least 1 and at most {}, full, or near taps and "
                            "modes as 2+7, found {}",
                            longest_length, word));
        }
        if (std::none_of(lengths.begin(), lengths.end(),
                         [&](const Length& other) { return other.text() == length->text(); })) {
            lengths.push_back(*length);
        }
    }
    std::stable_sort(lengths.begin(), lengths.end(), [](const Length& a, const Length& b) { return a.taps < b.taps; });
    return lengths;
}

void take_kernels(Sweep& sweep, const std::vector<std::string>& globs) {
    for (const glsum::CatalogueEntry& kernel : glsum::catalogue) {
        if (base::matches_any(globs, std::string(kernel.name))) {
            sweep.kernels.emplace_back(kernel.name);
        }
    }
    std::vector<std::string> wanted = globs;
    if (sweep.repetitions > 1 && sweep.wants("host") && !sweep.kernels.empty()) {
        wanted.insert(wanted.end(), {"peer_std_f32", "peer_eigen_f32", "peer_std_q31"});
    }
    for (const Peer& peer : peers()) {
        if (base::matches_any(wanted, std::string(peer.name))) {
            sweep.peers.emplace_back(peer.name);
        }
    }
}

std::map<std::string, std::vector<std::string>> leave_out_unserved(Sweep& sweep) {
    std::map<std::string, std::vector<std::string>> by_reason;
    std::erase_if(sweep.kernels, [&](const std::string& kernel) {
        const std::string reason = why_not_served(kernel, sweep.weights);
        if (!reason.empty()) {
            by_reason[reason].push_back(kernel);
        }
        return !reason.empty();
    });
    return by_reason;
}

}  // namespace bench
