# For a Cortex-M4. GLSUM_FPU: its floating-point unit, `none` or `single`.
set(cpu cortex-m4)
set(fpus "none or single")
set(fpu_single "-mfloat-abi=hard -mfpu=fpv4-sp-d16")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
# A branch to a wide instruction across two words costs a cycle more: loops begin words.
string(APPEND CMAKE_CXX_FLAGS_INIT " -falign-loops=4")
