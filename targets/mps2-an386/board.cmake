# The emulated board of the Cortex-M4: what the Cortex-M7's has, on another core.
set(here ${CMAKE_CURRENT_LIST_DIR}/../mps2-an500)
set(GLSUM_BOARD_PORT ${CMAKE_CURRENT_LIST_DIR}/../cortex-m7/semihosting.cpp ${here}/board.cpp)
set(GLSUM_BOARD_LINK -T ${CMAKE_CURRENT_LIST_DIR}/memory.ld)
set(GLSUM_BOARD_PROGRAMS measure replay selftest model silicon example biquad)
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/emulate)
