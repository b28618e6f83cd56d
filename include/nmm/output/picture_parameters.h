#ifndef nmm_output_picture_parameters_h
#define nmm_output_picture_parameters_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace NMM
{
  /// What a picture can be coloured by.
  enum class Quantity
  {
    von_mises,
    stress_xx,
    stress_yy,
    stress_xy,
    first_principal,
    second_principal,
    radial_stress,
    hoop_stress,
    displacement,
    displacement_x,
    displacement_y,
    velocity,
    velocity_x,
    velocity_y,
    plastic_strain,
    block,
    material
  };

  /// All of them.
  const std::vector<Quantity> &
  all_quantities();

  /// Its name, e.g. "von Mises stress".
  std::string
  to_string(Quantity quantity);

  /// Is it a component of the velocity, or its length?
  bool
  is_velocity(Quantity quantity);


  /// How pictures and animations show the fields.
  struct PictureParameters
  {
    Quantity quantity = Quantity::von_mises;
    /// What an animation can be coloured by beside `quantity`, by choice.
    std::vector<Quantity> animation_quantities;
    /// Colour by the recovered instead of the direct stress.
    bool recovered = true;
    /// Centre of the polar coordinates of radial and hoop stress [m].
    dealii::Point<2> center;
    /// Factor on displacements in the picture [-]; negative: chosen so that the
    /// largest displacement is 5 % of the solid's size.
    double deformation_scale = -1.;
    /// Values at the ends of the colour bar; equal: those of the solution.
    double       range_min = 0., range_max = 0.;
    bool         mesh_lines    = true;
    unsigned int picture_width = 1600;
    std::string  length_unit = "m", stress_unit = "Pa";
  };
} // namespace NMM

#endif
