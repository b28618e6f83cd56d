#ifndef nmm_source_geometry_arrangement_h
#define nmm_source_geometry_arrangement_h

// Private: CGAL types shared by the sources of geometry and covers. Never
// included from a public header, so that users do not compile CGAL.

#include <nmm/base/types.h>
#include <nmm/geometry/curve.h>

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arrangement_2.h>

#include "geometry/face_measures.h"
#include "geometry/kernel.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Label of a curve; an arrangement edge has the set of the labels of all curves that overlap
     * there. A label below mesh_edge_flag is a piece of the physical mesh (PhysicalMesh::pieces());
     * otherwise label - mesh_edge_flag is an edge of the mathematical mesh.
     */
    using Label                    = unsigned int;
    constexpr Label mesh_edge_flag = 1u << 31;

    using Traits =
      CGAL::Arr_consolidated_curve_data_traits_2<BaseTraits, Label>;

    struct FaceData
    {
      /// Region of the physical mesh, or invalid_index outside the solid.
      unsigned int region = invalid_index;
      /// Cell of the mathematical mesh; used during the cutting.
      unsigned int cell = invalid_index;
      /// Manifold element; used during the cutting.
      unsigned int element = invalid_index;
    };

    using Dcel        = CGAL::Arr_face_extended_dcel<Traits, FaceData>;
    using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;

    struct PhysicalArrangement
    {
      Arrangement arrangement;
      /// Edges with the solid on at least one side, in doubles.
      std::vector<DirectedEdge> solid_edges;
    };

    /// The exact curve of a piece; its doubles are exact rationals.
    BaseTraits::Curve_2
    exact_curve(const CurvePiece &piece);
  } // namespace internal
} // namespace NMM

#endif
