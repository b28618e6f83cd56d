# Libraries used inside source files only. None appears in a public header, so a
# program that uses nmm needs none of them to compile. CGAL and Eigen are
# headers only. CGAL is wrapped as system headers without the flag that its own
# target would impose on every source file: source/CMakeLists.txt sets
# -frounding-math where it belongs.

find_package(CGAL 5.5 REQUIRED QUIET)
find_package(Eigen3 3.4 REQUIRED NO_MODULE QUIET)
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(cairo REQUIRED QUIET IMPORTED_TARGET cairo)

# SuiteSparse of Debian 12 has no package file.
find_path(NMM_KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(NMM_KLU_LIBRARY klu REQUIRED)
mark_as_advanced(NMM_KLU_INCLUDE_DIR NMM_KLU_LIBRARY)
add_library(nmm_klu INTERFACE)
target_include_directories(nmm_klu SYSTEM INTERFACE "${NMM_KLU_INCLUDE_DIR}")
target_link_libraries(nmm_klu INTERFACE "${NMM_KLU_LIBRARY}")

add_library(nmm_cgal INTERFACE)
foreach(_property LINK_LIBRARIES COMPILE_DEFINITIONS)
  get_target_property(_value CGAL::CGAL INTERFACE_${_property})
  # Boost comes with deal.II, which must not see a second one.
  list(REMOVE_ITEM _value Boost::boost)
  set_target_properties(nmm_cgal PROPERTIES INTERFACE_${_property} "${_value}")
endforeach()
target_include_directories(
  nmm_cgal SYSTEM
  INTERFACE $<TARGET_PROPERTY:CGAL::CGAL,INTERFACE_INCLUDE_DIRECTORIES>)

# For source files that include CGAL: its interval arithmetic switches the
# rounding mode, which the compiler must be told; and g++ 12 sees uninitialized
# values in its inlined kernels where there are none.
set(NMM_CGAL_FLAGS -frounding-math -Wno-maybe-uninitialized)
