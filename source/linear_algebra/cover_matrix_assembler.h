#ifndef nmm_source_linear_algebra_cover_matrix_assembler_h
#define nmm_source_linear_algebra_cover_matrix_assembler_h

#include <nmm/covers/cover_system.h>

#include <deal.II/base/array_view.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <linear_algebra/chosen_items.h>
#include <linear_algebra/matrix_rows.h>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The linear system into which local matrices of covers are summed. The sparsity pattern
     * consists of 2 x 2 entries with one row of entries for each cover. Constraints are eliminated
     * during assembly; the row of a constrained unknown has a diagonal entry only.
     *
     * Order of calls: couple() for each set of coupled covers, build(), then for each assembly
     * reset(), add() and compress().
     *
     * In contrast to AffineConstraints::distribute_local_to_global(), values are added directly to
     * the arrays of the Trilinos matrix, for all entries of a row in one pass, and rows of other
     * blocks can be left out. Contributions to rows of other ranks are added by
     * TrilinosWrappers::SparseMatrix::add().
     */
    class CoverMatrixAssembler
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      /// The covers of each owned element are coupled from the beginning. Both arguments must
      /// outlive this object.
      CoverMatrixAssembler(
        const CoverSystem                       &covers,
        const dealii::AffineConstraints<double> &constraints);

      /// Ignore the inhomogeneities of constraints, for unknowns that are increments of a solution
      /// which already satisfies the inhomogeneous constraints.
      void
      ignore_inhomogeneities();

      /// Leave rows empty to which nothing is added, for a matrix that will be added to
      /// another one. Otherwise such rows get a diagonal entry.
      void
      leave_empty_rows();

      /// Let reset(), add() and compress() change the rows of chosen covers only. On one rank only;
      /// @p covers must outlive this object.
      void
      restrict_to(const ChosenItems &covers);

      /// Add the couplings of all pairs of @p covers to the sparsity pattern.
      void
      couple(dealii::ArrayView<const unsigned int> covers);

      /// Give @p matrix its sparsity pattern and @p rhs its size. All further calls change their
      /// values in place; both must outlive this object. Collective.
      void
      build(Matrix &matrix, Vector &rhs);

      /// Begin an assembly: set the right-hand side to zero, and the matrix only if
      /// @p with_matrix. Collective.
      void
      reset(bool with_matrix = true);

      /**
       * Add a local matrix (2n x 2n, stored row by row) and right-hand side (2n) of n
       * @p covers. Component c of the i-th cover is row 2i + c. A cover may be
       * named more than once. A null @p matrix means a right-hand side only; it requires
       * constraints without inhomogeneities, whose elimination would need the matrix.
       */
      void
      add(dealii::ArrayView<const unsigned int> covers,
          const double                         *matrix,
          const double                         *rhs);

      /// End an assembly: send values to the ranks that own them, those of the matrix only if
      /// @p with_matrix. Collective.
      void
      compress(bool with_matrix = true);

    private:
      /// Set `expanded` to the covers on which @p covers depend through the constraints, in
      /// ascending order and each once. Free covers depend on themselves.
      void
      expand(dealii::ArrayView<const unsigned int> covers);

      void
      add_constrained(dealii::ArrayView<const unsigned int> covers,
                      const double                         *matrix,
                      const double                         *rhs);

      void
      add_free(dealii::ArrayView<const unsigned int> covers,
               const double                         *matrix,
               const double                         *rhs);

      /// Add the two rows of the @p i-th of @p covers, which another rank owns.
      void
      add_row_of_other_rank(unsigned int                          i,
                            dealii::ArrayView<const unsigned int> covers,
                            const double                         *matrix,
                            const double                         *rhs);

      void
      fill_empty_diagonals();

      bool
      is_chosen(const unsigned int row) const
      {
        return chosen_covers == nullptr || chosen_covers->contains(row);
      }

      /// Call action(row) for the rows of entries of chosen covers.
      template <typename Action>
      void
      for_each_row(const Action &action) const
      {
        if (chosen_covers == nullptr)
          for (unsigned int row = 0; row < n_rows; ++row)
            action(row);
        else
          chosen_covers->for_each(n_rows, action);
      }

      const CoverSystem                       *covers;
      const dealii::AffineConstraints<double> *constraints;
      bool               has_inhomogeneities = true, leaves_empty_rows = false;
      const ChosenItems *chosen_covers = nullptr;
      /// For each cover, whether one of its unknowns is constrained.
      std::vector<bool> is_constrained;
      /// Couplings of covers (global numbers); released by build().
      dealii::DynamicSparsityPattern pattern;

      Matrix    *matrix = nullptr;
      Vector    *rhs    = nullptr;
      MatrixRows rows;
      double    *rhs_values = nullptr;
      /// Number of rows of entries, one for each owned cover in ascending order.
      unsigned int n_rows;
      /// For each cover its local column of entries, which for an owned cover is also its row.
      std::vector<unsigned int> cover_to_column;

      /// Scratch of couple() and add().
      std::vector<unsigned int>                    expanded;
      std::vector<dealii::types::global_dof_index> global_columns;
      std::vector<double> local_inhomogeneities, expanded_rhs, expanded_matrix;
      /// Rows of T, see add_constrained(): columns and weights, and where each row begins.
      std::vector<std::pair<unsigned int, double>> terms;
      std::vector<unsigned int>                    term_begins;
    };
  } // namespace internal
} // namespace NMM

#endif
