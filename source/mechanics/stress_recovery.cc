#include <nmm/covers/point_location.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/stress_recovery.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <mechanics/recovery_patch.h>

namespace NMM
{
  namespace
  {
    constexpr unsigned int n_max = 10;

    /// Evaluate the monomials of degree at most 3. The first six of them are those of degree at
    /// most 2.
    inline void
    monomials(const double x, const double y, double *m)
    {
      m[0] = 1.;
      m[1] = x;
      m[2] = y;
      m[3] = x * x;
      m[4] = x * y;
      m[5] = y * y;
      m[6] = x * m[3];
      m[7] = y * m[3];
      m[8] = x * m[5];
      m[9] = y * m[5];
    }


    /**
     * Weighted least-squares fit of two functions by normal equations. Because monomials are scaled
     * by the size of the patch, the condition number is about 1e5. So at most half
     * of the digits of a double are lost, and the error is far below that of the discretization.
     */
    class LeastSquares
    {
    public:
      explicit LeastSquares(const unsigned int n)
        : n(n)
      {
        std::fill_n(&matrix[0][0], n_max * n_max, 0.);
        std::fill_n(&rhs[0][0], 2 * n_max, 0.);
      }

      void
      add(const double                x,
          const double                y,
          const dealii::Tensor<1, 2> &value,
          const double                weight)
      {
        ++n_samples;
        double m[n_max];
        monomials(x, y, m);
        for (unsigned int i = 0; i < n; ++i)
        {
          const double factor = weight * m[i];
          for (unsigned int j = 0; j <= i; ++j)
            matrix[i][j] += factor * m[j];
          rhs[0][i] += factor * value[0];
          rhs[1][i] += factor * value[1];
        }
      }

      /// Factorize the normal equations in place by Cholesky's method. Returns false if they are
      /// singular to rounding.
      bool
      factorize()
      {
        if (n_samples < n)
          return false;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double diagonal = matrix[i][i];
          for (unsigned int j = 0; j <= i; ++j)
          {
            double sum = matrix[i][j];
            for (unsigned int k = 0; k < j; ++k)
              sum -= matrix[i][k] * matrix[j][k];
            if (j < i)
              matrix[i][j] = sum / matrix[j][j];
            else if (sum <= 1e-9 * diagonal)
              return false;
            else
              matrix[i][i] = std::sqrt(sum);
          }
        }
        return true;
      }

      /// Amplification of errors of the samples in the gradient at the centre: the root of the sum
      /// of the variances of its components.
      double
      amplification() const
      {
        double sum = 0.;
        for (unsigned int d = 1; d <= 2; ++d)
        {
          double y[n_max] = {};
          for (unsigned int i = d; i < n; ++i)
          {
            double s = i == d ? 1. : 0.;
            for (unsigned int k = d; k < i; ++k)
              s -= matrix[i][k] * y[k];
            y[i] = s / matrix[i][i];
            sum += y[i] * y[i];
          }
        }
        return std::sqrt(sum);
      }

      void
      solve(std::array<std::array<double, 10>, 2> &coefficients) const
      {
        for (unsigned int c = 0; c < 2; ++c)
        {
          std::array<double, 10> &x = coefficients[c];
          x.fill(0.);
          for (unsigned int i = 0; i < n; ++i)
          {
            double s = rhs[c][i];
            for (unsigned int k = 0; k < i; ++k)
              s -= matrix[i][k] * x[k];
            x[i] = s / matrix[i][i];
          }
          for (unsigned int i = n; i-- > 0;)
          {
            double s = x[i];
            for (unsigned int k = i + 1; k < n; ++k)
              s -= matrix[k][i] * x[k];
            x[i] = s / matrix[i][i];
          }
        }
      }

    private:
      unsigned int n;
      unsigned int n_samples = 0;
      double       matrix[n_max][n_max];
      double       rhs[2][n_max];
    };
  } // namespace


  namespace
  {
    /// Collect the values of all covers on every rank, because patches extend beyond the locally
    /// relevant covers.
    std::vector<dealii::Tensor<1, 2>>
    gather_values(const DisplacementField &field)
    {
      const CoverSystem                &covers = field.cover_system();
      std::vector<dealii::Tensor<1, 2>> values(covers.n_covers());
      if (dealii::Utilities::MPI::n_mpi_processes(covers.communicator()) == 1)
        for (unsigned int k = 0; k < covers.n_covers(); ++k)
          values[k] = field.nodal_value(k);
      else
      {
        std::vector<double> owned;
        for (const unsigned int k : covers.locally_owned_covers())
          for (unsigned int c = 0; c < 2; ++c)
            owned.push_back(field.nodal_value(k)[c]);
        // each rank owns consecutive covers, so that the parts are in the order of the covers
        unsigned int i = 0;
        for (const std::vector<double> &part :
             dealii::Utilities::MPI::all_gather(covers.communicator(), owned))
          for (const double value : part)
          {
            values[cover_of(i)][component_of(i)] = value;
            ++i;
          }
      }
      return values;
    }


    dealii::Point<2>
    edge_middle(const ElementEdge &edge)
    {
      if (!edge.is_arc())
        return dealii::Point<2>(0.5 * (edge.start + edge.end));
      const double angle =
        angle_about(edge.center, edge.start) + 0.5 * swept_angle(edge);
      return edge.center +
             std::abs(edge.radius) *
               dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)});
    }


    /// Fits the polynomial of a patch to samples of the displacement.
    class PatchFit
    {
    public:
      PatchFit(const CoverSystem                       &covers,
               const std::vector<dealii::Tensor<1, 2>> &values)
        : covers(covers)
        , values(values)
        , degree(covers.manifold_mesh().mathematical_mesh().degree())
      {
      }

      /// Set up the normal equations of the fit, without factorizing them.
      LeastSquares
      operator()(const internal::RecoveryPatches &patch,
                 const dealii::Point<2>          &center,
                 const double                     scale) const
      {
        LeastSquares fit((degree + 2) * (degree + 3) / 2);
        for (const unsigned int k : patch.samples())
          add(covers.node(k), values[k], 1., center, scale, fit);
        for (const unsigned int e : patch.cut_elements())
          for (const ElementEdge &edge : covers.manifold_mesh().edges(e))
            for (const dealii::Point<2> &x : {edge.start, edge_middle(edge)})
              add(x, displacement(e, x), cut_weight, center, scale, fit);
        return fit;
      }

    private:
      /// Weight of a sample inside a cut element [-]. It is below 1, because only the nodes of
      /// whole elements are superconvergent. Chosen by tests with the thick ring at 14
      /// positions of the mesh, in which weights from 0.1 to 1 made little difference.
      static constexpr double cut_weight = 0.3;

      static void
      add(const dealii::Point<2>     &x,
          const dealii::Tensor<1, 2> &value,
          const double                weight,
          const dealii::Point<2>     &center,
          const double                scale,
          LeastSquares               &fit)
      {
        fit.add((x[0] - center[0]) / scale,
                (x[1] - center[1]) / scale,
                value,
                weight);
      }

      dealii::Tensor<1, 2>
      displacement(const unsigned int element, const dealii::Point<2> &x) const
      {
        const ManifoldMesh &mesh = covers.manifold_mesh();
        double              w[WeightFunctions::max_per_cell];
        WeightFunctions::values(
          degree,
          mesh.mathematical_mesh().real_to_reference(mesh.cell(element), x),
          w);
        dealii::Tensor<1, 2> u;
        unsigned int         i = 0;
        for (const unsigned int k : covers.covers(element))
          u += w[i++] * values[k];
        return u;
      }

      const CoverSystem                       &covers;
      const std::vector<dealii::Tensor<1, 2>> &values;
      unsigned int                             degree;
    };
  } // namespace


  StressRecovery::StressRecovery(const DisplacementField &field,
                                 const Aggregation       &aggregation)
    : field(&field)
    , cover_to_polynomial(field.cover_system().n_covers(), invalid_index)
  {
    const CoverSystem  &covers = field.cover_system();
    const ManifoldMesh &mesh   = covers.manifold_mesh();

    // Rings are added until the amplification is small enough. It is 0.5 for a complete patch in
    // the interior and up to 3 for a one-sided one; above 10 the fit would be an extrapolation.
    constexpr unsigned int max_rings         = 3;
    constexpr double       max_amplification = 10.;

    const std::vector<dealii::Tensor<1, 2>> values = gather_values(field);
    const PatchFit                          fit_patch(covers, values);
    internal::RecoveryPatches               patch(covers, aggregation);
    std::vector<bool>                       done(covers.n_covers(), false);
    const auto [first, last] = covers.locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const unsigned int cover = covers.covers(e)[corner];
        if (done[cover])
          continue;
        done[cover] = true;

        bool found = false;
        if (!patch.sees_both_sides(cover))
        {
          Polynomial polynomial;
          polynomial.center = covers.node(cover);
          polynomial.scale =
            mesh.mathematical_mesh().cell_diameter(mesh.cell(e));
          patch.start(cover);
          for (unsigned int ring = 0; ring <= max_rings && !found; ++ring)
          {
            if (ring > 0 && !patch.widen())
              break;
            LeastSquares fit =
              fit_patch(patch, polynomial.center, polynomial.scale);
            if (fit.factorize() && fit.amplification() < max_amplification)
            {
              fit.solve(polynomial.coefficients);
              cover_to_polynomial[cover] = polynomials.size();
              polynomials.push_back(polynomial);
              found = true;
            }
          }
        }
        if (!found)
          ++direct;
      }
  }


  dealii::Tensor<2, 2>
  StressRecovery::polynomial_gradient(const Polynomial       &polynomial,
                                      const dealii::Point<2> &x) const
  {
    const dealii::Tensor<1, 2> d = (x - polynomial.center) / polynomial.scale;
    const double               X = d[0], Y = d[1];
    dealii::Tensor<2, 2>       gradient;
    for (unsigned int c = 0; c < 2; ++c)
    {
      const std::array<double, 10> &a = polynomial.coefficients[c];
      gradient[c][0] = a[1] + 2. * a[3] * X + a[4] * Y + 3. * a[6] * X * X +
                       2. * a[7] * X * Y + a[8] * Y * Y;
      gradient[c][1] = a[2] + a[4] * X + 2. * a[5] * Y + a[7] * X * X +
                       2. * a[8] * X * Y + 3. * a[9] * Y * Y;
    }
    return gradient / polynomial.scale;
  }


  dealii::Tensor<2, 2>
  StressRecovery::gradient(const unsigned int      element,
                           const dealii::Point<2> &xi) const
  {
    const CoverSystem     &covers = field->cover_system();
    const dealii::Point<2> x =
      covers.manifold_mesh().mathematical_mesh().reference_to_real(
        covers.manifold_mesh().cell(element), xi);
    const double lambda[3] = {1. - xi[0] - xi[1], xi[0], xi[1]};

    dealii::Tensor<2, 2> gradient;
    double               direct_share = 0.;
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const unsigned int p =
        cover_to_polynomial[covers.covers(element)[corner]];
      if (p == invalid_index)
        direct_share += lambda[corner];
      else
        gradient += lambda[corner] * polynomial_gradient(polynomials[p], x);
    }
    if (direct_share != 0.)
      gradient += direct_share * field->gradient_of_covers(element, xi);
    return gradient + field->gradient_of_disks(element, xi);
  }


  dealii::SymmetricTensor<2, 2>
  StressRecovery::stress(const unsigned int      element,
                         const dealii::Point<2> &xi) const
  {
    return field->stress_from_gradient(element, xi, gradient(element, xi));
  }


  unsigned int
  StressRecovery::n_direct() const
  {
    return direct;
  }
} // namespace NMM
