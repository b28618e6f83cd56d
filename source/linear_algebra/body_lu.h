#ifndef nmm_source_linear_algebra_body_lu_h
#define nmm_source_linear_algebra_body_lu_h

#include <nmm/linear_algebra/body_matrix.h>

#include <linear_algebra/direct_factorization.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * LU factorization of a BodyMatrix by eliminating one body after the other,
     * @f[ A_{ik} \leftarrow A_{ik} - A_{ij} A_{jj}^{-1} A_{jk}, \qquad i, k > j, @f]
     * in the approximate minimum degree order (Eigen) of the graph of bodies. Each
     * @f$A_{jj}@f$ is factorized by LAPACK with row pivoting, and all products of a body j
     * are one call of BLAS.
     * Reference: Duff, Erisman & Reid, Direct Methods for Sparse Matrices, 2nd ed.,
     * section 2.7 (block elimination) and chapter 11.
     *
     * Pivots are searched within one body only. That is enough where the mass and stiffness
     * of the body itself are not small against the contact stiffness at its faces.
     * Where they are, factorize() returns false.
     *
     * Cost: O(n^3 + n^2 m + n m^2) for a body of n unknowns that is coupled with bodies of
     * m unknowns which are eliminated later; ordering is O(number of bodies). A comparison
     * with KLU is in doc/dependencies.md. One rank.
     */
    class BodyLu : public DirectFactorization<BodyMatrix>
    {
    public:
      BodyLu();
      ~BodyLu() override;

      /// Factorize @p rows and columns, ascending, all or none of a body (empty: all).
      /// Returns false if the largest pivot left in a column is below 1e-14 of the
      /// largest entry of its body.
      bool
      factorize(const BodyMatrix                &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// Rows that were not chosen, and those of bodies that are not wanted, keep what they
      /// have in @p solution.
      void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies) override;

    private:
      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
