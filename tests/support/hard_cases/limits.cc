#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
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
