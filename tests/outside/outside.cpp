// A stranger's program: the half derivative of a step in three kernels, and a model that integrates by half an order,
// told to the bit. Exit 0 where it is the closed form.
#include <bit>
#include <cstdint>
#include <glsum/model/stepper.hpp>
#include <glsum/registry.hpp>
#include <glsum/weights.hpp>
#include <string_view>

void say(const char* line);

namespace {

void say_bits(std::string_view name, std::uint32_t bits) {
    char line[64] = {};
    char* at = line;
    for (const char letter : name) {
        *at++ = letter;
    }
    *at++ = ' ';
    for (int shift = 28; shift >= 0; shift -= 4) {
        *at++ = "0123456789abcdef"[(bits >> shift) & 15U];
    }
    *at++ = '\n';
    say(line);
}

// Gamma(k + 1/2) / (Gamma(1/2) k!) at k = 50
constexpr double expected = 0.0795892373871787;

template <class Kernel>
bool is_right(glsum::Line<Kernel, 600>& line, double level) {
    if (line.prepare({.order = 0.5, .taps = 51}) != glsum::Status::ok) {
        return false;
    }
    auto sum = line.step(Kernel::from_real(level));
    for (int k = 1; k <= 50; ++k) {
        sum = line.step(Kernel::from_real(level));
    }
    static_assert(sizeof sum == 4);
    say_bits(Kernel::name(), std::bit_cast<std::uint32_t>(sum));
    const double off = Kernel::to_real(line.state(), sum) - level * expected;
    return off < 1e-6 && off > -1e-6;
}

// D^0.5 y = u, h = 1, u = 1 from the start: y_k = Gamma(k + 1/2) / (Gamma(3/2) (k - 1)!) = 2 k times what is expected
// above.
bool model_is_right() {
    using Model = glsum::Stepper<glsum::ring_plain_f32>;
    static double ratios[50];
    static float table[50];
    static float past[50];
    static float line[1];
    static Model::State state;
    glsum::Weights weights(0.5);
    weights.next();
    const double first = weights.weight();
    for (double& ratio : ratios) {
        weights.next();
        ratio = weights.weight() / first;
    }
    const glsum::PastTable one{.factor = first, .ratios = ratios};
    glsum::ModelDesign design;
    design.increments = false;
    design.tables = {&one, 1};
    if (Model::prepare(state, design, table, past, line) != glsum::Status::ok) {
        return false;
    }
    float output = 0.0F;
    for (int k = 0; k <= 50; ++k) {  // what comes acts from the next sample on
        output = Model::step(state, 1.0F);
    }
    say_bits("model", std::bit_cast<std::uint32_t>(output));
    const double off = static_cast<double>(output) / 100.0 - expected;
    return off < 1e-6 && off > -1e-6;
}

glsum::Line<glsum::ring_plain_f32, 600> newest_first;
glsum::Line<glsum::mirror_multi_f32, 600> in_turn;
glsum::Line<glsum::mirror_multi_q31, 600> words;

}  // namespace

int main() {
    return is_right(newest_first, 1.0) && is_right(in_turn, 1.0) && is_right(words, 0.5) && model_is_right() ? 0 : 1;
}
