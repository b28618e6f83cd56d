# Installation and find_package(nmm). One prefix holds one flavour, Debug or
# Release, of the library.
include(CMakePackageConfigHelpers)

set(_nmm_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/nmm")

install(
  TARGETS nmm
  EXPORT nmmTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
          NAMELINK_COMPONENT library)
install(
  DIRECTORY include/nmm
  COMPONENT headers
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING
  PATTERN "*.h")
install(
  EXPORT nmmTargets
  NAMESPACE nmm::
  COMPONENT headers
  DESTINATION "${_nmm_cmake_dir}")

configure_package_config_file(
  cmake/nmmConfig.cmake.in "${PROJECT_BINARY_DIR}/nmmConfig.cmake"
  INSTALL_DESTINATION "${_nmm_cmake_dir}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/nmmConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/nmmConfig.cmake"
        "${PROJECT_BINARY_DIR}/nmmConfigVersion.cmake"
        cmake/NmmFindDealII.cmake
  COMPONENT headers
  DESTINATION "${_nmm_cmake_dir}")
install(
  FILES LICENSE README.md
  COMPONENT documentation
  DESTINATION "${CMAKE_INSTALL_DOCDIR}")
