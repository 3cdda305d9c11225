# A stranger's toolchain file, with nothing of the project's. FPU: the compiler's words for it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FPU)
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-m7 -mthumb ${FPU} -std=c++20 -O2 -Wno-psabi")
