# `find_package(glsum)`: target glsum::kernels, for the host, a Cortex-M7 or a Cortex-M4, as the project's compiler and flags ask.
include(${CMAKE_CURRENT_LIST_DIR}/glsum-flavour.cmake)
glsum_flavour(glsum_flavour)
file(GLOB glsum_installed RELATIVE ${CMAKE_CURRENT_LIST_DIR} ${CMAKE_CURRENT_LIST_DIR}/glsum-host.cmake ${CMAKE_CURRENT_LIST_DIR}/glsum-cortex-m7-none.cmake
    ${CMAKE_CURRENT_LIST_DIR}/glsum-cortex-m7-single.cmake ${CMAKE_CURRENT_LIST_DIR}/glsum-cortex-m7-double.cmake
    ${CMAKE_CURRENT_LIST_DIR}/glsum-cortex-m4-none.cmake ${CMAKE_CURRENT_LIST_DIR}/glsum-cortex-m4-single.cmake)
string(REGEX REPLACE "glsum-([a-z0-9-]*)\\.cmake" "\\1" glsum_installed "${glsum_installed}")
list(JOIN glsum_installed ", " glsum_installed)
if(NOT glsum_flavour)
    set(glsum_FOUND FALSE)
    set(glsum_NOT_FOUND_MESSAGE
        "expected a compiler for this machine or, in CMAKE_CXX_FLAGS, for a Cortex-M7 or M4 (-mcpu=cortex-m7 -mthumb); installed: ${glsum_installed}")
elseif(NOT EXISTS ${CMAKE_CURRENT_LIST_DIR}/glsum-${glsum_flavour}.cmake)
    set(glsum_FOUND FALSE)
    set(glsum_NOT_FOUND_MESSAGE "the compiler and its flags ask for the library of ${glsum_flavour}; installed: ${glsum_installed}")
else()
    include(${CMAKE_CURRENT_LIST_DIR}/glsum-${glsum_flavour}.cmake)
endif()
