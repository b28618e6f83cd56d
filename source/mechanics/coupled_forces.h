#ifndef nmm_source_mechanics_coupled_forces_h
#define nmm_source_mechanics_coupled_forces_h

#include <nmm/mechanics/force_term.h>

#include <linear_algebra/chosen_items.h>
#include <linear_algebra/extended_matrix.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The forces of terms with ForceTerm::couplings(). Local systems are kept until the last term
     * has been assembled. Then residual and tangent of all terms are copied, because they belong to
     * the terms that wrote them, and the local systems are added to the copies. A body matrix is not
     * copied: the term that assembled it starts its rows anew each time.
     *
     * Order of calls in an assembly: begin(), add(), finish(). Lifetime: the layout must outlive this
     * object.
     */
    class CoupledForces : public ForceSink
    {
    public:
      using Unknowns = ForceTerm::Unknowns;
      using Vector   = ForceTerm::Vector;
      using Matrix   = ForceTerm::Matrix;

      /// @p couplings of all terms.
      CoupledForces(const ModelLayout &layout, std::vector<Unknowns> couplings);

      /// Let terms add to this object as the sink of @p sum.
      void
      begin(const Trial &trial, AssembledForces &sum);

      void
      add(const Unknowns                   &unknowns,
          const dealii::Vector<double>     &forces,
          const dealii::FullMatrix<double> &tangent) override;

      void
      add(const MaterialVector       &d,
          const dealii::Tensor<1, 2> &force,
          const dealii::Tensor<2, 2> &stiffness) override;

      /// Add everything to @p sum, which has the forces of all terms.
      void
      finish(AssembledForces &sum);

    private:
      void
      add_unknowns(const Unknowns &of_forces);

      void
      add_residual(AssembledForces &sum);

      void
      add_body_tangent(AssembledForces &sum);

      void
      add_tangent(AssembledForces &sum);

      bool
      set_version(const void *of_terms, AssembledForces &sum);

      /// Call action(first unknown, number of unknowns, first value) for each local matrix, stored
      /// row by row.
      template <typename Action>
      void
      for_each_matrix(const Action &action) const;

      const ModelLayout *layout;
      /// Rows of Trial::blocks().
      ChosenItems rows;

      /// @{
      /// Local systems of this assembly: where the unknowns of each begin, and with the end of the
      /// last; unknowns, forces, and matrices one after the other.
      bool                      with_tangent = false;
      std::vector<unsigned int> begins;
      Unknowns                  unknowns;
      std::vector<double>       forces, tangents;
      /// @}

      Vector         residual;
      ExtendedMatrix matrix;
      /// The matrix that the terms wrote last, the version of its pattern, and the version that
      /// the sum got.
      const void  *original         = nullptr;
      unsigned int original_version = 0, version = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
