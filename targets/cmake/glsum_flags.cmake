# Flags that every target of the project shares, host and bare metal alike.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()
string(REPLACE "-O2" "-O3" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

option(GLSUM_WERROR "Treat warnings as errors, where the compiler is one that the project is tested with" OFF)
# What a compiler of tomorrow warns of stops nobody who only wants to measure: Debian 12's and 13's are tested.
string(REGEX MATCH "^[0-9]+" GLSUM_COMPILER ${CMAKE_CXX_COMPILER_VERSION})
set(GLSUM_TESTED_COMPILERS GNU-12 GNU-14 Clang-14 Clang-19)
if(NOT "${CMAKE_CXX_COMPILER_ID}-${GLSUM_COMPILER}" IN_LIST GLSUM_TESTED_COMPILERS)
    set(GLSUM_WERROR OFF)
endif()

# restrict: GCC 12 warns of overlapping copies inside its own std::string (its bug 105329). dangling-reference: GCC 14 takes what a
# function finds in a table for a part of the name that it was asked for.
add_library(glsum_warnings INTERFACE)
target_compile_options(glsum_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-dangling-reference>
    $<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings> $<$<BOOL:${GLSUM_WERROR}>:-Werror>)

# Headers that most files of the host's libraries and tools include, parsed once where a target precompiles them.
set(GLSUM_STD_HEADERS <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <optional> <span> <string> <vector>)

# Code that is not measured and does not compute for long: optimising it as the sums are takes longer than it saves.
set(GLSUM_COLD $<$<CONFIG:Release>:-O1>)
# Code that computes for seconds, in steps that no loop repeats millions of times: fits, simulations.
set(GLSUM_WARM $<$<CONFIG:Release>:-O2>)

# glsum_unite(TARGET [APART FILE...]): its files are compiled some at a time, as one. What they all include, half of the time of a build,
# is read once for each such bundle. APART: files whose own names another file has too, or that take long by themselves.
function(glsum_unite target)
    cmake_parse_arguments(PARSE_ARGV 1 united "" "" "APART")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 10)
    set_source_files_properties(${united_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Peers are measured at their best on this machine, or on one that ends where the vector kernels are told to.
set(peer_machine_sse2 x86-64)
set(peer_machine_avx2 haswell)
set(peer_machine_avx512f skylake-avx512)
set(peer_machine_ native)
if(NOT DEFINED peer_machine_${GLSUM_SIMD_UP_TO})
    message(FATAL_ERROR "GLSUM_SIMD_UP_TO: expected sse2, avx2, avx512f or nothing, found ${GLSUM_SIMD_UP_TO}")
endif()
set(GLSUM_PEER_FLAGS "-O3 -march=${peer_machine_${GLSUM_SIMD_UP_TO}} -ffast-math")

# No product may be fused with its addition unless a kernel's name says so: host and target must agree bit for bit.
set(GLSUM_CONTRACTION -ffp-contract=off)
