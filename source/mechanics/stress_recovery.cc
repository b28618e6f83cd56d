#include <nmm/mechanics/stress_recovery.h>

#include <algorithm>
#include <cmath>
#include <mechanics/recovery_patch.h>

namespace NMM
{ using dealii::Point;
  namespace
  {
    constexpr unsigned int n_max = 10;

    /// Monomials of degree at most 3 (or the first six, of degree 2).
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
     * Least-squares fit of two functions by normal equations. Monomials scaled
     * to the patch keep their condition number near 1e5, so that they lose half
     * of a double's digits at worst, far below the discretization's error.
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
      add(const double x, const double y, const dealii::Tensor<1, 2> value,double w)
      {
        double m[n_max];
        monomials(x, y, m);
        for (unsigned int i = 0; i < n; ++i)
        {
          for (unsigned int j = 0; j <= i; ++j)
            matrix[i][j] += w*m[i] * m[j];
          rhs[0][i] += w*m[i] * value[0];
          rhs[1][i] += w*m[i] * value[1];
        }
      }

      /// Cholesky in place; false if singular to rounding.
      bool
      factorize()
      {
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

      /// How much the fit amplifies errors of the values in the gradient at the
      /// centre: root of the variances' sum.
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
      double       matrix[n_max][n_max];
      double       rhs[2][n_max];
    };
  } // namespace


  StressRecovery::StressRecovery(const DisplacementField &field,
                                 const Aggregation       &aggregation)
    : field(&field)
    , cover_to_polynomial(field.cover_system().n_covers(), invalid_index)
  {
    const CoverSystem      &covers            = field.cover_system();
    const ManifoldMesh     &mesh              = covers.manifold_mesh();
    const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
    const unsigned int      degree            = mathematical_mesh.degree();
    const unsigned int      n                 = (degree + 2) * (degree + 3) / 2;
    constexpr unsigned int  max_rings         = 3;
    const double            max_amplification =
      std::getenv("AMP") ? atof(std::getenv("AMP")) : 3.;

    internal::RecoveryPatches patches(covers, aggregation);
    const auto [first, last] = covers.locally_owned_elements();
    std::vector<bool> done(covers.n_covers(), false);
    for (unsigned int e = first; e < last; ++e)
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const unsigned int cover = covers.covers(e)[corner];
        if (done[cover])
          continue;
        done[cover] = true;
        if (patches.sees_both_sides(cover))
        {
          ++direct;
          continue;
        }

        Polynomial polynomial;
        polynomial.center = covers.node(cover);
        polynomial.scale  = mathematical_mesh.cell_diameter(mesh.cell(e));
        patches.start(cover);
        bool found = false;
        for (unsigned int ring = 0; ring <= max_rings && !found; ++ring)
        {
          if (ring > 0 && !patches.widen())
            break;
          static const int OPT_MINR=getenv("MINR")?atoi(getenv("MINR")):0, OPT_INT=getenv("MINRI")?atoi(getenv("MINRI")):0; static const int OPT_EX=getenv("EX")?atoi(getenv("EX")):0; static const double OPT_W=getenv("WOUT")?atof(getenv("WOUT")):1., OPT_WD=getenv("WD")?atof(getenv("WD")):0;
          static std::vector<char> whole; if(ring==0&&whole.size()!=covers.n_covers()){whole.assign(covers.n_covers(),0); for(unsigned q=0;q<mesh.n_elements();++q) if(mesh.is_whole(q)) for(unsigned k:covers.covers(q)) whole[k]=1;}
          static bool bnd; if(ring==0){bnd=false; for(unsigned k:patches.samples()) if(!whole[k]) bnd=true; if(patches.samples().size()<(degree==2?19:7)) bnd=true;}
          if(bnd && (int)ring<OPT_MINR) continue; if(!bnd&&(int)ring<OPT_INT) continue;
          if (patches.samples().size() < n)
            continue;
          LeastSquares fit(n);
          for (const unsigned int k : patches.samples())
          {
            const dealii::Tensor<1, 2> d =
              (covers.node(k) - polynomial.center) / polynomial.scale;
            if(OPT_EX&&!whole[k]) continue; double w=whole[k]?1:OPT_W; w/=1+OPT_WD*d.norm_square(); fit.add(d[0], d[1], field.nodal_value(k),w);
          }
          static const double OPT_IN=getenv("WIN")?atof(getenv("WIN")):0; static const int OPT_ME=getenv("ME")?atoi(getenv("ME")):1;
          if(OPT_IN>0) for(unsigned pe:patches.elements()) if(!mesh.is_whole(pe)) for(auto&ed:mesh.edges(pe)) { for(int mid=0;mid<=OPT_ME;++mid){ Point<2> x=mid?Point<2>(0.5*(ed.start+ed.end)):ed.start; if(mid&&ed.is_arc()){auto dd=x-ed.center; x=ed.center+dd/dd.norm()*std::abs(ed.radius);} dealii::Tensor<1,2> d=(x-polynomial.center)/polynomial.scale; fit.add(d[0],d[1],field.displacement(pe,mathematical_mesh.real_to_reference(mesh.cell(pe),x)),OPT_IN/(1+OPT_WD*d.norm_square())); } }
          if (!fit.factorize() || fit.amplification() > max_amplification)
            continue;
          fit.solve(polynomial.coefficients);
          found = true;
        }
        if (found)
        {
          cover_to_polynomial[cover] = polynomials.size();
          polynomials.push_back(polynomial);
        }
        else
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
      gradient += direct_share * field->gradient(element, xi);
    return gradient;
  }


  dealii::SymmetricTensor<2, 2>
  StressRecovery::stress(const unsigned int      element,
                         const dealii::Point<2> &xi) const
  {
    return field->stress_from_gradient(element, gradient(element, xi));
  }


  unsigned int
  StressRecovery::n_direct() const
  {
    return direct;
  }
} // namespace NMM
