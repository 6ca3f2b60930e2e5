# SPDX-License-Identifier: MIT
# Install rules, the CMake package and the pkg-config file.
include(CMakePackageConfigHelpers)

set(jointcal_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/jointcal)
install(TARGETS jointcal EXPORT jointcalTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/jointcal DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT jointcalTargets NAMESPACE jointcal:: DESTINATION ${jointcal_package_dir})

configure_package_config_file(tools/cmake/jointcalConfig.cmake.in ${PROJECT_BINARY_DIR}/jointcalConfig.cmake
                              INSTALL_DESTINATION ${jointcal_package_dir})
# Before 1.0 a minor version may change the API.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/jointcalConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/jointcalConfig.cmake ${PROJECT_BINARY_DIR}/jointcalConfigVersion.cmake
        DESTINATION ${jointcal_package_dir})

configure_file(tools/cmake/jointcal.pc.in ${PROJECT_BINARY_DIR}/jointcal.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/jointcal.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
