# One precompiled header for the library, the programs and the tests. A deal.II
# translation unit takes 8 s without it and 2 to 3 s with it (g++ 12); making it
# takes 25 s per build type. Sources include what they use all the same, and
# compile with NMM_PRECOMPILE_HEADERS=OFF.

if(NMM_PRECOMPILE_HEADERS)
  set(_nmm_empty_source "${PROJECT_BINARY_DIR}/precompiled_headers.cc")
  file(CONFIGURE OUTPUT "${_nmm_empty_source}" CONTENT "")
  add_library(nmm_precompiled_headers OBJECT "${_nmm_empty_source}")
  target_link_libraries(nmm_precompiled_headers PRIVATE nmm_options
                                                        nmm::deal_II)
  target_precompile_headers(
    nmm_precompiled_headers
    PRIVATE
    <deal.II/base/array_view.h>
    <deal.II/base/bounding_box.h>
    <deal.II/base/exceptions.h>
    <deal.II/base/function.h>
    <deal.II/base/index_set.h>
    <deal.II/base/mpi.h>
    <deal.II/base/parameter_handler.h>
    <deal.II/base/point.h>
    <deal.II/base/quadrature.h>
    <deal.II/base/quadrature_lib.h>
    <deal.II/base/symmetric_tensor.h>
    <deal.II/base/timer.h>
    <deal.II/dofs/dof_handler.h>
    <deal.II/dofs/dof_tools.h>
    <deal.II/fe/fe_simplex_p.h>
    <deal.II/fe/fe_values.h>
    <deal.II/fe/mapping_fe.h>
    <deal.II/grid/tria.h>
    <deal.II/lac/affine_constraints.h>
    <deal.II/lac/trilinos_sparse_matrix.h>
    <deal.II/lac/trilinos_vector.h>
    <deal.II/non_matching/immersed_surface_quadrature.h>)
endif()

function(nmm_use_precompiled_headers target)
  if(NMM_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} REUSE_FROM nmm_precompiled_headers)
  endif()
endfunction()
