#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// Second derivatives [component][i][j].
      using Hessian = std::array<SymmetricTensor<2, 2>, 2>;

      /// f_i = -(lambda + mu) u_j,ji - mu u_i,jj
      Tensor<1, 2>
      body_force_of(const Hessian &h, const PlaneElasticity &e)
      {
        Tensor<1, 2> f;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            f[i] -= (e.lambda + e.mu) * h[j][i][j] + e.mu * h[i][j][j];
        return f;
      }


      class WaveField : public SmoothField
      {
      public:
        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          return Tensor<1, 2>({amplitude[0] * std::sin(argument(0, x)),
                               amplitude[1] * std::sin(argument(1, x))});
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          Tensor<2, 2> g;
          for (unsigned int c = 0; c < 2; ++c)
            g[c] = amplitude[c] * std::cos(argument(c, x)) * wave[c];
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &x, const PlaneElasticity &e) const override
        {
          Hessian h;
          for (unsigned int c = 0; c < 2; ++c)
            for (unsigned int i = 0; i < 2; ++i)
              for (unsigned int j = i; j < 2; ++j)
                h[c][i][j] = -amplitude[c] * std::sin(argument(c, x)) *
                             wave[c][i] * wave[c][j];
          return body_force_of(h, e);
        }

      private:
        double
        argument(const unsigned int c, const Point<2> &x) const
        {
          return wave[c] * x + phase[c];
        }

        const double       amplitude[2] = {1., 0.7};
        const double       phase[2]     = {0.4, 1.1};
        const Tensor<1, 2> wave[2]      = {Tensor<1, 2>({2.3, 1.7}),
                                           Tensor<1, 2>({-1.4, 2.6})};
      };


      class FreeSurfaceField : public SmoothField
      {
      public:
        FreeSurfaceField(const Point<2> &origin, const Tensor<1, 2> &tangent)
          : origin(origin)
        {
          axes[0] = tangent;
          axes[1] = Tensor<1, 2>({-tangent[1], tangent[0]});
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          const double xi  = axes[0] * (x - origin),
                       eta = axes[1] * (x - origin);
          return eta * eta *
                 (std::sin(2. * xi) * axes[0] + std::cos(2. * xi) * axes[1]);
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          const double xi  = axes[0] * (x - origin),
                       eta = axes[1] * (x - origin);
          const double s = std::sin(2. * xi), c = std::cos(2. * xi);
          Tensor<2, 2> local;
          local[0][0] = 2. * eta * eta * c;
          local[0][1] = 2. * eta * s;
          local[1][0] = -2. * eta * eta * s;
          local[1][1] = 2. * eta * c;
          // rows of axes are the local basis
          return transpose(axes) * local * axes;
        }

        Tensor<1, 2>
        body_force(const Point<2> &x, const PlaneElasticity &e) const override
        {
          const double xi  = axes[0] * (x - origin),
                       eta = axes[1] * (x - origin);
          const double s = std::sin(2. * xi), c = std::cos(2. * xi);
          Hessian      h;
          h[0][0][0] = -4. * eta * eta * s;
          h[0][0][1] = 4. * eta * c;
          h[0][1][1] = 2. * s;
          h[1][0][0] = -4. * eta * eta * c;
          h[1][0][1] = -4. * eta * s;
          h[1][1][1] = 2. * c;
          return transpose(axes) * body_force_of(h, e);
        }

      private:
        Point<2>     origin;
        Tensor<2, 2> axes;
      };


      class SolenoidalField : public SmoothField
      {
      public:
        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          Tensor<1, 2> u;
          for (unsigned int m = 0; m < 2; ++m)
            u += std::sin(wave[m] * x + phase[m]) * direction(m);
          return u;
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          Tensor<2, 2> g;
          for (unsigned int m = 0; m < 2; ++m)
            g += outer_product(direction(m),
                               std::cos(wave[m] * x + phase[m]) * wave[m]);
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &x, const PlaneElasticity &e) const override
        {
          // -mu laplace(u): no divergence, no part of lambda
          Tensor<1, 2> f;
          for (unsigned int m = 0; m < 2; ++m)
            f += e.mu * wave[m].norm_square() *
                 std::sin(wave[m] * x + phase[m]) * direction(m);
          return f;
        }

      private:
        Tensor<1, 2>
        direction(const unsigned int m) const
        {
          return Tensor<1, 2>({-wave[m][1], wave[m][0]}) / wave[m].norm();
        }

        const double       phase[2] = {0.4, 1.1};
        const Tensor<1, 2> wave[2]  = {Tensor<1, 2>({2.3, 1.7}),
                                       Tensor<1, 2>({-1.4, 2.6})};
      };


      /// With s = P / (E I): the cubic displacement that has sigma_x = E s
      /// (L - x) y and tau = -E s (1/4 - y^2) / 2; see make_beam_field().
      class BeamField : public SmoothField
      {
      public:
        BeamField(const double length, const Material &material)
          : length(length)
          , nu(material.poissons_ratio)
          , s(3. / (length * length * length))
        {
        }

        Tensor<1, 2>
        displacement(const Point<2> &p) const override
        {
          const double x = p[0], y = p[1];
          return Tensor<1, 2>(
            {s * (y * (length * x - 0.5 * x * x) + (2. + nu) * y * y * y / 6. -
                  (1. + nu) * y / 4.),
             -s * (x * x * (3. * length - x) / 6. +
                   0.5 * nu * y * y * (length - x))});
        }

        Tensor<2, 2>
        gradient(const Point<2> &p) const override
        {
          const double x = p[0], y = p[1];
          Tensor<2, 2> g;
          g[0][0] = s * y * (length - x);
          g[0][1] = s * (length * x - 0.5 * x * x + (2. + nu) * y * y / 2. -
                         (1. + nu) / 4.);
          g[1][0] = -s * (length * x - 0.5 * x * x - 0.5 * nu * y * y);
          g[1][1] = -s * nu * y * (length - x);
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &) const override
        {
          return Tensor<1, 2>();
        }

      private:
        double length, nu, s;
      };


      class PolynomialField : public SmoothField
      {
      public:
        PolynomialField(const unsigned int seed,
                        const unsigned int degree,
                        const Point<2>    &center)
          : center(center)
        {
          std::mt19937 generator(seed);
          field = random_field(generator, degree);
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          return field.displacement(Point<2>(x - center));
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          return field.gradient(Point<2>(x - center));
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &e) const override
        {
          return field.body_force(e);
        }

      private:
        Point<2>       center;
        QuadraticField field;
      };
    } // namespace


    std::shared_ptr<const SmoothField>
    make_wave_field()
    {
      return std::make_shared<WaveField>();
    }


    std::shared_ptr<const SmoothField>
    make_free_surface_field(const Point<2> &origin, const Tensor<1, 2> &tangent)
    {
      return std::make_shared<FreeSurfaceField>(origin, tangent);
    }


    std::shared_ptr<const SmoothField>
    make_solenoidal_field()
    {
      return std::make_shared<SolenoidalField>();
    }


    std::shared_ptr<const SmoothField>
    make_beam_field(const double length, const Material &material)
    {
      return std::make_shared<BeamField>(length, material);
    }


    std::shared_ptr<const SmoothField>
    make_polynomial_field(const unsigned int seed,
                          const unsigned int degree,
                          const Point<2>    &center)
    {
      return std::make_shared<PolynomialField>(seed, degree, center);
    }
  } // namespace HardCases
} // namespace NMM
