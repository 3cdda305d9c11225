// The words that the last stores wrote, and which of them a load meets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace timing {

/// How many of the last stores a load looks back at.
inline constexpr std::size_t stores_watched = 8;

class StoredWords {
public:
    StoredWords() {
        words_.fill(none);
        present_[none % present_.size()] = stores_watched;
    }

    void add(std::uint32_t address) {
        const std::uint32_t word = address >> 2;
        newest_ = (newest_ + stores_watched - 1) % stores_watched;
        --present_[words_[newest_] % present_.size()];
        ++present_[word % present_.size()];
        words_[newest_] = word;
    }

    /// \return bit n: the last store but n wrote the word at the address
    [[nodiscard]] unsigned met_by(std::uint32_t address) const {
        const std::uint32_t word = address >> 2;
        if (present_[word % present_.size()] == 0) {
            return 0;  // most loads
        }
        unsigned met = 0;
        for (std::size_t n = 0; n < stores_watched; ++n) {
            met |= words_[(newest_ + n) % stores_watched] == word ? 1U << n : 0U;
        }
        return met;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFU;  // no word's number
    std::array<std::uint32_t, stores_watched> words_;   // from `newest_` on, the newest first
    std::size_t newest_ = 0;
    std::array<std::uint8_t, 256> present_{};  // how many of the words have these low bits
};

}  // namespace timing
