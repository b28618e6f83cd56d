#include <nmm/base/exceptions.h>
#include <nmm/materials/material.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NMM
{
  namespace
  {
    std::string
    parameter_message(const std::string &parameter,
                      const double       value,
                      const std::string &unit)
    {
      std::ostringstream out;
      out.precision(12);
      out << parameter << " is " << value << ' ' << unit;
      return out.str();
    }
  } // namespace


  dealii::SymmetricTensor<2, 2>
  PlaneElasticity::stress(const dealii::Tensor<2, 2> &gradient) const
  {
    const double volumetric = lambda * (gradient[0][0] + gradient[1][1]);

    dealii::SymmetricTensor<2, 2> sigma;
    sigma[0][0] = volumetric + 2. * mu * gradient[0][0];
    sigma[1][1] = volumetric + 2. * mu * gradient[1][1];
    sigma[0][1] = mu * (gradient[0][1] + gradient[1][0]);
    return sigma;
  }


  double
  PlaneElasticity::largest_eigenvalue() const
  {
    return 2. * (mu + std::max(0., lambda));
  }


  void
  Material::check(const PlaneState plane_state) const
  {
    const std::string where = "material \"" + name + "\"";

    AssertThrow(
      std::isfinite(youngs_modulus) && youngs_modulus > 0.,
      InputError(parameter_message("Young's modulus", youngs_modulus, "Pa"),
                 where,
                 "give a positive number"));
    AssertThrow(
      std::isfinite(poissons_ratio) && poissons_ratio > -1. &&
        poissons_ratio < 0.5,
      InputError(
        parameter_message("Poisson's ratio", poissons_ratio, "[-]"),
        where,
        plane_state == PlaneState::plane_strain && poissons_ratio == 0.5
          ? "an incompressible material has no finite stiffness in plane "
            "strain; give a number above -1 and below 0.5, e.g. 0.499"
          : "give a number above -1 and below 0.5"));
    AssertThrow(!wet_density ||
                  (std::isfinite(*wet_density) && *wet_density >= density),
                InputError(parameter_message("Wet density",
                                             wet_density.value_or(0.),
                                             "kg/m^3"),
                           where,
                           "give at least the density, since water adds to "
                           "it"));
    AssertThrow(std::isfinite(density) && density >= 0.,
                InputError(parameter_message("Density", density, "kg/m^3"),
                           where,
                           "give a number that is not negative"));
    AssertThrow(
      std::isfinite(toughness) && toughness >= 0.,
      InputError(parameter_message("Toughness", toughness, "Pa m^0.5"),
                 where,
                 "give a number that is not negative"));
    AssertThrow(std::isfinite(fracture_strength) && fracture_strength >= 0.,
                InputError(parameter_message("Fracture strength",
                                             fracture_strength,
                                             "Pa"),
                           where,
                           "give a number that is not negative"));
    AssertThrow(std::isfinite(initial_stress.norm()),
                InputError("Initial stress is not finite",
                           where,
                           "give three numbers xx, yy, xy in Pa"));
    AssertThrow(!given_initial_stress_zz ||
                  (std::isfinite(*given_initial_stress_zz) &&
                   plane_state == PlaneState::plane_strain),
                InputError("There is an initial stress across the plane",
                           where,
                           "give a finite one, in plane strain only"));
    if (varying_initial_stress)
    {
      const unsigned int n = varying_initial_stress->n_components;
      AssertThrow(n == 3 || (n == 4 && plane_state == PlaneState::plane_strain),
                  InputError("The initial stress has " + std::to_string(n) +
                               " components",
                             where,
                             "give xx, yy, xy and, in plane strain only, zz"));
      AssertThrow(initial_stress.norm() == 0. && !given_initial_stress_zz,
                  InputError("There are a uniform initial stress and one that "
                             "varies",
                             where,
                             "add the uniform one to the function"));
    }
    law->check(where, plane_state);
  }


  PlaneElasticity
  Material::plane_elasticity(const PlaneState plane_state) const
  {
    const double nu = poissons_ratio;

    PlaneElasticity constants;
    constants.mu     = youngs_modulus / (2. * (1. + nu));
    constants.lambda = plane_state == PlaneState::plane_strain
                         ? youngs_modulus * nu / ((1. + nu) * (1. - 2. * nu))
                         : youngs_modulus * nu / (1. - nu * nu);
    return constants;
  }


  dealii::SymmetricTensor<4, 2>
  Material::elasticity_tensor(const PlaneState plane_state) const
  {
    const PlaneElasticity c        = plane_elasticity(plane_state);
    const auto            identity = dealii::unit_symmetric_tensor<2>();

    return c.lambda * dealii::outer_product(identity, identity) +
           2. * c.mu * dealii::identity_tensor<2>();
  }


  double
  Material::out_of_plane_stress(const dealii::SymmetricTensor<2, 2> &strain,
                                const PlaneState        plane_state,
                                const dealii::Point<2> &x) const
  {
    if (plane_state == PlaneState::plane_stress)
      return 0.;
    return initial_stress_zz_at(x, plane_state) +
           plane_elasticity(plane_state).lambda * dealii::trace(strain);
  }


  double
  Material::initial_stress_zz(const PlaneState plane_state) const
  {
    if (plane_state == PlaneState::plane_stress)
      return 0.;
    return given_initial_stress_zz
             ? *given_initial_stress_zz
             : poissons_ratio * dealii::trace(initial_stress);
  }


  bool
  Material::has_initial_stress() const
  {
    return varying_initial_stress != nullptr || initial_stress.norm() > 0.;
  }


  dealii::Tensor<1, 2>
  Material::weight_at(const dealii::Point<2>     &x,
                      const dealii::Tensor<1, 2> &gravity) const
  {
    dealii::Tensor<1, 2> result = density * gravity;
    if (body_force)
      for (unsigned int c = 0; c < 2; ++c)
        result[c] += body_force->value(x, c);
    return result;
  }


  dealii::SymmetricTensor<2, 2>
  Material::initial_stress_at(const dealii::Point<2> &x) const
  {
    return varying_initial_stress == nullptr
             ? initial_stress
             : stress_at(*varying_initial_stress, x);
  }


  double
  Material::initial_stress_zz_at(const dealii::Point<2> &x,
                                 const PlaneState        plane_state) const
  {
    if (varying_initial_stress == nullptr ||
        plane_state == PlaneState::plane_stress)
      return initial_stress_zz(plane_state);
    return varying_initial_stress->n_components > 3
             ? varying_initial_stress->value(x, 3)
             : poissons_ratio * dealii::trace(initial_stress_at(x));
  }


  dealii::SymmetricTensor<2, 2>
  stress_at(const dealii::Function<2> &components, const dealii::Point<2> &x)
  {
    dealii::SymmetricTensor<2, 2> result;
    result[0][0] = components.value(x, 0);
    result[1][1] = components.value(x, 1);
    result[0][1] = components.value(x, 2);
    return result;
  }


  std::shared_ptr<const HyperelasticLaw>
  Material::hyperelastic_law(const PlaneState plane_state) const
  {
    auto result = law->hyperelastic_law(*this, plane_state);
    AssertThrow(result != nullptr,
                InputError("its law is not defined for large deformations",
                           "material \"" + name + "\"",
                           "choose another law, or small kinematics"));
    return result;
  }


  std::shared_ptr<const InelasticLaw>
  Material::inelastic_law(const PlaneState plane_state) const
  {
    return law->inelastic_law(*this, plane_state);
  }
} // namespace NMM
