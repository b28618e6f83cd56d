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
          const double xi = axes[0] * (x - origin), eta = axes[1] * (x - origin);
          return eta * eta *
                 (std::sin(2. * xi) * axes[0] + std::cos(2. * xi) * axes[1]);
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          const double xi = axes[0] * (x - origin), eta = axes[1] * (x - origin);
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
          const double xi = axes[0] * (x - origin), eta = axes[1] * (x - origin);
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


      class PolynomialField : public SmoothField
      {
      public:
        PolynomialField(const unsigned int seed, const unsigned int degree)
        {
          std::mt19937 generator(seed);
          field = random_field(generator, degree);
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          return field.displacement(x);
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          return field.gradient(x);
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &e) const override
        {
          return field.body_force(e);
        }

      private:
        QuadraticField field;
      };
    } // namespace


    std::shared_ptr<const SmoothField>
    make_wave_field()
    {
      return std::make_shared<WaveField>();
    }


    std::shared_ptr<const SmoothField>
    make_free_surface_field(const Point<2>     &origin,
                            const Tensor<1, 2> &tangent)
    {
      return std::make_shared<FreeSurfaceField>(origin, tangent);
    }


    std::shared_ptr<const SmoothField>
    make_polynomial_field(const unsigned int seed, const unsigned int degree)
    {
      return std::make_shared<PolynomialField>(seed, degree);
    }
  } // namespace HardCases
} // namespace NMM
