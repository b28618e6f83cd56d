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
     * Pivots are searched within one body only. This is sufficient unless the mass and stiffness
     * of the body itself are small compared with the contact stiffness at its faces.
     * If they are, factorize() returns false.
     *
     * Cost: O(n^3 + n^2 m + n m^2) for a body of n unknowns that is coupled with bodies of
     * m unknowns in all that are eliminated later; ordering is O(number of bodies). A comparison
     * with KLU is in doc/dependencies.md. The class works on one rank only.
     */
    class BodyLu : public DirectFactorization<BodyMatrix>
    {
    public:
      BodyLu();
      ~BodyLu() override;

      /// Factorize the rows and columns @p rows (ascending; empty: all), which must contain all or
      /// none of the unknowns of each body. Returns false if a pivot is smaller than 1e-14 times
      /// the largest entry of the body's own matrix.
      bool
      factorize(const BodyMatrix                &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// Rows that were not factorized, and rows of bodies that are not in @p bodies, are left
      /// unchanged in @p solution.
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
