#include "tests/kernels/any_kernel.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "glsum/catalogue.hpp"
#include "glsum/registry.hpp"

namespace test {
namespace {

/// `count` elements, `offset` behind the alignment of a cache line, between guards.
template <class T>
class Guarded {
public:
    Guarded(std::size_t count, std::size_t offset)
        : memory_(count + offset + 2 * guard + line, mark), count_(count), offset_(offset + guard + aligned()) {}
    [[nodiscard]] std::span<T> span(std::size_t less = 0) { return std::span(memory_).subspan(offset_, count_ - less); }
    [[nodiscard]] bool hold() const {
        const auto marked = [](const T& element) { return element == mark; };
        const auto begin = memory_.begin() + static_cast<std::ptrdiff_t>(offset_);
        return std::all_of(memory_.begin(), begin, marked) &&
               std::all_of(begin + static_cast<std::ptrdiff_t>(count_), memory_.end(), marked);
    }

private:
    static constexpr T mark = T(77);
    static constexpr std::size_t line = 64 / sizeof(T);
    static constexpr std::size_t guard = 2 * line;

    [[nodiscard]] std::size_t aligned() const {
        const std::size_t past = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(T) % line;
        return past == 0 ? 0 : line - past;
    }

    std::vector<T> memory_;
    std::size_t count_;
    std::size_t offset_;
};

template <class K>
class LineOf final : public AnyLine {
public:
    LineOf(const glsum::Design& buffers, std::size_t offset)
        : table_(glsum::table_needed<K>(buffers), offset), past_(glsum::past_needed<K>(buffers), offset) {
        status_ = LineOf::prepare(buffers, 0, 0);
    }
    [[nodiscard]] glsum::Status status() const override { return status_; }
    glsum::Status prepare(const glsum::Design& design, std::size_t less_table, std::size_t less_past) override {
        return status_ = K::prepare(state_, design, table_.span(less_table), past_.span(less_past));
    }
    void spoil() override {
        constexpr int pattern = 0xa5;
        static_assert(std::is_trivially_copyable_v<typename K::State>);
        std::memset(static_cast<void*>(&state_), pattern, sizeof state_);
        std::memset(static_cast<void*>(table_.span().data()), pattern, table_.span().size_bytes());
        std::memset(static_cast<void*>(past_.span().data()), pattern, past_.span().size_bytes());
    }
    void reset() override { K::reset(state_); }
    double step(double sample) override { return K::to_real(state_, K::step(state_, K::from_real(sample))); }
    [[nodiscard]] double bound(const glsum::Design& design, double peak, std::size_t samples) const override {
        return glsum::error_bound<K>(design, state_, peak, samples);
    }
    [[nodiscard]] bool guards_hold() const override { return table_.hold() && past_.hold(); }

private:
    Guarded<typename K::Coefficient> table_;
    Guarded<typename K::Sample> past_;
    typename K::State state_{};
    glsum::Status status_ = glsum::Status::ok;
};

template <class K>
AnyKernel describe() {
    using Format = typename K::FormatPart;
    return {.name = K::name(),
            .technique = K::TechniquePart::word,
            .dropped = glsum::forgotten_by<typename K::HistoryPart>(),
            .of_window = glsum::catalogue_entry<K>().family == glsum::window_family,
            .fixed_point = Format::fixed_point,
            .smallest_sample = Format::fixed_point
                                   ? 0x1p-31
                                   : static_cast<double>(std::numeric_limits<typename K::Sample>::denorm_min()),
            .order_in_range = [](double order) { return K::order_in_range(order); },
            .make_line = [](const glsum::Design& buffers, std::size_t offset) -> std::unique_ptr<AnyLine> {
                return std::make_unique<LineOf<K>>(buffers, offset);
            }};
}

template <class Null, class... Ks>
std::vector<AnyKernel> describe_all(glsum::KernelList<Null, Ks...>) {
    return {describe<Ks>()...};
}

}  // namespace

const std::vector<AnyKernel>& any_kernels() {
    static const std::vector<AnyKernel> all = describe_all(glsum::Registry{});
    return all;
}

}  // namespace test
