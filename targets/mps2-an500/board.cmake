# The emulated board. `emulate` runs a program; CMake makes tests of the firmware by it.
set(GLSUM_BOARD_PORT ${CMAKE_CURRENT_LIST_DIR}/../cortex-m7/semihosting.cpp)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/emulate)
