#ifndef nmm_output_picture_parameters_h
#define nmm_output_picture_parameters_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace NMM
{
  /// The quantities by which a picture can be coloured.
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

  /// All quantities, in the order of the enumeration.
  const std::vector<Quantity> &
  all_quantities();

  /// The name of a quantity in scenes and pictures, e.g. "von Mises stress".
  std::string
  to_string(Quantity quantity);

  /// Whether the quantity is a component of the velocity, or its length.
  bool
  is_velocity(Quantity quantity);


  /// How pictures and animations show the fields.
  struct PictureParameters
  {
    /// The quantity that colours the triangles.
    Quantity quantity = Quantity::von_mises;
    /// Further quantities among which the reader of an animation can choose.
    std::vector<Quantity> animation_quantities;
    /// Whether stresses are recovered ones instead of direct ones, see FieldSample.
    bool recovered = true;
    /// Centre of the polar coordinates of radial and hoop stress [m].
    dealii::Point<2> center;
    /// Factor on displacements in the picture [-]; negative: chosen so that the
    /// largest displacement is 5 % of the solid's size.
    double deformation_scale = -1.;
    /// Value at the lower end of the colour bar, in the unit of the quantity.
    double range_min = 0.;
    /// Value at the upper end of the colour bar; if it equals range_min, the bar spans the
    /// values of the solution.
    double range_max = 0.;
    /// Part of the plane that is shown: left, lower, right and upper end [m]; empty: all.
    std::vector<double> window;
    /// Whether the edges of the mathematical mesh are drawn.
    bool mesh_lines = false;
    /// Names of materials in a picture that shows these.
    std::vector<std::string> material_names;
    /// Width of the picture [pixels]; the height follows from the shape of the solid.
    unsigned int picture_width = 1600;
    /// Word for the unit of length in pictures and files; numbers are not converted.
    std::string length_unit = "m";
    /// Word for the unit of stress in pictures and files; numbers are not converted.
    std::string stress_unit = "Pa";
  };
} // namespace NMM

#endif
