# For a Cortex-M7. GLSUM_FPU: its floating-point unit, `none`, `single` as the STM32F746 has it, or `double`.
# QEMU's Cortex-M7 has double precision: what was made for that would run there and fault on an STM32F746.
set(cpu cortex-m7)
set(fpus "none, single or double")
set(fpu_single "-mfloat-abi=hard -mfpu=fpv5-sp-d16")
set(fpu_double "-mfloat-abi=hard -mfpu=fpv5-d16")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
