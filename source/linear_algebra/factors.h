#ifndef nmm_source_linear_algebra_factors_h
#define nmm_source_linear_algebra_factors_h

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Factors of some rows and columns of a matrix, on one rank.
    class Factors
    {
    public:
      virtual ~Factors() = default;

      /// Of both factors.
      virtual double
      n_factor_entries() const = 0;

      /// Leaves rows alone that were left out. @p solution may be the same vector as
      /// @p rhs. @p blocks, if there are blocks: only theirs is wanted, and they are coupled
      /// with no others; the rest may be solved for or left as it is. Empty: all.
      virtual void
      solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
            dealii::TrilinosWrappers::MPI::Vector       &solution,
            const std::vector<bool>                     &blocks) = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
