#ifndef nmm_source_geometry_face_labels_h
#define nmm_source_geometry_face_labels_h

#include "geometry/arrangement.h"
#include "geometry/face_measures.h"
#include "geometry/loops.h"
#include <unordered_map>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The arrangement of the physical curves with their meaning: which faces are solid, and which
     * curves lie on each edge. It is used to build PhysicalMesh.
     *
     * The interior of a loop is the set of faces that an odd number of crossings of the loop
     * separates from the unbounded face. A face is solid if it is in one boundary loop more than
     * hole loops (an island in a hole is in two and one). No coordinates are compared.
     */
    class LabelledFaces
    {
    public:
      /// An undirected edge of the arrangement.
      struct Edge
      {
        Arrangement::Halfedge_handle halfedge;
        /// Different curves on the edge, ascending.
        std::vector<unsigned int> curves;
        /// A curve that runs along the edge twice, or invalid_index.
        unsigned int repeated_curve = invalid_index;
        /// Faces to the left and right of the halfedge.
        unsigned int left = invalid_index, right = invalid_index;
      };

      struct Face
      {
        Arrangement::Face_handle handle;
        /// Loops in whose interior the face is, ascending.
        std::vector<unsigned int> loops;
        bool                      is_solid = false;
        std::vector<DirectedEdge> boundary;
        double                    area = 0.;
        dealii::Point<2>          inside;
        /// The leftmost point of the boundary; of several ones the lowest.
        dealii::Point<2> corner;
      };

      /**
       * Find all edges and faces. FaceData::element and ::cell are used during the construction and
       * reset. @throws InputError for loops that cross or overlap themselves, a hole outside its
       * domain, and overlapping domains or holes.
       */
      LabelledFaces(Arrangement                     &arrangement,
                    const std::vector<Curve>        &curves,
                    const std::vector<CurvePiece>   &pieces,
                    const std::vector<unsigned int> &piece_to_curve,
                    const Loops                     &loops);

      /// The unbounded face, then all bounded ones.
      const std::vector<Face> &
      faces() const;

      const std::vector<Edge> &
      edges() const;

      /// The edge in doubles.
      DirectedEdge
      geometry(const Edge &edge) const;

      /// Whether the face is in the solid; false for the unbounded one.
      bool
      is_solid(unsigned int face) const;

    private:
      void
      number_faces(Arrangement &arrangement);
      void
      collect_edges(Arrangement &arrangement);
      void
      check_loops_are_simple(Arrangement &arrangement) const;
      void
      find_enclosing_loops();
      void
      measure_faces();
      void
      classify_faces();

      DirectedEdge
      directed(Arrangement::Halfedge_const_handle halfedge) const;

      /// Loops on an edge, which a crossing of the edge enters or leaves.
      std::vector<unsigned int>
      loops_on(const Edge &edge) const;

      const std::vector<Curve>        &curves;
      const std::vector<CurvePiece>   &pieces;
      const std::vector<unsigned int> &piece_to_curve;
      const Loops                     &loops;

      std::vector<Face> all_faces;
      std::vector<Edge> all_edges;
      /// Vertices in doubles, by their address in the arrangement.
      std::unordered_map<const void *, dealii::Point<2>> vertex_locations;
    };
  } // namespace internal
} // namespace NMM

#endif
