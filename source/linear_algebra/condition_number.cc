#include <nmm/base/exceptions.h>
#include <nmm/linear_algebra/condition_number.h>

#include <Eigen/Eigenvalues>
#include <functional>
#include <limits>
#include <linear_algebra/direct_solver.h>
#include <random>

namespace NMM
{
  namespace
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    struct Ritz
    {
      double       value   = 0.;
      unsigned int n_steps = 0;
      Vector       vector;
    };


    /// Compute the largest eigenvalue of the symmetric operator @p apply and its eigenvector.
    Ritz
    lanczos(const std::function<void(const Vector &, Vector &)> &apply,
            const Vector                                        &start,
            const double                                         tolerance)
    {
      constexpr unsigned int max_steps = 150;
      std::vector<Vector>    basis(1, start);
      basis[0] /= start.l2_norm();

      std::vector<double>                            alpha, beta;
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum;
      Vector                                         w(start);
      Ritz                                           result;
      while (true)
      {
        apply(basis.back(), w);
        alpha.push_back(w * basis.back());
        // because of rounding one orthogonalization is not enough, but two are (Kahan)
        for (unsigned int repeat = 0; repeat < 2; ++repeat)
          for (const Vector &v : basis)
            w.add(-(w * v), v);
        beta.push_back(w.l2_norm());

        const unsigned int n = alpha.size();
        Eigen::MatrixXd    T = Eigen::MatrixXd::Zero(n, n);
        for (unsigned int i = 0; i < n; ++i)
        {
          T(i, i) = alpha[i];
          if (i > 0)
            T(i, i - 1) = T(i - 1, i) = beta[i - 1];
        }
        spectrum.compute(T);
        result.value = spectrum.eigenvalues()(n - 1);
        const double residual =
          beta.back() * std::abs(spectrum.eigenvectors()(n - 1, n - 1));
        if (!std::isfinite(beta.back()) || n == max_steps ||
            residual <= tolerance * std::abs(result.value) ||
            beta.back() <= 1e-14 * std::abs(result.value))
          break;
        w /= beta.back();
        basis.push_back(w);
      }
      result.n_steps = alpha.size();
      result.vector.reinit(start);
      for (unsigned int i = 0; i < basis.size(); ++i)
        result.vector.add(
          spectrum.eigenvectors()(i, spectrum.eigenvectors().cols() - 1),
          basis[i]);
      return result;
    }


    /// Make a start vector of random entries in free rows, the same for any number of ranks.
    Vector
    make_start(const CoverSystem                       &covers,
               const dealii::AffineConstraints<double> &constraints)
    {
      const dealii::IndexSet owned = covers.locally_owned_dofs(2);
      Vector                 start(owned, covers.communicator());
      for (const auto i : owned)
      {
        std::minstd_rand random(static_cast<unsigned int>(i) + 1u);
        random.discard(3);
        start[i] = constraints.is_constrained(i)
                     ? 0.
                     : 0.5 + static_cast<double>(random()) /
                               static_cast<double>(random.max());
      }
      start.compress(dealii::VectorOperation::insert);
      return start;
    }


    /// The cover with the largest entry of @p vector, on all ranks.
    unsigned int
    largest_entry(const Vector &vector, const MPI_Comm communicator)
    {
      double       best  = -1.;
      unsigned int cover = invalid_index;
      for (const auto i : vector.locally_owned_elements())
        if (std::abs(vector[i]) > best)
        {
          best  = std::abs(vector[i]);
          cover = cover_of(i);
        }
      const auto all =
        dealii::Utilities::MPI::all_gather(communicator,
                                           std::make_pair(best, cover));
      for (const auto &[value, k] : all)
        if (value > best)
        {
          best  = value;
          cover = k;
        }
      return cover;
    }
  } // namespace


  double
  ConditionNumber::value() const
  {
    return smallest > 0. ? largest / smallest
                         : std::numeric_limits<double>::infinity();
  }


  ConditionNumber
  estimate_condition_number(
    const dealii::TrilinosWrappers::SparseMatrix &matrix,
    const CoverSystem                            &covers,
    const dealii::AffineConstraints<double>      &constraints,
    const double                                  tolerance)
  {
    const Vector start = make_start(covers, constraints);
    // scaling by D^(-1/2)
    Vector scaling(start);
    for (const auto i : start.locally_owned_elements())
    {
      const double diagonal = matrix.diag_element(i);
      AssertThrow(diagonal > 0.,
                  NumericalFailure("a diagonal entry of the matrix is " +
                                     std::to_string(diagonal),
                                   to_string(covers.node(cover_of(i))),
                                   "look for a part without stiffness or mass "
                                   "there"));
      scaling[i] = 1. / std::sqrt(diagonal);
    }
    scaling.compress(dealii::VectorOperation::insert);

    ConditionNumber result;
    Vector          scratch(start);
    const Ritz      largest = lanczos(
      [&](const Vector &x, Vector &y) {
        scratch = x;
        scratch.scale(scaling);
        matrix.vmult(y, scratch);
        y.scale(scaling);
      },
      start,
      tolerance);
    result.largest    = largest.value;
    result.n_products = largest.n_steps;

    internal::DirectSolver solver;
    try
    {
      solver.factorize(matrix);
    }
    catch (const NumericalFailure &)
    {
      return result;
    }
    Vector unscaling(start);
    for (const auto i : start.locally_owned_elements())
      unscaling[i] = 1. / scaling[i];
    unscaling.compress(dealii::VectorOperation::insert);
    const Ritz smallest = lanczos(
      [&](const Vector &x, Vector &y) {
        scratch = x;
        scratch.scale(unscaling);
        solver.solve(scratch, y);
        y.scale(unscaling);
      },
      start,
      tolerance);
    result.n_solves = smallest.n_steps;
    // the factorization of a matrix that is singular to rounding gives arbitrary results
    if (std::isfinite(smallest.value) && smallest.value > 0.)
    {
      result.smallest = 1. / smallest.value;
      result.weakest_cover =
        largest_entry(smallest.vector, covers.communicator());
      result.weakest_node = covers.node(result.weakest_cover);
    }
    return result;
  }
} // namespace NMM
