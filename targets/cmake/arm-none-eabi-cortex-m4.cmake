# For a Cortex-M4. GLSUM_FPU: its floating-point unit, `none` or `single`.
set(cpu cortex-m4)
set(fpus "none or single")
set(fpu_single "-mfloat-abi=hard -mfpu=fpv4-sp-d16")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
