# GNU Arm toolchain for a Cortex-M7 with a single-precision FPU, as the STM32F746 has it. QEMU's Cortex-M7 has double
# precision too: without -mfpu=fpv5-sp-d16 firmware would run there and fault on the chip.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(GLSUM_CORE_FLAGS "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16")
# Functions begin words of a fetch: else what one costs would move with the sizes of those before it.
set(CMAKE_CXX_FLAGS_INIT "${GLSUM_CORE_FLAGS} -falign-functions=8 -ffunction-sections -fdata-sections -fno-threadsafe-statics -Wno-psabi")
set(CMAKE_ASM_FLAGS_INIT "${GLSUM_CORE_FLAGS}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
