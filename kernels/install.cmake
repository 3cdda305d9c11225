# What other projects use: headers, library and the ways to find them. One prefix holds the host's library and, for each floating-point
# unit that a Cortex-M7 or M4 may have, the target's: a build installs the one that it is of.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
include(${CMAKE_CURRENT_SOURCE_DIR}/glsum-flavour.cmake)
glsum_flavour(flavour)

set(package ${CMAKE_INSTALL_DATADIR}/cmake/glsum)
set(libraries ${CMAKE_INSTALL_LIBDIR})
if(NOT flavour STREQUAL "host")
    set(libraries lib/arm-none-eabi/${flavour})
endif()
list(TRANSFORM beside PREPEND glsum_ OUTPUT_VARIABLE targets)
install(TARGETS glsum_kernels ${targets} EXPORT glsum_targets ARCHIVE DESTINATION ${libraries})
install(DIRECTORY glsum DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" PATTERN "*.h" PATTERN "*_arch.hpp" EXCLUDE PATTERN "*_body.hpp" EXCLUDE)

install(EXPORT glsum_targets NAMESPACE glsum:: FILE glsum-${flavour}.cmake DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/glsumConfigVersion.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES glsumConfig.cmake glsum-flavour.cmake ${CMAKE_CURRENT_BINARY_DIR}/glsumConfigVersion.cmake DESTINATION ${package})

# pkg-config: the target's by PKG_CONFIG_LIBDIR=PREFIX/lib/arm-none-eabi/FLAVOUR/pkgconfig.
file(RELATIVE_PATH up /prefix/${libraries}/pkgconfig /prefix)
get_target_property(definitions glsum_kernels INTERFACE_COMPILE_DEFINITIONS)
set(defines "")
if(definitions)
    list(TRANSFORM definitions PREPEND "-D" OUTPUT_VARIABLE defines)
    list(JOIN defines " " defines)
endif()
# describe(PACKAGE DESCRIPTION LINE...)
function(describe package description)
    list(JOIN ARGN "\n" lines)
    file(CONFIGURE OUTPUT ${package}.pc @ONLY CONTENT [=[
prefix=${pcfiledir}/@up@
Name: @package@
Description: @description@ (@flavour@)
Version: @PROJECT_VERSION@
@lines@
]=])
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${package}.pc DESTINATION ${libraries}/pkgconfig)
endfunction()
describe(glsum "Kernels of the Grünwald-Letnikov sum, in C++20"
    "Cflags: -I\${prefix}/${CMAKE_INSTALL_INCLUDEDIR} ${defines}" "Libs: -L\${prefix}/${libraries} -lglsum")
set(what_model "Fractional models and controllers stepped with glsum's kernels")
set(what_design "Tables for glsum's kernels, with certificates")
set(what_filters "Filters for glsum's kernels, fitted to a derivative over a band")
foreach(library IN LISTS beside)
    describe(glsum-${library} ${what_${library}} "Requires: glsum" "Libs: -L\${prefix}/${libraries} -lglsum_${library}")
endforeach()
