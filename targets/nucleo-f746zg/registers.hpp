// The registers that the board's port uses. [RM0385; ARMv7-M ARM B3.2, C1.8]
#pragma once

#include <cstdint>

namespace stm32f746 {

inline volatile std::uint32_t& at(std::uint32_t address) { return *reinterpret_cast<volatile std::uint32_t*>(address); }
/// Switches a peripheral's clock on and waits until it is: the reading back takes that long.
inline void enable(std::uint32_t register_address, std::uint32_t mask) {
    at(register_address) = at(register_address) | mask;
    const std::uint32_t settled = at(register_address);
    static_cast<void>(settled);
}
constexpr std::uint32_t bit(unsigned number) { return 1U << number; }

namespace rcc {
inline constexpr std::uint32_t cr = 0x40023800;
inline constexpr std::uint32_t pllcfgr = 0x40023804;
inline constexpr std::uint32_t cfgr = 0x40023808;
inline constexpr std::uint32_t ahb1enr = 0x40023830;
inline constexpr std::uint32_t apb1enr = 0x40023840;
}  // namespace rcc
namespace pwr {
inline constexpr std::uint32_t cr1 = 0x40007000;
inline constexpr std::uint32_t csr1 = 0x40007004;
}  // namespace pwr
namespace flash {
inline constexpr std::uint32_t acr = 0x40023C00;
}
namespace gpiod {
inline constexpr std::uint32_t moder = 0x40020C00;
inline constexpr std::uint32_t ospeedr = 0x40020C08;
inline constexpr std::uint32_t afrh = 0x40020C24;
}  // namespace gpiod
namespace usart3 {
inline constexpr std::uint32_t cr1 = 0x40004800;
inline constexpr std::uint32_t brr = 0x4000480C;
inline constexpr std::uint32_t isr = 0x4000481C;
inline constexpr std::uint32_t tdr = 0x40004828;
}  // namespace usart3
namespace core {
inline constexpr std::uint32_t dwt_ctrl = 0xE0001000;
inline constexpr std::uint32_t dwt_cyccnt = 0xE0001004;
inline constexpr std::uint32_t dwt_lar = 0xE0001FB0;
inline constexpr std::uint32_t vtor = 0xE000ED08;
inline constexpr std::uint32_t ccr = 0xE000ED14;
inline constexpr std::uint32_t ccsidr = 0xE000ED80;
inline constexpr std::uint32_t csselr = 0xE000ED84;
inline constexpr std::uint32_t demcr = 0xE000EDFC;
inline constexpr std::uint32_t iciallu = 0xE000EF50;
inline constexpr std::uint32_t dcisw = 0xE000EF60;
inline constexpr std::uint32_t dccisw = 0xE000EF74;
}  // namespace core

}  // namespace stm32f746
