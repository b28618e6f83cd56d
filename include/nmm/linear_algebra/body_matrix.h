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
   * Only couplings to which something is added are stored.
   *
   * Each body touches few others, and which ones changes from iteration to iteration. A sparse
   * matrix needs its pattern beforehand: in a heap of 2,000 bodies of 12 unknowns two thirds of
   * the entries of such a pattern would belong to contacts that are not closed.
   *
   * The unknowns of each body are numbered consecutively, in the order of the bodies. The class
   * works on one rank only.
   */
  class BodyMatrix
  {
  public:
    /// The sparse matrices that are read, added or returned.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// Largest number of unknowns of a body. The matrices of larger bodies are themselves sparse.
    static constexpr unsigned int max_body = 64;

    /// For each body, the numbers of the bodies that it is coupled with.
    using Couplings = std::vector<std::vector<unsigned int>>;

    /// Whether no body has more than max_body unknowns, and the unknowns of each body are
    /// numbered consecutively, in the order of the bodies. False if there are no unknowns.
    static bool
    is_suitable(const std::vector<unsigned int> &unknown_to_body);

    /// Make a matrix without any coupling. @p unknown_to_body gives the body of each unknown and
    /// must satisfy is_suitable().
    explicit BodyMatrix(const std::vector<unsigned int> &unknown_to_body);

    /// Number of bodies, whether their rows are stored or not.
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

    /// Body of an unknown.
    unsigned int
    body_of(const unsigned int unknown) const
    {
      return unknown_to_body[unknown];
    }

    /// Remove everything, and begin the rows of @p bodies (empty: all) with a zero coupling of each
    /// body with itself. Only these rows are stored, and add() leaves out all others.
    void
    begin_rows(const std::vector<bool> &bodies);

    /**
     * Add a local matrix (2n x 2n, stored row by row) of n @p covers. Component c of cover k is
     * unknown 2k + c of this matrix. A cover may be named more than once.
     */
    void
    add(dealii::ArrayView<const unsigned int> covers, const double *matrix);

    /// Add @p factor times a sparse matrix that couples no two different bodies.
    void
    add(double factor, const Matrix &matrix);

    /// Replace this matrix by the rows of @p bodies (empty: all) of @p matrix. The couplings of
    /// each body with itself are read, and those of the pairs in @p neighbors in both directions;
    /// @p neighbors must contain each pair in at least one direction.
    void
    read(const Matrix            &matrix,
         const std::vector<bool> &bodies,
         const Couplings         &neighbors);

    /// Call action(column, values) for each coupling of body @p row, the one with itself first;
    /// values has the shape size(row) x size(column) and is stored column by column.
    template <typename Action>
    void
    for_each_in_row(const unsigned int row, const Action &action) const
    {
      for (unsigned int i = first_of_rows[row]; i != none;
           i              = couplings[i].next)
        action(couplings[i].column, values.data() + couplings[i].begin);
    }

    /// A copy as a sparse matrix. Rows that are not stored get a zero on the diagonal.
    Matrix
    sparse() const;

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// Index of a coupling's first entry in values, its column, and the index of the next
    /// coupling of the same row, or none.
    struct Coupling
    {
      std::size_t  begin;
      unsigned int column, next;
    };

    bool
    is_stored(const unsigned int body) const
    {
      return stored.empty() || stored[body];
    }

    /// Values of a coupling, which is created if it does not exist. The pointer is valid until
    /// another coupling is created.
    double *
    coupling(unsigned int row, unsigned int column);

    /// Append a coupling with zero values to the end of its row.
    double *
    append(unsigned int row, unsigned int column);

    std::vector<unsigned int> unknown_to_body, begins;
    std::vector<bool>         stored;
    /// First coupling of each row, or none.
    std::vector<unsigned int> first_of_rows;
    std::vector<Coupling>     couplings;
    /// Values of all couplings in the order in which these were created, so that the rows
    /// assembled in an iteration are contiguous in memory.
    std::vector<double> values;
  };
} // namespace NMM

#endif
