#ifndef nmm_source_mechanics_boundary_terms_h
#define nmm_source_mechanics_boundary_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <mechanics/linear_terms.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Terms on the circles of disk covers, in small displacements.
     */
    class EdgeTerms
    {
    public:
      EdgeTerms(const CoverSystem       &covers,
                const ElasticityProblem &problem,
                TraceConstants          &trace_constants);

      /// Terms of the functions F_j of a disk cover on an edge of its circle. Unknowns are those of
      /// an element, followed by those of its neighbour; v is a displacement of these.
      struct DiskEdge
      {
        /// Nitsche's bilinear form of F_j and v.
        std::vector<dealii::Vector<double>> couplings;
        /// Integrals of w_2 v_1 + w_1 v_2 for v along each axis: the first integral of B_j with a
        /// unit traction.
        std::array<dealii::Vector<double>, 2> unit_tractions;
        /// Integrals of sigma(F_j) n . v on the inside.
        std::vector<dealii::Vector<double>> works;
        /// Nitsche's bilinear form of F_j and F_k.
        dealii::FullMatrix<double> matrix;
        /// Integrals of sigma(F_j) n . F_k.
        dealii::FullMatrix<double> work_matrix;
      };

      /**
       * Compute the terms of a tied edge of @p element; returns false if the edge is not on the
       * circle of @p disk. With n from the inside (1) to the outside (2) of the circle and
       * w_1 + w_2 = 1, the terms of a tie and the first integral of DiskCover give
       * @f[ B_j(v) = \int \sigma(F_j)n\cdot(w_2v_1+w_1v_2) - \{\sigma(v)\}n\cdot F_j
           + \gamma F_j\cdot(v_1-v_2)\,ds, @f]
       * @f[ C_{jk} = \int (1-2w_1)\,\sigma(F_j)n\cdot F_k + \gamma F_j\cdot F_k\,ds. @f]
       */
      bool
      compute_disk_edge(unsigned int       element,
                        const ElementEdge &edge,
                        const DiskCover   &disk,
                        DiskEdge          &result) const;

    private:
      /// The functions F_j of a disk and their tractions sigma(F_j) n at a point of its circle.
      struct DiskPoint
      {
        std::vector<dealii::Tensor<1, 2>> displacements, tractions;
      };

      /// Add the terms of compute_disk_edge() at a point. @p inside is 0 if the element is inside of
      /// the circle, and 1 if its neighbour is.
      void
      add_disk_point(const WeakPoint &point,
                     const DiskPoint &functions,
                     unsigned int     inside,
                     DiskEdge        &result) const;

      const CoverSystem        *covers;
      WeakPointMaker            maker;
      unsigned int              degree, n_per_cell;
      std::vector<LinearRegion> regions;
    };
  } // namespace internal
} // namespace NMM

#endif
