# The emulated board. `emulate` runs a program; CMake makes tests of the firmware by it.
set(GLSUM_BOARD_PORT ${CMAKE_CURRENT_LIST_DIR}/../cortex-m7/semihosting.cpp ${CMAKE_CURRENT_LIST_DIR}/board.cpp)
set(GLSUM_BOARD_LINK -T ${CMAKE_CURRENT_LIST_DIR}/memory.ld)
set(GLSUM_BOARD_PROGRAMS measure replay selftest model silicon example biquad)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/emulate)
