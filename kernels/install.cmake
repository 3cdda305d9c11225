# `find_package(glsum)` for other projects: the library, its headers, target glsum::kernels.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
install(TARGETS glsum_kernels EXPORT glsum_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY glsum DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" PATTERN "*.h" PATTERN "simd_dot_arch.hpp" EXCLUDE)
install(EXPORT glsum_targets NAMESPACE glsum:: FILE glsumConfig.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/glsum)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/glsumConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/glsumConfigVersion.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/glsum)
