#ifndef nmm_source_linear_algebra_block_system_h
#define nmm_source_linear_algebra_block_system_h

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
     * The linear system while it is assembled: a row-compressed matrix of 2x2
     * blocks, one block row per physical cover that this rank's elements touch,
     * with constraints resolved on the way in.
     *
     * A contribution names covers and a dense local matrix. Covers with
     * constrained unknowns are replaced by what they are constrained to
     * (u_k = sum_r W_kr u_r + g_k); their own rows keep a diagonal entry only.
     * The order of calls is couple()*, build(), add()*, finish(). To assemble
     * again with the same pattern: couple()*, build(), then any number of times
     * reset(), add()*, transfer().
     *
     * Against deal.II's DynamicSparsityPattern + AffineConstraints +
     * TrilinosWrappers::SparseMatrix::add(), all work is per cover instead of
     * per unknown (a quarter of the entries), rows are written where their
     * final place in memory is, and nothing is looked up by global number.
     *
     * Rows of covers that other ranks own are collected here and sent to their
     * owners, the pattern in build(), the values in finish() or transfer().
     */
    class BlockSystem
    {
    public:
      BlockSystem(const CoverSystem                       &covers,
                  const dealii::AffineConstraints<double> &constraints);

      /// From now on constraints are u_k = sum_r W_kr u_r: for unknowns that are
      /// increments of a solution which satisfies the inhomogeneous ones.
      void
      ignore_inhomogeneities();

      /// Rows to which nothing is added stay empty, for matrices that are added to
      /// others. Otherwise they get a diagonal entry.
      void
      leave_empty_rows();

      /// On one rank, from the second assembly on: add() writes into the matrix that
      /// transfer() has made, which therefore has to be there, and be the same, as
      /// long as this; its values are those of the last reset() and what was added since.
      void
      assemble_in_place();

      /// All pairs of @p covers will be coupled. Owned elements are coupled
      /// already.
      void
      couple(dealii::ArrayView<const unsigned int> covers);

      /// Make the sparsity pattern.
      void
      build();

      /**
       * Add a local matrix, row-major, (2n x 2n), and right-hand side, (2n), to
       * the n @p covers; unknown c of cover i is row 2i + c. A cover may be
       * named twice.
       */
      void
      add(dealii::ArrayView<const unsigned int> covers,
          const double                         *matrix,
          const double                         *rhs);

      /// The same without a matrix; for constraints without inhomogeneities.
      void
      add_rhs(dealii::ArrayView<const unsigned int> covers, const double *rhs);

      /// Exchange with other ranks, hand over to Trilinos and release the memory.
      void
      finish(dealii::TrilinosWrappers::SparseMatrix &matrix,
             dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// From now on rows of covers in other blocks (ManifoldMesh::block()) than
      /// these are neither reset nor added to nor handed over: in a matrix that is made
      /// in place they are as they were. Empty: all rows count. One rank.
      void
      set_active_rows(const std::vector<bool> &blocks);

      /// Start anew with zero values, of the matrix only if @p with_matrix.
      void
      reset(bool with_matrix = true);

      /**
       * Exchange with other ranks and hand over to Trilinos. A @p matrix that
       * is empty gets its pattern here; otherwise it must be one that an earlier
       * call made, and only its values are written.
       */
      void
      transfer(dealii::TrilinosWrappers::SparseMatrix &matrix,
               dealii::TrilinosWrappers::MPI::Vector  &rhs);

      /// The same for the right-hand side alone.
      void
      transfer_rhs(dealii::TrilinosWrappers::MPI::Vector &rhs);

    private:
      /// u_k += block * u_cover.
      struct Term
      {
        unsigned int          cover;
        std::array<double, 4> block;
      };

      /// What constrained covers stand for, one after the other.
      struct Expansion
      {
        std::vector<unsigned int>          begin;
        std::vector<Term>                  terms;
        std::vector<std::array<double, 2>> inhomogeneity;
        std::vector<std::array<bool, 2>>   constrained;
      };

      void
      read_constraints(const dealii::AffineConstraints<double> &constraints);

      /// The free covers that @p covers stand for, each once, in the order in
      /// which they are met; appended to @p expanded.
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

      /// Block of a row, of which entry (c, d) is at [c * stride + d].
      double *
      find_block(unsigned int row, unsigned int column, unsigned int &stride);

      /// Row of a cover by its global number, owned or in ghost_covers.
      unsigned int
      row_of(unsigned int global_cover) const;

      const CoverSystem *covers;
      /// The first owned cover's global number and its number here.
      unsigned int              first_owned, first_owned_here, n_owned;
      std::vector<unsigned int> cover_to_expansion;
      Expansion                 expansion;

      /// Sets of mutually coupled covers; released by build().
      std::vector<unsigned int> stencil_begin, stencil_covers;

      /// Local numbers: owned covers first, then others, ascending.
      std::vector<unsigned int> cover_to_local;
      std::vector<unsigned int> ghost_covers; // global numbers
      unsigned int              n_rows            = 0;
      bool                      leaves_empty_rows = false;

      /// Block rows: columns in local numbers, ascending. Values lie as in the
      /// scalar matrix: both scalar rows of a block row one after the other.
      std::vector<std::size_t>  row_begin;
      std::vector<unsigned int> columns;
      std::vector<double>       values;
      std::vector<double>       right_hand_side;
      /// Where values are: in the vector, or in the matrix.
      double *entries          = nullptr;
      bool    is_made_in_place = false;
      /// Block rows that count.
      ActiveItems active_rows;
      /// By block row; empty: all are.
      std::vector<std::uint8_t> is_active_row;

      /// Per rank: rows sent and received, each as cover, n, n columns (global).
      std::vector<std::pair<unsigned int, std::vector<unsigned int>>> sent,
        received;

      /// A term of a constrained cover, or the identity of a free one, for the
      /// free cover at a position in local_covers.
      struct Part
      {
        unsigned int  position;
        const double *block;
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
