#ifndef nmm_source_geometry_arrangement_h
#define nmm_source_geometry_arrangement_h

// Private: CGAL types shared by the sources of geometry and covers. Never
// included from a public header, so that users do not compile CGAL.

#include <nmm/base/types.h>
#include <nmm/geometry/curve.h>

#include <CGAL/Arr_circle_segment_traits_2.h>
#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "geometry/face_measures.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    using Kernel     = CGAL::Exact_predicates_exact_constructions_kernel;
    using BaseTraits = CGAL::Arr_circle_segment_traits_2<Kernel>;

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

    /// The point of the same coordinates: doubles are rationals.
    inline Kernel::Point_2
    exact(const dealii::Point<2> &point)
    {
      return {point[0], point[1]};
    }

    /// The exact curve of a piece; its doubles are exact rationals.
    BaseTraits::Curve_2
    exact_curve(const CurvePiece &piece);

    /**
     * Convert an exact coordinate (a + b sqrt(c)) to the nearest double or a neighbour of it. The
     * relative error is at most 8 epsilon, however close two curves are. CGAL's default error of
     * 1e-5 for lazy numbers would move the corners of slivers.
     */
    double
    to_double(const BaseTraits::Point_2::CoordNT &coordinate);

    dealii::Point<2>
    to_double(const BaseTraits::Point_2 &point);
  } // namespace internal
} // namespace NMM

#endif
