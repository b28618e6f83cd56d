#ifndef nmm_linear_algebra_body_matrix_h
#define nmm_linear_algebra_body_matrix_h

#include <deal.II/base/array_view.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace NMM
{
  /**
   * The square tangent matrix of many small bodies,
   * @f[ A = (A_{ij}), \qquad A_{ij}\in\mathbb R^{n_i\times n_j}, @f]
   * where A_ij is the dense *coupling* of body i, which has n_i unknowns, with body j.
   * Only couplings that something is added to are stored.
   *
   * Each body touches few others, and other ones in the next iteration. A sparse matrix has
   * to know its pattern beforehand; in a heap of 2,000 bodies of 12 unknowns two of three
   * entries of such a pattern would be places for contact that is not closed.
   *
   * The unknowns of a body follow each other, body by body. One rank.
   */
  class BodyMatrix
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// Unknowns of the largest body: matrices of larger ones are sparse themselves.
    static constexpr unsigned int max_body = 64;

    /// For each body, the bodies that it is coupled with.
    using Couplings = std::vector<std::vector<unsigned int>>;

    /// Whether no body has more than max_body unknowns, and unknowns follow each other,
    /// body by body in the order of their numbers. False if there are none.
    static bool
    is_suitable(const std::vector<unsigned int> &unknown_to_body);

    /// Make a matrix without any row. @p unknown_to_body must be suitable.
    explicit BodyMatrix(const std::vector<unsigned int> &unknown_to_body);

    unsigned int
    n_bodies() const
    {
      return first_of_rows.size();
    }

    /// First unknown of a body; begin(n_bodies()) is the number of unknowns.
    unsigned int
    begin(const unsigned int body) const
    {
      return begins[body];
    }

    /// Number of unknowns of a body.
    unsigned int
    size(const unsigned int body) const
    {
      return begins[body + 1] - begins[body];
    }

    unsigned int
    body_of(const unsigned int unknown) const
    {
      return unknown_to_body[unknown];
    }

    /// Remove all rows.
    void
    clear();

    /**
     * Start the rows of @p bodies (empty: all) anew, with a zero coupling of each body with
     * itself. Until the next call add() changes these rows only and leaves others as
     * they are, so that a matrix can be assembled in parts. The memory of the old rows is
     * kept until clear().
     */
    void
    begin_rows(const std::vector<bool> &bodies);

    /**
     * Add a local matrix (2n x 2n), row by row, to n @p covers; unknown c of cover k is
     * unknown 2k + c of this matrix. A cover may be named twice.
     */
    void
    add(dealii::ArrayView<const unsigned int> covers, const double *matrix);

    /// Add @p factor times a sparse matrix that couples no body with another.
    void
    add(double factor, const Matrix &matrix);

    /// Become a copy of the rows of @p bodies (empty: all) of @p matrix. Read are
    /// couplings of bodies with themselves and, in both directions, those of
    /// @p neighbors, which has to name each pair in one direction at least.
    void
    read(const Matrix            &matrix,
         const std::vector<bool> &bodies,
         const Couplings         &neighbors);

    /// Call action(column, values) for the couplings of a body, the one with itself
    /// first; values are (size(row) x size(column)), column by column.
    template <typename Action>
    void
    for_each_in_row(const unsigned int row, const Action &action) const
    {
      for (unsigned int i = first_of_rows[row]; i != none;
           i              = couplings[i].next)
        action(couplings[i].column, values.data() + couplings[i].begin);
    }

    /// The same as a sparse matrix, with zeros on the diagonal of rows that are not there.
    Matrix
    sparse() const;

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// Where the values of a coupling begin, and the next coupling of the row.
    struct Coupling
    {
      std::size_t  begin;
      unsigned int column, next;
    };

    bool
    is_active(const unsigned int body) const
    {
      return active.empty() || active[body];
    }

    /// Values of a coupling, which is made if need be. Valid until another one is made.
    double *
    coupling(unsigned int row, unsigned int column);

    /// Make a coupling at the end of its row.
    double *
    append(unsigned int row, unsigned int column);

    std::vector<unsigned int> unknown_to_body, begins;
    std::vector<bool>         active;
    /// First coupling of each row, or none.
    std::vector<unsigned int> first_of_rows;
    std::vector<Coupling>     couplings;
    /// Values in the order in which couplings were made, so that what an iteration works
    /// on lies together.
    std::vector<double> values;
  };
} // namespace NMM

#endif
