#ifndef nmm_source_linear_algebra_cover_matrix_assembler_h
#define nmm_source_linear_algebra_cover_matrix_assembler_h

#include <nmm/covers/cover_system.h>

#include <deal.II/base/array_view.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <cstdint>
#include <linear_algebra/active_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    struct MatrixRows;

    /**
     * The linear system that covers assemble into: a row-compressed matrix of 2 x 2
     * entries, one row for each physical cover that this rank's elements touch, and a
     * right-hand side. Constraints are resolved on the way in: a cover k with constrained
     * unknowns is replaced by
     * @f[ u_k = \sum_r W_{kr} u_r + g_k, @f]
     * and its own row has a diagonal entry only.
     *
     * Order of calls: couple() for each set of coupled covers, build(), add() for each
     * contribution, finish(). To assemble several times with the same pattern: couple(),
     * build(), then each time reset(), add(), transfer().
     *
     * Compared with deal.II's DynamicSparsityPattern, AffineConstraints and
     * TrilinosWrappers::SparseMatrix::add(), all work is per cover instead of per unknown
     * (a quarter of the entries), and no entry is searched by its global number.
     *
     * Rows of covers that other ranks own are collected here and sent to their
     * owners, the pattern in build(), the values in finish() or transfer().
     */
    class CoverMatrixAssembler
    {
    public:
      /// Owned elements are coupled already. @p covers has to outlive this.
      CoverMatrixAssembler(
        const CoverSystem                       &covers,
        const dealii::AffineConstraints<double> &constraints);

      /// From now on g_k = 0: for unknowns that are increments of a solution which
      /// satisfies the inhomogeneous constraints.
      void
      ignore_inhomogeneities();

      /// Leave rows empty to which nothing is added, for matrices that are added to
      /// others. Otherwise they get a diagonal entry.
      void
      leave_empty_rows();

      /// On one rank, write from the second assembly on into the matrix that transfer()
      /// has made. That matrix has to outlive this; its values are then those of the
      /// last reset() and of what was added since.
      void
      assemble_in_place();

      /// Couple all pairs of @p covers.
      void
      couple(dealii::ArrayView<const unsigned int> covers);

      /// Make the sparsity pattern. Collective.
      void
      build();

      /**
       * Add a local matrix, row by row, (2n x 2n), and right-hand side, (2n), to
       * the n @p covers; unknown c of cover i is row 2i + c. A cover may be
       * named twice.
       */
      void
      add(dealii::ArrayView<const unsigned int> covers,
          const double                         *matrix,
          const double                         *rhs);

      /// Add a right-hand side only; for constraints without inhomogeneities.
      void
      add_rhs(dealii::ArrayView<const unsigned int> covers, const double *rhs);

      /// The same as transfer() to a new matrix, and release the memory. Collective.
      void
      finish(dealii::TrilinosWrappers::SparseMatrix &matrix,
             dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// From now on reset, add to and transfer rows of covers in these blocks
      /// (ManifoldMesh::block()) only; empty: all. Other rows of a matrix that is
      /// assembled in place keep their values. One rank.
      void
      set_active_rows(const std::vector<bool> &blocks);

      /// Set all values to zero, those of the matrix only if @p with_matrix.
      void
      reset(bool with_matrix = true);

      /**
       * Send values to the ranks that own them and copy the result to Trilinos. A
       * @p matrix that is empty gets its pattern here; otherwise it must be one that an
       * earlier call made, and only its values are written. Collective.
       */
      void
      transfer(dealii::TrilinosWrappers::SparseMatrix &matrix,
               dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// The same for the right-hand side only.
      void
      transfer_rhs(dealii::TrilinosWrappers::MPI::Vector &rhs);

    private:
      /// A term W_kr u_r, where r is the cover and W_kr the entry, by rows.
      struct Term
      {
        unsigned int          cover;
        std::array<double, 4> entry;
      };

      /// Terms W_kr u_r and g_k of the constrained covers, one cover after the other.
      struct Expansion
      {
        std::vector<unsigned int>          begin;
        std::vector<Term>                  terms;
        std::vector<std::array<double, 2>> inhomogeneity;
        std::vector<std::array<bool, 2>>   constrained;
      };

      void
      read_constraints(const dealii::AffineConstraints<double> &constraints);

      /// Append to @p expanded the covers r of the terms of @p covers, each once.
      void
      expand(dealii::ArrayView<const unsigned int> covers,
             std::vector<unsigned int>            &expanded) const;

      void
      number_rows();

      void
      fill_rows();

      void
      exchange_pattern();

      void
      localize_columns();

      void
      exchange_values(bool with_matrix);

      void
      make_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

      void
      copy_values(const MatrixRows &to) const;

      void
      copy_rhs(dealii::TrilinosWrappers::MPI::Vector &rhs) const;

      void
      fix_empty_diagonals();

      void
      add_to_rows(const unsigned int *covers,
                  unsigned int        n,
                  const double       *matrix,
                  const double       *rhs);

      void
      add_constrained(dealii::ArrayView<const unsigned int> covers,
                      const double                         *matrix,
                      const double                         *rhs);

      bool
      has_constrained(dealii::ArrayView<const unsigned int> covers) const;

      /// Entry in a row and column, whose component (c, d) is at [c * stride + d].
      double *
      find_entry(unsigned int row, unsigned int column, unsigned int &stride);

      /// Row of a cover, owned or in ghost_covers, that has this global number.
      unsigned int
      row_of(unsigned int global_cover) const;

      const CoverSystem *covers;
      /// Global and local number of the first owned cover.
      unsigned int              first_owned, first_owned_here, n_owned;
      std::vector<unsigned int> cover_to_expansion;
      Expansion                 expansion;

      /// Sets of coupled covers, released by build().
      std::vector<unsigned int> stencil_begin, stencil_covers;

      /// Local numbers: owned covers first, then others, ascending.
      std::vector<unsigned int> cover_to_local;
      std::vector<unsigned int> ghost_covers; // global numbers
      unsigned int              n_rows            = 0;
      bool                      leaves_empty_rows = false;

      /// For each row of entries its columns, local numbers, ascending. Values are in the
      /// order of the scalar matrix: both scalar rows of a row one after the other.
      std::vector<std::size_t>  row_begin;
      std::vector<unsigned int> columns;
      std::vector<double>       values;
      std::vector<double>       right_hand_side;
      /// Where the values are: in the vector above, or in the matrix of transfer().
      double     *entries          = nullptr;
      bool        is_made_in_place = false;
      ActiveItems active_rows;
      /// For each row, whether it is active; empty: all are.
      std::vector<std::uint8_t> is_active_row;

      /// For each rank the rows that are sent and received, each as its cover, the number
      /// n of columns, and n columns (global numbers).
      std::vector<std::pair<unsigned int, std::vector<unsigned int>>> sent,
        received;

      /// A term of a constrained cover, or the identity of a free one. The cover r is at
      /// a position in local_covers.
      struct Part
      {
        unsigned int  position;
        const double *entry;
      };

      /// Scratch of add_constrained().
      std::vector<unsigned int> local_covers, parts_begin;
      std::vector<Part>         parts;
      std::vector<double>       local_matrix, local_rhs, local_product,
        local_inhomogeneity;
    };
  } // namespace internal
} // namespace NMM

#endif
