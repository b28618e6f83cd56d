#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// u_r = A r for r < a, B r + C / r beyond; see bonded_inclusion().
      class InclusionField : public SmoothField
      {
      public:
        InclusionField(const double           a,
                       const PlaneElasticity &inside,
                       const PlaneElasticity &outside)
          : a(a)
        {
          // with A = 1: continuous displacement and radial stress at a
          //   B + C / a^2 = 1
          //   2 (l + m) B - 2 m C / a^2 = 2 (l_i + m_i)
          const double k_i = 2. * (inside.lambda + inside.mu),
                       k   = 2. * (outside.lambda + outside.mu),
                       m   = 2. * outside.mu;
          B                = (k_i + m) / (k + m);
          C                = a * a * (1. - B);
          A                = 1.;
          const double rim = B + C;
          A /= rim;
          B /= rim;
          C /= rim;
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          return (x.norm() < a ? A : B + C / x.norm_square()) * Tensor<1, 2>(x);
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          Tensor<2, 2> g;
          const double r2 = x.norm_square();
          const bool   in = r2 < a * a;
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              g[i][j] = (i == j ? (in ? A : B + C / r2) : 0.) -
                        (in ? 0. : 2. * C * x[i] * x[j] / (r2 * r2));
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &) const override
        {
          return Tensor<1, 2>();
        }

      private:
        double a, A, B, C;
      };
    } // namespace


    Result
    bonded_inclusion(const double        contrast,
                     const double        cell_size,
                     const Stabilization stabilization,
                     const Measure      &what)
    {
      constexpr double a        = 0.5;
      Geometry         geometry = make_disk();
      geometry.add_circle({0., 0.}, a, "bond", CurveRole::interface);
      geometry.add_material_point({0., 0.}, "inclusion");
      geometry.add_material_point({0., 0.75}, "matrix");
      Model          model(std::move(geometry),
                  mesh_parameters(cell_size,
                                  Tensor<1, 2>(
                                    {0.3 * cell_size, 0.1 * cell_size}),
                                  13.),
                  2,
                  stabilization);
      const Material inclusion = material("inclusion", 1000. * contrast, 0.3),
                     matrix    = material("matrix", 1000., 0.3);
      const auto field         = std::make_shared<InclusionField>(
        a,
        inclusion.plane_elasticity(PlaneState::plane_strain),
        matrix.plane_elasticity(PlaneState::plane_strain));
      prescribe(
        model, field, matrix, PlaneState::plane_strain, {"right"}, {"left"});
      model.problem.materials.push_back(inclusion);
      char variant[60];
      std::snprintf(variant,
                    sizeof(variant),
                    "inclusion, stiffness 1 : %g, h %g",
                    contrast,
                    cell_size);
      return measure(model, *field, variant, stabilization, what);
    }


    Result
    nearly_incompressible(const double        poissons_ratio,
                          const double        cell_size,
                          const Stabilization stabilization,
                          const Measure      &what)
    {
      Model      model(make_disk(),
                  mesh_parameters(cell_size,
                                  Tensor<1, 2>(
                                    {0.3 * cell_size, 0.1 * cell_size}),
                                  13.),
                  2,
                  stabilization);
      const auto field = make_solenoidal_field();
      prescribe(model,
                field,
                material("rock", 1000., poissons_ratio),
                PlaneState::plane_strain,
                {"left"},
                {"right"});
      char variant[60];
      std::snprintf(
        variant, sizeof(variant), "nu %g, h %g", poissons_ratio, cell_size);
      return measure(model, *field, variant, stabilization, what);
    }


    Result
    slender_beam(const double        length,
                 const double        cell_size,
                 const Stabilization stabilization,
                 const Measure      &what)
    {
      Geometry geometry;
      add_box(geometry, {0., -0.5}, {length, 0.5});
      Model          model(std::move(geometry),
                  mesh_parameters(cell_size,
                                  Tensor<1, 2>(
                                    {0.3 * cell_size, 0.1 * cell_size}),
                                  13.),
                  2,
                  stabilization);
      const Material m     = material("steel", 1000., 0.3);
      const auto     field = make_beam_field(length, m);
      prescribe(model,
                field,
                m,
                PlaneState::plane_stress,
                {"left"},
                {"right", "top", "bottom"});
      char variant[60];
      std::snprintf(
        variant, sizeof(variant), "1 : %g, h %g", length, cell_size);
      return measure(model, *field, variant, stabilization, what);
    }
  } // namespace HardCases
} // namespace NMM
