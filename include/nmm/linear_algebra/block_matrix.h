#ifndef nmm_linear_algebra_block_matrix_h
#define nmm_linear_algebra_block_matrix_h

#include <deal.II/base/array_view.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace NMM
{
  /**
   * A square matrix of dense blocks A_ij, of which there are those that something is added
   * to: the tangent of many small bodies, of which each touches few others, and others
   * in the next iteration. A sparse matrix has to know beforehand what may touch, and has
   * places for it that are cleared, read and kept in memory for nothing: in a heap of
   * 2,000 bodies of 12 unknowns two of three.
   *
   * Unknowns of a block follow each other, block by block. One rank.
   */
  class BlockMatrix
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// Unknowns of a block: larger ones have zeros inside, of which this knows nothing.
    static constexpr unsigned int max_block = 64;

    /// With which blocks each block is coupled.
    using Couplings = std::vector<std::vector<unsigned int>>;

    /// Has no block more than max_block unknowns, and do they follow each other, block by
    /// block in the order of their numbers? Not if there are none.
    static bool
    is_suitable(const std::vector<unsigned int> &unknown_to_block);

    /// Without any row. @p unknown_to_block must be suitable.
    explicit BlockMatrix(const std::vector<unsigned int> &unknown_to_block);

    unsigned int
    n_blocks() const
    {
      return first_of_rows.size();
    }

    /// First unknown of a block; of the one after the last: the number of unknowns.
    unsigned int
    begin(const unsigned int block) const
    {
      return begins[block];
    }

    unsigned int
    size(const unsigned int block) const
    {
      return begins[block + 1] - begins[block];
    }

    unsigned int
    block_of(const unsigned int unknown) const
    {
      return unknown_to_block[unknown];
    }

    /// Nothing is there any more.
    void
    clear();

    /// Rows of @p blocks (empty: all) have nothing but zeros in the diagonal block. Until
    /// the next call nothing is added to rows of others, which stay as they are: a
    /// matrix can be made by parts. What was in rows that were there keeps its memory
    /// until clear().
    void
    begin_rows(const std::vector<bool> &blocks);

    /**
     * Add a local matrix (2n x 2n), row by row, to n @p covers, unknown c of cover k being
     * 2k + c. A cover may be named twice.
     */
    void
    add(dealii::ArrayView<const unsigned int> covers, const double *matrix);

    /// Add @p factor times a sparse matrix that couples no two blocks.
    void
    add(double factor, const Matrix &matrix);

    /// From now on this is @p matrix in rows of @p blocks (empty: all), as far as blocks
    /// are coupled with themselves and, both ways, by @p couplings, which say it one way
    /// at least, and has no other rows.
    void
    read(const Matrix            &matrix,
         const std::vector<bool> &blocks,
         const Couplings         &couplings);

    /// Call action(column, values) for blocks in a row, its own one first; values are
    /// (size of row x size of column), column by column.
    template <typename Action>
    void
    for_each_in_row(const unsigned int row, const Action &action) const
    {
      for (unsigned int i = first_of_rows[row]; i != none; i = entries[i].next)
        action(entries[i].column, values.data() + entries[i].begin);
    }

    /// As a sparse matrix, with zeros on the diagonal of rows that are not there.
    Matrix
    sparse() const;

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// A block, where its values begin, and the next one of the row.
    struct Entry
    {
      std::size_t  begin;
      unsigned int column, next;
    };

    bool
    is_active(const unsigned int block) const
    {
      return active.empty() || active[block];
    }

    /// Values of a block, which is there from then on; until another one is added.
    double *
    block(unsigned int row, unsigned int column);

    /// At the end of the row, or the first one.
    double *
    append(unsigned int row, unsigned int column);

    std::vector<unsigned int> unknown_to_block, begins;
    std::vector<bool>         active;
    /// By row, or none.
    std::vector<unsigned int> first_of_rows;
    std::vector<Entry>        entries;
    /// One block after the other, as they came: what an iteration works on lies together.
    std::vector<double> values;
  };
} // namespace NMM

#endif
