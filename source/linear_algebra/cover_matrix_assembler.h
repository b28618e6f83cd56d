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
     * The linear system into which local matrices of covers are summed: a row-compressed matrix
     * of 2 x 2 entries, one row for each physical cover of this rank's elements, and a
     * right-hand side. Constraints are eliminated during assembly: a cover k with constrained
     * unknowns is replaced by
     * @f[ u_k = \sum_r W_{kr} u_r + g_k, @f]
     * and its own row has a diagonal entry only.
     *
     * Order of calls: couple() for each set of coupled covers, build(), add() for each
     * contribution, finish(). To assemble several times with the same pattern: couple(),
     * build(), then each time reset(), add(), transfer().
     *
     * Compared with deal.II's DynamicSparsityPattern, AffineConstraints and
     * TrilinosWrappers::SparseMatrix::add(), all work is done per cover instead of per unknown
     * (with a quarter of the entries), and no entry is searched by its global number.
     *
     * Rows of covers that other ranks own are collected here and sent to their
     * owners: the pattern by build(), the values by finish() or transfer().
     */
    class CoverMatrixAssembler
    {
    public:
      /// The covers of each owned element are coupled from the beginning. @p covers must outlive
      /// this object.
      CoverMatrixAssembler(
        const CoverSystem                       &covers,
        const dealii::AffineConstraints<double> &constraints);

      /// Set g_k = 0 from now on, for unknowns that are increments of a solution which already
      /// satisfies the inhomogeneous constraints.
      void
      ignore_inhomogeneities();

      /// Leave rows empty to which nothing is added, for a matrix that will be added to
      /// another one. Otherwise such rows get a diagonal entry.
      void
      leave_empty_rows();

      /// On one rank, add from the second assembly on directly to the matrix that transfer()
      /// has made, without a copy. That matrix must outlive this object. reset() and add() then
      /// change its values at once.
      void
      assemble_in_place();

      /// Add the couplings of all pairs of @p covers to the sparsity pattern.
      void
      couple(dealii::ArrayView<const unsigned int> covers);

      /// Make the sparsity pattern. Collective.
      void
      build();

      /**
       * Add a local matrix (2n x 2n, stored row by row) and right-hand side (2n) of n
       * @p covers. Component c of the i-th cover is row 2i + c. A cover may be
       * named more than once.
       */
      void
      add(dealii::ArrayView<const unsigned int> covers,
          const double                         *matrix,
          const double                         *rhs);

      /// Add a right-hand side only. Requires constraints without inhomogeneities, whose
      /// elimination would need the matrix.
      void
      add_rhs(dealii::ArrayView<const unsigned int> covers, const double *rhs);

      /// Do the same as transfer() to a new matrix, and release the memory. Collective.
      void
      finish(dealii::TrilinosWrappers::SparseMatrix &matrix,
             dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// Restrict reset(), add() and transfer() to rows of covers of these blocks
      /// (ManifoldMesh::block()) from now on; empty: all. Other rows of a matrix that is
      /// assembled in place keep their values. One rank only.
      void
      set_active_rows(const std::vector<bool> &blocks);

      /// Set all values to zero, those of the matrix only if @p with_matrix.
      void
      reset(bool with_matrix = true);

      /**
       * Send values to the ranks that own them and copy the result to Trilinos objects. An
       * empty @p matrix gets its pattern here; otherwise it must be the result of an
       * earlier call, and only its values are written. Collective.
       */
      void
      transfer(dealii::TrilinosWrappers::SparseMatrix &matrix,
               dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// Do the same for the right-hand side only.
      void
      transfer_rhs(dealii::TrilinosWrappers::MPI::Vector &rhs);

    private:
      /// A term W_kr u_r of a constraint: the cover r, and the 2 x 2 entry W_kr row by row.
      struct Term
      {
        unsigned int          cover;
        std::array<double, 4> entry;
      };

      /// Terms W_kr u_r and inhomogeneities g_k of all constrained covers, sorted by cover; and
      /// which of the two components are constrained.
      struct Expansion
      {
        std::vector<unsigned int>          begin;
        std::vector<Term>                  terms;
        std::vector<std::array<double, 2>> inhomogeneity;
        std::vector<std::array<bool, 2>>   constrained;
      };

      void
      read_constraints(const dealii::AffineConstraints<double> &constraints);

      /// Append to @p expanded the covers r on which @p covers depend (themselves if they are
      /// free), each once.
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

      /// Pointer to the 2 x 2 entry in a row and column, whose component (c, d) is at
      /// [c * stride + d].
      double *
      find_entry(unsigned int row, unsigned int column, unsigned int &stride);

      /// Row of the cover with this global number, which must be owned or in ghost_covers.
      unsigned int
      row_of(unsigned int global_cover) const;

      const CoverSystem *covers;
      /// Global and local number of the first owned cover.
      unsigned int              first_owned, first_owned_here, n_owned;
      std::vector<unsigned int> cover_to_expansion;
      Expansion                 expansion;

      /// Sets of coupled covers, released by build().
      std::vector<unsigned int> stencil_begin, stencil_covers;

      /// Local number of each cover: owned covers first, then those of other ranks, ascending.
      std::vector<unsigned int> cover_to_local;
      std::vector<unsigned int> ghost_covers; // global numbers
      unsigned int              n_rows            = 0;
      bool                      leaves_empty_rows = false;

      /// For each row of 2 x 2 entries its columns, as ascending local numbers. Values are in the
      /// order of the scalar matrix: the two scalar rows of a row follow each other.
      std::vector<std::size_t>  row_begin;
      std::vector<unsigned int> columns;
      std::vector<double>       values;
      std::vector<double>       right_hand_side;
      /// Pointer to the values: in the vector above, or in the matrix made by transfer().
      double     *entries          = nullptr;
      bool        is_made_in_place = false;
      ActiveItems active_rows;
      /// For each row, whether it is active; empty: all rows are.
      std::vector<std::uint8_t> is_active_row;

      /// For each rank that exchanges rows with this one, the rows that are sent and received.
      /// A row is encoded as its cover, the number n of columns, and n columns (global numbers).
      std::vector<std::pair<unsigned int, std::vector<unsigned int>>> sent,
        received;

      /// A term of a constrained cover, or the identity of a free one, with the position of the
      /// cover r in local_covers.
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
