#include "reference/blocks.hpp"

#include <algorithm>

namespace reference {
namespace {

struct Block {
    std::size_t from;
    std::size_t width;
    Real mean;
};

struct Parts {
    std::vector<Real> near;
    std::vector<Block> blocks;
};

Parts parts_of(const glsum::Design& design) {
    const std::size_t near_taps = design.taps - design.blocks.count;
    std::vector<Block> blocks;
    std::size_t end = near_taps;
    for (std::size_t b = 0; b < design.blocks.count; ++b) {
        const std::size_t width = std::size_t{2} << b / design.blocks.per_level;
        blocks.push_back({end, width, Real(0)});
        end += width;
    }
    std::vector<Real> all = weights(design, end);
    for (Block& block : blocks) {
        for (std::size_t j = block.from; j < block.from + block.width; ++j) {
            block.mean += all[j];
        }
        block.mean /= block.width;
    }
    all.resize(near_taps);
    return {std::move(all), std::move(blocks)};
}

}  // namespace

std::vector<Real> block_weights(const glsum::Design& design, std::size_t count) {
    const Parts parts = parts_of(design);
    std::vector<Real> all = parts.near;
    for (const Block& block : parts.blocks) {
        all.insert(all.end(), block.width, block.mean);
    }
    all.resize(count, Real(0));
    return all;
}

Sums block_sums(const glsum::Design& design, std::span<const double> record) {
    const Parts parts = parts_of(design);
    const std::vector<Real> x(record.begin(), record.end());
    std::vector<Real> before = {Real(0)};  // x_0 + ... + x_(i-1)
    for (const Real& sample : x) {
        before.push_back(before.back() + sample);
    }
    Sums result;
    result.reserve(record.size());
    for (std::size_t k = 0; k < record.size(); ++k) {
        Real total = 0;
        for (std::size_t j = 0; j < std::min(parts.near.size(), k + 1); ++j) {
            add_product(total, parts.near[j], x[k - j]);
        }
        for (const Block& block : parts.blocks) {
            if (block.from > k) {
                break;
            }
            const std::size_t newest = k - block.from;
            const Real in_block = before[newest + 1] - before[newest + 1 - std::min(block.width, newest + 1)];
            add_product(total, block.mean, in_block);
        }
        result.emplace_back(total);
    }
    return result;
}

}  // namespace reference
