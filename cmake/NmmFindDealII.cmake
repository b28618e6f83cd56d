# Find deal.II and wrap it in the imported target nmm::deal_II: headers as system
# headers, definitions, and the library flavour that fits CMAKE_BUILD_TYPE. Used
# by this project and, installed, by its package configuration, where
# nmm_BUILD_TYPE says which flavour the installed library was built with.
#
# deal_ii_setup_target() is not used, because it also imposes deal.II's own
# warning, optimization and debug flags.

if(NOT DEFINED nmm_BUILD_TYPE)
  set(nmm_BUILD_TYPE ${CMAKE_BUILD_TYPE})
endif()
string(TOUPPER "${nmm_BUILD_TYPE}" _nmm_flavour)

find_package(deal.II 9.4 REQUIRED QUIET HINTS "$ENV{DEAL_II_DIR}")

foreach(_feature MPI TRILINOS TRILINOS_WITH_MUMPS MUPARSER)
  if(NOT DEAL_II_${_feature} AND NOT DEAL_II_WITH_${_feature})
    message(FATAL_ERROR
      "The deal.II in ${DEAL_II_PATH} was built without ${_feature}, which nmm "
      "needs. Debian's package libdeal.ii-dev has it.")
  endif()
endforeach()
if(NOT DEAL_II_BUILD_TYPE MATCHES "${nmm_BUILD_TYPE}")
  message(FATAL_ERROR
    "The deal.II in ${DEAL_II_PATH} has no ${nmm_BUILD_TYPE} library (only "
    "${DEAL_II_BUILD_TYPE}); set CMAKE_BUILD_TYPE accordingly.")
endif()

if(NOT TARGET nmm::deal_II)
  # Some versions do this themselves.
  if(NOT DEAL_II_TARGET_CONFIG_INCLUDED)
    include(${DEAL_II_TARGET_CONFIG})
    set(DEAL_II_TARGET_CONFIG_INCLUDED TRUE)
  endif()

  # Later versions than 9.4 attach all of this to the target; then the variables
  # are empty.
  add_library(nmm::deal_II INTERFACE IMPORTED)
  target_link_libraries(nmm::deal_II
                        INTERFACE ${DEAL_II_TARGET_${_nmm_flavour}})
  target_include_directories(nmm::deal_II SYSTEM
                             INTERFACE ${DEAL_II_INCLUDE_DIRS})
  target_compile_definitions(
    nmm::deal_II INTERFACE ${DEAL_II_USER_DEFINITIONS}
                           ${DEAL_II_USER_DEFINITIONS_${_nmm_flavour}})

  # The instruction set decides the size of VectorizedArray, hence the ABI.
  separate_arguments(
    _nmm_flags UNIX_COMMAND
    "${DEAL_II_CXX_FLAGS} ${DEAL_II_CXX_FLAGS_${_nmm_flavour}}")
  list(FILTER _nmm_flags INCLUDE REGEX "^-m|^-fopenmp")
  target_compile_options(nmm::deal_II INTERFACE ${_nmm_flags})

  # deal.II lists some two hundred libraries; keep those that are called.
  target_link_options(nmm::deal_II INTERFACE LINKER:--as-needed)
endif()
