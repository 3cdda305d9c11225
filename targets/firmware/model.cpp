// model: steps whole models, as a controller would. The host has designed them: factors and tables come as doubles, so
// that no power is taken here. The plugin counts the steps from outside; marks tell the timing model which to time.
//
//   glsum-model-2 <path of the numbers>
//   <kernel> <increments> <half input> <delay> <steps> <first input> <inputs> <input> <constant> <three full scales>
//       <tables> { <factor> <first ratio> <ratios> <first of the modes> <twice their number> } ...
//   one line a row; real numbers as their 64 bits in hex
//
// Numbers: one binary file, float64 little-endian; inputs are repeated. Answers, for `steps` steps and one more on a
// painted stack:
//   row <n> <status> <hash of the outputs> <bytes of stack> <bytes of state> <bytes of coefficients>
#include "cortex-m7/stack.hpp"
#include "glsum/computes_in_double.hpp"
#include "glsum/model/stepper.hpp"
#include "marker.hpp"
#include "plan.hpp"
#include "port.hpp"
#include "shared/output_hash.hpp"

namespace {

// As in measure.cpp: rows of { name, its length, entry } for the host to read.
template <class K, class... Rest>
struct WatchTable {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename glsum::Stepper<K>::Output (*entry)(typename glsum::Stepper<K>::State&,
                                                typename K::Sample) = &glsum::Stepper<K>::step;
    WatchTable<Rest...> rest;
};
template <class K>
struct WatchTable<K> {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename glsum::Stepper<K>::Output (*entry)(typename glsum::Stepper<K>::State&,
                                                typename K::Sample) = &glsum::Stepper<K>::step;
};
template <class... Ks>
constexpr WatchTable<Ks...> make_watch_table(glsum::KernelList<Ks...>) {
    return {};
}
using Watched = decltype(make_watch_table(glsum::ModelKernels{}));
static_assert(sizeof(Watched) == 12 * glsum::ModelKernels::count);

constexpr std::size_t buffer_bytes = 512 * 1024;
alignas(64) std::byte table_bytes[buffer_bytes];
alignas(64) std::byte past_bytes[buffer_bytes];
alignas(64) std::byte line_bytes[64 * 1024];
alignas(8) std::byte plan_bytes[64 * 1024];
alignas(8) std::byte number_bytes[1024 * 1024];

template <class T>
std::span<T> as(std::span<std::byte> bytes) {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
}

struct Row {
    std::string_view kernel;
    glsum::ModelDesign design;
    glsum::PastTable tables[glsum::most_tables];
    std::size_t steps = 0;
    std::span<const double> input;
};

bool take_real(std::string_view& plan, double& value) {
    std::uint64_t bits = 0;
    const bool whole = firmware::to_number(firmware::take_word(plan), bits, 16);
    value = std::bit_cast<double>(bits);
    return whole;
}

bool take_piece(std::string_view& plan, std::span<const double> numbers, std::span<const double>& piece) {
    std::size_t first = 0;
    std::size_t count = 0;
    const bool whole = firmware::to_number(firmware::take_word(plan), first) &&
                       firmware::to_number(firmware::take_word(plan), count) && first <= numbers.size() &&
                       count <= numbers.size() - first;
    piece = whole ? numbers.subspan(first, count) : numbers.first(0);
    return whole;
}

// Of all rows that are read: a row's tables point here until the next row is.
glsum::Mode read_modes[glsum::most_tables][firmware::most_modes];

bool take_modes(std::string_view& plan, std::span<const double> numbers, std::span<glsum::Mode> room,
                std::span<const glsum::Mode>& modes) {
    std::span<const double> piece;
    if (!take_piece(plan, numbers, piece) || piece.size() % 2 != 0 || piece.size() / 2 > room.size()) {
        return false;
    }
    for (std::size_t m = 0; m < piece.size() / 2; ++m) {
        room[m] = {piece[2 * m], piece[2 * m + 1]};
    }
    modes = room.first(piece.size() / 2);
    return true;
}

bool take_model(std::string_view& plan, std::span<const double> numbers, Row& row) {
    row.kernel = firmware::take_word(plan);
    unsigned increments = 0;
    unsigned half_input = 0;
    std::size_t tables = 0;
    const auto word = [&](auto& value) { return firmware::to_number(firmware::take_word(plan), value); };
    if (!word(increments) || !word(half_input) || !word(row.design.delay) || !word(row.steps) ||
        !take_piece(plan, numbers, row.input) || !take_real(plan, row.design.input) ||
        !take_real(plan, row.design.constant) || !take_real(plan, row.design.input_full_scale) ||
        !take_real(plan, row.design.stored_full_scale) || !take_real(plan, row.design.output_full_scale) ||
        !word(tables) || tables > glsum::most_tables || row.input.empty()) {
        return false;
    }
    for (std::size_t i = 0; i < tables; ++i) {
        if (!take_real(plan, row.tables[i].factor) || !take_piece(plan, numbers, row.tables[i].ratios) ||
            !take_modes(plan, numbers, read_modes[i], row.tables[i].modes)) {
            return false;
        }
    }
    row.design.increments = increments != 0;
    row.design.half_input = half_input != 0;
    row.design.tables = {row.tables, tables};
    return true;
}

template <class K>
void run_row(const Row& row, firmware::Answer& answer) {
    using Stepper = glsum::Stepper<K>;
    static typename Stepper::State state;
    const glsum::Status status =
        Stepper::prepare(state, row.design, as<typename K::Coefficient>(table_bytes),
                         as<typename K::Sample>(past_bytes), as<typename K::Sample>(line_bytes));
    answer.number(static_cast<unsigned>(status));
    if (status != glsum::Status::ok) {
        return;
    }
    firmware::OutputHash hash;
    const auto input = [&](std::size_t k) { return Stepper::from_real(row.design, row.input[k % row.input.size()]); };
    {
        firmware::Marker marker(firmware::timed_steps(row.steps, glsum::computes_in_double<K>()));
        for (std::size_t k = 0; k < row.steps; ++k) {
            const auto next = input(k);
            marker.before(k);
            hash.add(Stepper::step(state, next));
        }
    }
    const auto last = input(row.steps);
    typename Stepper::Output output;
    const std::size_t stack = cortex_m7::stack_bytes([&] { output = Stepper::step(state, last); });
    hash.add(output);
    std::size_t coefficients = 0;
    std::size_t samples = Stepper::line_count(row.design.delay);
    for (const glsum::PastTable& table : row.design.tables) {
        coefficients += Stepper::table_count(table);
        samples += Stepper::past_count(table);
    }
    answer.number(hash.value(), 16);
    answer.number(stack);
    answer.number(sizeof state + samples * sizeof(typename K::Sample));
    answer.number(coefficients * sizeof(typename K::Coefficient));
}

}  // namespace

extern "C" {
extern const Watched glsum_watched;
extern const std::uint32_t glsum_watched_count;
constinit const Watched glsum_watched = make_watch_table(glsum::ModelKernels{});
const std::uint32_t glsum_watched_count = glsum::ModelKernels::count;
}

int firmware_main() {
    asm volatile("" ::"r"(&glsum_watched), "r"(&glsum_watched_count));  // or the linker would drop them
    std::string_view command = port::command_line();
    firmware::take_word(command);
    const auto plan_file = port::read_file(firmware::take_word(command), plan_bytes);
    std::string_view plan{reinterpret_cast<const char*>(plan_file.data()), plan_file.size()};
    if (firmware::take_word(plan) != "glsum-model-2") {
        port::write("error: no plan of the form glsum-model-2\n");
        return 2;
    }
    const auto numbers = as<double>(port::read_file(firmware::take_word(plan), number_bytes));
    std::size_t number = 0;
    for (; !plan.empty(); ++number) {
        Row row;
        if (!take_model(plan, numbers, row)) {
            port::write("error: the plan has a damaged row\n");
            return 2;
        }
        firmware::Answer answer("row");
        answer.number(number);
        bool found = false;
        glsum::ModelKernels::for_each([&]<class K>() {
            if (K::name() == row.kernel) {
                found = true;
                run_row<K>(row, answer);
            }
        });
        if (!found) {
            port::write("error: the plan names a kernel that this program does not have\n");
            return 2;
        }
        answer.write();
    }
    firmware::Answer("end").number(number).write();
    return 0;
}
