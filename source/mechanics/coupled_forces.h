#ifndef nmm_source_mechanics_coupled_forces_h
#define nmm_source_mechanics_coupled_forces_h

#include <nmm/mechanics/force_term.h>

#include <linear_algebra/active_items.h>
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
    class CoupledForces : public ForceSink, public BlockTerm
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

      void
      set_active_blocks(const std::vector<bool> &is_active,
                        const std::vector<bool> &is_held) override;

      std::vector<unsigned int>
      take_touched_blocks() override;

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

      void
      find_blocks(bool with_tangent);

      /// Call action(first unknown, number of unknowns, first value) for each local matrix, stored
      /// row by row.
      template <typename Action>
      void
      for_each_matrix(const Action &action) const;

      const ModelLayout *layout;
      /// Rows of active blocks.
      ActiveItems rows;
      /// See BlockTerm::set_active_blocks().
      std::vector<bool> active, held;

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

      /// Pairs of blocks that this assembly couples, and those of all terms.
      std::vector<BlockPair> pairs, all_pairs;
      /// See BlockTerm::take_touched_blocks().
      std::vector<unsigned int> touched;
    };
  } // namespace internal
} // namespace NMM

#endif
