#ifndef nmm_source_linear_algebra_block_lu_h
#define nmm_source_linear_algebra_block_lu_h

#include <nmm/linear_algebra/block_matrix.h>

#include <linear_algebra/factors.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Solves A x = b for many small blocks of unknowns, each of which is full in
     * itself and coupled with few others, another time with other ones: rock that
     * lies on rock. Gauss elimination of whole blocks,
     * @f[ A_{ik} \leftarrow A_{ik} - A_{ij} A_{jj}^{-1} A_{jk}, \qquad i, k > j, @f]
     * in the order of Eigen's approximate minimum degree of the graph of blocks, with
     * LAPACK's LU (and pivots) of @f$A_{jj}@f$ and one BLAS product for all
     * @f$(i, k)@f$ of a @f$j@f$.
     * Reference: Duff, Erisman & Reid, Direct Methods for Sparse Matrices, 2nd ed.,
     * section 2.7 (block elimination) and chapter 11.
     *
     * Pivots are looked for within blocks only: enough where a block's own mass
     * and stiffness are not small against what touches it. Where they are,
     * factorize() says so.
     *
     * Against KLU, which takes entries one by one and orders unknowns: see
     * doc/dependencies.md. Cost: O(n^3 + n^2 m + n m^2) for a block of n unknowns and
     * the m unknowns of later ones that it is coupled with, ordering in O(blocks).
     *
     * One rank.
     */
    class BlockLu : public Factors
    {
    public:
      BlockLu();
      ~BlockLu() override;

      /// Of @p rows and columns, ascending, all or none of a block (empty: all). False if a
      /// pivot is zero, or so small that the solution would mean nothing.
      [[nodiscard]] bool
      factorize(const BlockMatrix               &matrix,
                const std::vector<unsigned int> &rows);

      double
      n_factor_entries() const override;

      void
      solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
            dealii::TrilinosWrappers::MPI::Vector       &solution,
            const std::vector<bool>                     &blocks) override;

    private:
      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
