#include <nmm/base/exceptions.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <base/disjoint_sets.h>
#include <cmath>
#include <mechanics/floating_blocks.h>
#include <mechanics/trace_constant.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Number the connected pieces, and set the piece of each element. Returns the number of
      /// pieces.
      unsigned int
      find_pieces(const ManifoldMesh        &mesh,
                  const CurveConditions     &conditions,
                  std::vector<unsigned int> &element_to_piece)
      {
        DisjointSets elements(mesh.n_elements());
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        {
          for (const ManifoldMesh::Link &link : mesh.joined(e))
            if (link.neighbor < e)
              elements.join(e, link.neighbor);
          for (const ElementEdge &edge : mesh.edges(e))
            if (edge.neighbor < e && conditions.is_tied(e, edge))
              elements.join(e, edge.neighbor);
        }
        return elements.number(element_to_piece);
      }


      /// Area, extent and region of a connected piece.
      struct Piece
      {
        double           area = 0.;
        dealii::Point<2> lower{1e300, 1e300}, upper{-1e300, -1e300};
        /// Area of the largest element [m^2], and its region, for messages.
        double       largest_area = -1.;
        unsigned int region       = invalid_index;

        dealii::Point<2>
        center() const
        {
          return dealii::Point<2>(0.5 * (lower + upper));
        }

        double
        size() const
        {
          return 0.5 * lower.distance(upper);
        }
      };


      std::vector<Piece>
      measure_pieces(const ManifoldMesh              &mesh,
                     const std::vector<unsigned int> &element_to_piece,
                     const unsigned int               n_pieces)
      {
        const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
        std::vector<Piece>      pieces(n_pieces);
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        {
          Piece       &piece = pieces[element_to_piece[e]];
          const double area  = mesh.area(e);
          piece.area += area;
          if (area > piece.largest_area)
          {
            piece.largest_area = area;
            piece.region       = mesh.region(e);
          }
          for (const unsigned int v :
               mathematical_mesh.cell_vertices(mesh.cell(e)))
            for (unsigned int d = 0; d < 2; ++d)
            {
              const double x = mathematical_mesh.vertices()[v][d];
              piece.lower[d] = std::min(piece.lower[d], x);
              piece.upper[d] = std::max(piece.upper[d], x);
            }
        }
        return pieces;
      }


      /// The matrices (3 x 3) of check_no_block_floats(), with nine numbers per piece.
      class HeldModes
      {
      public:
        explicit HeldModes(const std::vector<Piece> &pieces)
          : pieces(&pieces)
          , matrices(9 * pieces.size(), 0.)
        {
        }

        /// Add the condition that the displacement along @p direction is held at the point @p x.
        void
        add(const unsigned int          piece,
            const dealii::Point<2>     &x,
            const dealii::Tensor<1, 2> &direction)
        {
          const dealii::Tensor<1, 2> d =
            (x - (*pieces)[piece].center()) / (*pieces)[piece].size();
          const double modes[3] = {direction[0],
                                   direction[1],
                                   direction[1] * d[0] - direction[0] * d[1]};
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              matrices[9 * piece + 3 * i + j] += modes[i] * modes[j];
        }

        void
        sum_over_ranks(const MPI_Comm communicator)
        {
          dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(matrices),
                                      communicator,
                                      dealii::ArrayView<double>(matrices));
        }

        /// Description of a free motion of the piece; empty if there is none.
        std::string
        free_motion(const unsigned int piece) const
        {
          const Eigen::Map<const Eigen::Matrix3d> matrix(matrices.data() +
                                                         9 * piece);
          if (matrix.trace() == 0.)
            return "nothing holds it";
          const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
          if (solver.eigenvalues()(0) > 1e-13 * solver.eigenvalues()(2))
            return "";
          const Eigen::Vector3d mode = solver.eigenvectors().col(0);
          if (std::abs(mode(2)) > 1e-3)
            return "it can rotate";
          return std::abs(mode(0)) > std::abs(mode(1)) ? "it can move along x"
                                                       : "it can move along y";
        }

      private:
        const std::vector<Piece> *pieces;
        std::vector<double>       matrices;
      };


      void
      add_boundary(const unsigned int       element,
                   const unsigned int       piece,
                   const ManifoldMesh      &mesh,
                   const ElasticityProblem &problem,
                   const CurveConditions   &conditions,
                   HeldModes               &held)
      {
        const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
        const unsigned int      cell              = mesh.cell(element);
        for (const ElementEdge &edge : mesh.edges(element))
        {
          if (!conditions.has_displacement(element, edge))
            continue;
          const EdgeRule rule =
            make_edge_rule(edge, cell_frame(mesh, element), 2);
          for (const unsigned int c : conditions.conditions(element, edge))
            for (unsigned int q = 0; q < rule.points.size(); ++q)
            {
              const BoundaryCondition &condition =
                problem.boundary_conditions[c];
              const dealii::Point<2> x =
                mathematical_mesh.reference_to_real(cell, rule.points[q]);
              if (condition.holds_normal())
                held.add(piece, x, rule.normals[q]);
              else if (condition.is_support())
                for (unsigned int d = 0; d < 2; ++d)
                  if (condition.components[d])
                    held.add(piece, x, dealii::Point<2>::unit_vector(d));
            }
        }
      }
    } // namespace


    void
    check_no_block_floats(const CoverSystem       &covers,
                          const ElasticityProblem &problem,
                          const CurveConditions   &conditions,
                          const PointTerms        &point_terms)
    {
      const ManifoldMesh       &mesh = covers.manifold_mesh();
      std::vector<unsigned int> element_to_piece;
      const unsigned int        n_pieces =
        find_pieces(mesh, conditions, element_to_piece);
      const std::vector<Piece> pieces =
        measure_pieces(mesh, element_to_piece, n_pieces);

      HeldModes held(pieces);
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
        add_boundary(e, element_to_piece[e], mesh, problem, conditions, held);
      for (unsigned int f = 0; f < problem.fixed_points.size(); ++f)
      {
        const unsigned int e = point_terms.fixed_point_elements()[f];
        if (e >= first && e < last)
          for (unsigned int d = 0; d < 2; ++d)
            if (problem.fixed_points[f].components[d])
              held.add(element_to_piece[e],
                       problem.fixed_points[f].point,
                       dealii::Point<2>::unit_vector(d));
      }
      held.sum_over_ranks(covers.communicator());

      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(mesh.physical_mesh());
      for (unsigned int p = 0; p < n_pieces; ++p)
      {
        // pieces without area are ignored
        if (pieces[p].area == 0.)
          continue;
        const std::string motion = held.free_motion(p);
        if (motion.empty())
          continue;
        const unsigned int region = pieces[p].region;
        AssertThrow(
          false,
          NumericalFailure(
            "Block " +
              std::to_string(mesh.physical_mesh().regions()[region].block) +
              " of material \"" +
              problem.materials[region_to_material[region]].name +
              "\" floats freely (" + motion + ")",
            to_string(mesh.physical_mesh().regions()[region].inside),
            "hold it by displacement conditions or fixed points that stop "
            "two translations and the rotation, or tie it to its neighbours "
            "by closed joints"));
      }
    }
  } // namespace internal
} // namespace NMM
