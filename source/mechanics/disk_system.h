#ifndef nmm_source_mechanics_disk_system_h
#define nmm_source_mechanics_disk_system_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <mechanics/boundary_terms.h>
#include <mechanics/curve_conditions.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The part of the equations of small displacements that belongs to the coefficients c of disk
     * covers,
     * @f[ \begin{pmatrix} K & B \\ B^T & C \end{pmatrix}
         \begin{pmatrix} u \\ c \end{pmatrix} =
         \begin{pmatrix} f \\ g \end{pmatrix}. @f]
     * There are few functions, so that the system is solved by one factorization of K:
     * with K x_0 = f and K X = B, (C - B^T X) c = g - B^T x_0 and u = x_0 - X c. See
     * DiskCover for the reason why B and C are integrals on the circles.
     *
     * Order of calls: assemble(), combine(), then coefficients() and energy().
     */
    class DiskSystem
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      /// All arguments must outlive this object.
      DiskSystem(const CoverSystem                       &covers,
                 const dealii::AffineConstraints<double> &constraints,
                 const ElasticityProblem                 &problem,
                 const std::vector<const DiskCover *>    &disks);

      /// Assemble B, C and g. @p like is a vector of the owned unknowns. Collective.
      void
      assemble(const EdgeTerms       &edge_terms,
               const CurveConditions &conditions,
               const Vector          &like);

      /// The columns of B, with constraints eliminated.
      const std::vector<Vector> &
      couplings() const;

      /// C.
      const dealii::FullMatrix<double> &
      own_matrix() const;

      /// Turn @p solution from x_0 into u, given the columns of X. Collective.
      void
      combine(const std::vector<Vector> &responses, Vector &solution);

      /// The coefficients of the functions of each disk.
      const std::vector<dealii::Vector<double>> &
      coefficients() const;

      /**
       * The part of the strain energy that depends on the coefficients [J per metre of thickness],
       * @f[ \sum_j c_j\oint\sigma(F_j)n\cdot\Bigl(u_h +
           \tfrac12\sum_k c_kF_k\Bigr)ds, @f]
       * where u_h is the displacement of the other covers. @p solution is u with or
       * without distributed constraints. Collective.
       */
      double
      energy(const Vector &solution) const;

    private:
      /**
       * Add the terms of the edges on the circle of disk @p d. The tractions of a function are in
       * equilibrium, so that a translation does no work on them. Quadrature and rounding leave a
       * force, which displacements that are large compared with those due to the strain in the disk
       * would multiply. It is taken away by a uniform traction.
       */
      void
      add_circle(unsigned int           d,
                 const EdgeTerms       &edge_terms,
                 const CurveConditions &conditions);

      /// Set g of disk @p d.
      void
      add_loads(unsigned int d, const CurveConditions &conditions);

      /// Pressures on curves within a region, as indices into
      /// ElasticityProblem::boundary_conditions. Collective.
      std::vector<unsigned int>
      pressures_within(unsigned int           region,
                       const CurveConditions &conditions) const;

      const CoverSystem                       *covers;
      const dealii::AffineConstraints<double> *constraints;
      const ElasticityProblem                 *problem;
      std::vector<const DiskCover *>           disks;
      /// The first function of each disk.
      std::vector<unsigned int> offsets;

      /// Columns of B, and the vectors of the integrals of sigma(F_j) n . v on the inside.
      std::vector<Vector> columns, works;
      /// C, and the integrals of sigma(F_j) n . F_k.
      dealii::FullMatrix<double>          matrix, work_matrix;
      dealii::Vector<double>              rhs;
      std::vector<dealii::Vector<double>> values;
    };
  } // namespace internal
} // namespace NMM

#endif
