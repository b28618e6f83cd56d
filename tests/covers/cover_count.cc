#include <nmm/covers/cover_system.h>

#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "support/n_samples.h"
#include "support/random_scenes.h"
#include <gtest/gtest.h>
#include <set>

// The number of physical covers of a mathematical cover is the number of pieces
// its support is cut into by the physical curves: here counted a second way, by
// an arrangement of the curves and of the support's outline alone, without any
// mathematical edge inside the support.

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  using Kernel      = CGAL::Exact_predicates_exact_constructions_kernel;
  using Traits      = CGAL::Arr_segment_traits_2<Kernel>;
  using Dcel        = CGAL::Arr_face_extended_dcel<Traits, int>;
  using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;

  Traits::X_monotone_curve_2
  exact(const Point<2> &a, const Point<2> &b)
  {
    return {Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1])};
  }


  /// Crossing-parity of a point well inside a face.
  bool
  contains(
    const std::vector<std::pair<Kernel::Point_2, Kernel::Point_2>> &edges,
    const Kernel::Point_2                                          &x)
  {
    bool inside = false;
    for (const auto &[a, b] : edges)
      if ((a.y() > x.y()) != (b.y() > x.y()))
      {
        const Kernel::FT cut =
          a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        inside ^= (cut > x.x());
      }
    return inside;
  }


  /// An exact interior point of a face without assuming that it is convex: close
  /// to the middle of one of its edges, on its left.
  Kernel::Point_2
  interior_point(const Arrangement::Face_const_handle          &face,
                 const std::vector<Traits::X_monotone_curve_2> &curves)
  {
    const auto             he = *face->outer_ccbs_begin();
    const Kernel::Point_2  a = he->source()->point(), b = he->target()->point();
    const Kernel::Point_2  middle = CGAL::midpoint(a, b);
    const Kernel::Vector_2 normal(-(b - a).y(), (b - a).x());
    // nearest crossing of the ray middle + t normal with any curve
    Kernel::FT nearest = 1;
    for (const auto &curve : curves)
    {
      const Kernel::Vector_2 d(curve.target().x() - curve.source().x(),
                               curve.target().y() - curve.source().y());
      const Kernel::FT       det = normal.x() * d.y() - normal.y() * d.x();
      const Kernel::Vector_2 r(curve.source().x() - middle.x(),
                               curve.source().y() - middle.y());
      if (det == 0)
        continue;
      const Kernel::FT t = (r.x() * d.y() - r.y() * d.x()) / det;
      const Kernel::FT s = (r.x() * normal.y() - r.y() * normal.x()) / det;
      if (t > 0 && t < nearest && s >= 0 && s <= 1)
        nearest = t;
    }
    return middle + (nearest / 2) * normal;
  }


  /// Boundary edges of the union of the cells around a mathematical cover.
  std::vector<MathematicalMesh::Edge>
  outline(const MathematicalMesh &mesh, const std::set<unsigned int> &support)
  {
    std::vector<MathematicalMesh::Edge> result;
    for (const unsigned int c : support)
      for (const unsigned int e : mesh.cell_edges(c))
      {
        const auto &edge = mesh.edges()[e];
        if (support.count(edge.cells[0]) + support.count(edge.cells[1]) == 1)
          result.push_back(edge);
      }
    return result;
  }


  unsigned int
  count_pieces(const MathematicalMesh       &mesh,
               const PhysicalMesh           &physical_mesh,
               const std::set<unsigned int> &support)
  {
    std::vector<Traits::X_monotone_curve_2>                  curves;
    std::vector<std::pair<Kernel::Point_2, Kernel::Point_2>> boundary, hull;
    for (unsigned int i = 0; i < physical_mesh.pieces().size(); ++i)
    {
      const CurvePiece &piece = physical_mesh.pieces()[i];
      curves.push_back(exact(piece.start, piece.end));
      const CurveRole role =
        physical_mesh.curves()[physical_mesh.piece_to_curve()[i]].role;
      if (role == CurveRole::boundary || role == CurveRole::hole)
        boundary.emplace_back(curves.back().source(), curves.back().target());
    }
    for (const auto &edge : outline(mesh, support))
    {
      curves.push_back(exact(mesh.vertices()[edge.vertices[0]],
                             mesh.vertices()[edge.vertices[1]]));
      hull.emplace_back(curves.back().source(), curves.back().target());
    }
    Arrangement arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());
    unsigned int n = 0;
    for (auto face = arrangement.faces_begin(); face != arrangement.faces_end();
         ++face)
      if (!face->is_unbounded() && face->number_of_outer_ccbs() > 0)
      {
        const Kernel::Point_2 x = interior_point(face, curves);
        n += contains(hull, x) && contains(boundary, x);
      }
    return n;
  }


  void
  check_cover_count(const MathematicalMesh &mesh,
                    const PhysicalMesh     &physical_mesh,
                    const CoverSystem      &covers)
  {
    std::vector<std::set<unsigned int>> supports(mesh.n_mathematical_covers());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int i = 0; i < mesh.n_covers_per_cell(); ++i)
        supports[mesh.cell_covers(c)[i]].insert(c);
    std::vector<unsigned int> n_physical(mesh.n_mathematical_covers(), 0);
    for (unsigned int k = 0; k < covers.n_covers(); ++k)
      ++n_physical[covers.mathematical_cover(k)];
    for (unsigned int m = 0; m < supports.size(); ++m)
      ASSERT_EQ(n_physical[m], count_pieces(mesh, physical_mesh, supports[m]))
        << "mathematical cover " << m << " at " << mesh.cover_node(m);
  }
} // namespace


TEST(CoverCount, MatchesAnIndependentCountOnRandomNetworks)
{
  unsigned int n_divided = 0;
  for (unsigned int seed = 0; seed < n_samples(500); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random     random(seed);
    const bool snapped  = (seed % 2 == 0);
    Geometry   geometry = make_box(1., 1.);
    add_random_joints(geometry, random, 1 + random.below(8), snapped);
    const PhysicalMesh physical_mesh(std::move(geometry));

    const MathematicalMesh mesh =
      make_regular_mesh(physical_mesh,
                        random_mesh(random, 0.5, seed % 4 == 0),
                        2);
    const ManifoldMesh manifold_mesh(mesh, physical_mesh);
    const CoverSystem  covers(manifold_mesh, MPI_COMM_SELF);

    double area = 0.;
    for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
      area += manifold_mesh.area(e);
    // rounding of a few hundred corner coordinates of size 1
    ASSERT_NEAR(area, 1., 1e-13);

    check_cover_count(mesh, physical_mesh, covers);
    if (HasFatalFailure())
      return;
    n_divided += covers.n_covers() > mesh.n_mathematical_covers();
  }
  // otherwise nothing was tested
  EXPECT_GT(n_divided, n_samples(500) * 2 / 5);
}
