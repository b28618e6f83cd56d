#include <nmm/base/exceptions.h>
#include <nmm/output/field_samples.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace NMM
{
  const std::vector<Quantity> &
  all_quantities()
  {
    static const std::vector<Quantity> all = []() {
      std::vector<Quantity> result;
      for (int q = 0; q <= static_cast<int>(Quantity::material); ++q)
        result.push_back(static_cast<Quantity>(q));
      return result;
    }();
    return all;
  }


  std::string
  to_string(const Quantity quantity)
  {
    static const char *const names[] = {"von Mises stress",
                                        "stress xx",
                                        "stress yy",
                                        "stress xy",
                                        "first principal stress",
                                        "second principal stress",
                                        "radial stress",
                                        "hoop stress",
                                        "displacement",
                                        "displacement x",
                                        "displacement y",
                                        "velocity",
                                        "velocity x",
                                        "velocity y",
                                        "plastic strain",
                                        "block",
                                        "material"};
    return names[static_cast<int>(quantity)];
  }


  bool
  is_velocity(const Quantity quantity)
  {
    return quantity == Quantity::velocity || quantity == Quantity::velocity_x ||
           quantity == Quantity::velocity_y;
  }


  double
  von_mises_stress(const FieldSample::Stress &stress)
  {
    const double xx = stress.in_plane[0][0];
    const double yy = stress.in_plane[1][1];
    const double xy = stress.in_plane[0][1];
    const double zz = stress.zz;
    return std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) +
                            (zz - xx) * (zz - xx)) +
                     3. * xy * xy);
  }


  std::array<double, 2>
  principal_stresses(const FieldSample::Stress &stress)
  {
    const auto  &s      = stress.in_plane;
    const double mean   = 0.5 * (s[0][0] + s[1][1]);
    const double radius = std::hypot(0.5 * (s[0][0] - s[1][1]), s[0][1]);
    return {{mean + radius, mean - radius}};
  }


  FieldEvaluator::FieldEvaluator(const DisplacementField &field,
                                 const StressRecovery    &recovery,
                                 const ElasticityProblem &problem,
                                 StressLaw                law,
                                 const DisplacementField *velocity)
    : field(&field)
    , recovery(&recovery)
    , problem(&problem)
    , region_to_material(problem.region_to_material(
        field.cover_system().manifold_mesh().physical_mesh()))
    , law(std::move(law))
    , velocity(velocity)
  {
  }


  FieldSample
  FieldEvaluator::operator()(const unsigned int      element,
                             const dealii::Point<2> &x) const
  {
    const ManifoldMesh    &mesh = field->cover_system().manifold_mesh();
    const dealii::Point<2> xi =
      mesh.mathematical_mesh().real_to_reference(mesh.cell(element), x);

    FieldSample                sample;
    const dealii::Tensor<2, 2> direct    = field->gradient(element, xi);
    const dealii::Tensor<2, 2> recovered = recovery->gradient(element, xi);
    sample.displacement                  = field->displacement(element, xi);
    if (velocity != nullptr)
      sample.velocity = velocity->displacement(element, xi);
    if (plastic_strain)
      sample.plastic_strain = plastic_strain(element, xi);
    if (law)
    {
      sample.direct    = law(element, xi, direct);
      sample.recovered = law(element, xi, recovered);
      return sample;
    }
    sample.direct.in_plane = field->stress_from_gradient(element, xi, direct);
    sample.direct.zz       = stress_zz(element, x, direct);
    sample.recovered.in_plane =
      field->stress_from_gradient(element, xi, recovered);
    sample.recovered.zz = stress_zz(element, x, recovered);
    return sample;
  }


  bool
  FieldEvaluator::has_velocity() const
  {
    return velocity != nullptr;
  }


  void
  FieldEvaluator::set_plastic_strain(ScalarField strain)
  {
    plastic_strain = std::move(strain);
  }


  bool
  FieldEvaluator::has_plastic_strain() const
  {
    return plastic_strain != nullptr;
  }


  void
  FieldEvaluator::hide_blocks(const std::vector<unsigned int> &blocks)
  {
    is_hidden.assign(
      field->cover_system().manifold_mesh().physical_mesh().n_blocks(), false);
    for (const unsigned int block : blocks)
      is_hidden[block] = true;
  }


  bool
  FieldEvaluator::shows(const unsigned int element) const
  {
    return is_hidden.empty() ||
           !is_hidden[field->cover_system().manifold_mesh().block(element)];
  }


  dealii::Tensor<1, 2>
  FieldEvaluator::displacement(const unsigned int      element,
                               const dealii::Point<2> &x) const
  {
    const ManifoldMesh &mesh = field->cover_system().manifold_mesh();
    return field->displacement(
      element,
      mesh.mathematical_mesh().real_to_reference(mesh.cell(element), x));
  }


  double
  FieldEvaluator::stress_zz(const unsigned int          element,
                            const dealii::Point<2>     &x,
                            const dealii::Tensor<2, 2> &gradient) const
  {
    const unsigned int region =
      field->cover_system().manifold_mesh().region(element);
    return problem->materials[region_to_material[region]].out_of_plane_stress(
      dealii::symmetrize(gradient), problem->plane_state, x);
  }


  FieldTriangles::FieldTriangles(const CoverSystem    &covers,
                                 const FieldEvaluator *evaluator)
    : has_velocity(evaluator != nullptr && evaluator->has_velocity())
    , has_plastic_strain(evaluator != nullptr &&
                         evaluator->has_plastic_strain())
  {
    const ManifoldMesh &mesh = covers.manifold_mesh();
    const auto [first, last] = covers.locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
    {
      if (evaluator != nullptr && !evaluator->shows(element))
        continue;
      for (const QuadraticTriangle &triangle : triangulate(mesh, element))
      {
        nodes.push_back(triangle);
        elements.push_back(element);
        samples.emplace_back();
        if (evaluator != nullptr)
          for (unsigned int i = 0; i < triangle.size(); ++i)
            samples.back()[i] = (*evaluator)(element, triangle[i]);
      }
    }
  }


  double
  FieldTriangles::max_displacement(const MPI_Comm communicator) const
  {
    double maximum = 0.;
    for (const auto &triangle : samples)
      for (const FieldSample &sample : triangle)
        maximum = std::max(maximum, sample.displacement.norm());
    return dealii::Utilities::MPI::max(maximum, communicator);
  }


  std::string
  find_not_finite(const FieldSample &sample, const dealii::Point<2> &x)
  {
    const auto fault = [&](const std::string &name, const double value) {
      return std::isfinite(value)
               ? ""
               : "the " + name + " at " + to_string(x) + " is not finite";
    };
    std::string text = fault("displacement", sample.displacement.norm_square());
    if (text.empty())
      text = fault("velocity", sample.velocity.norm_square());
    for (const auto *stress : {&sample.direct, &sample.recovered})
      if (text.empty())
        text = fault("stress", stress->in_plane.norm() + stress->zz);
    return text;
  }


  std::string
  FieldTriangles::find_not_finite(const MPI_Comm communicator) const
  {
    std::string fault;
    for (std::size_t t = 0; t < samples.size() && fault.empty(); ++t)
      for (unsigned int i = 0; i < 6 && fault.empty(); ++i)
        fault = NMM::find_not_finite(samples[t][i], nodes[t][i]);
    for (const std::string &other :
         dealii::Utilities::MPI::all_gather(communicator, fault))
      if (fault.empty())
        fault = other;
    return fault;
  }


  ElementIds
  element_ids(const ManifoldMesh &mesh, const unsigned int element)
  {
    const unsigned int region = mesh.region(element);
    const unsigned int material =
      mesh.physical_mesh().regions()[region].material;
    return {mesh.block(element),
            region,
            material == invalid_index ? 0 : material};
  }


  double
  quantity_value(const FieldSample       &sample,
                 const ElementIds        &ids,
                 const dealii::Point<2>  &x,
                 const PictureParameters &parameters,
                 const Quantity           quantity)
  {
    const FieldSample::Stress &stress =
      parameters.recovered ? sample.recovered : sample.direct;
    const auto along = [&](const dealii::Tensor<1, 2> &direction) {
      return direction * (stress.in_plane * direction);
    };
    const auto radial_direction = [&]() {
      const dealii::Tensor<1, 2> r = x - parameters.center;
      return r.norm() > 0. ? r / r.norm() : dealii::Tensor<1, 2>({1., 0.});
    };

    switch (quantity)
    {
      case Quantity::von_mises:
        return von_mises_stress(stress);
      case Quantity::stress_xx:
        return stress.in_plane[0][0];
      case Quantity::stress_yy:
        return stress.in_plane[1][1];
      case Quantity::stress_xy:
        return stress.in_plane[0][1];
      case Quantity::first_principal:
        return principal_stresses(stress)[0];
      case Quantity::second_principal:
        return principal_stresses(stress)[1];
      case Quantity::radial_stress:
        return along(radial_direction());
      case Quantity::hoop_stress:
        return along(dealii::cross_product_2d(radial_direction()));
      case Quantity::displacement:
        return sample.displacement.norm();
      case Quantity::displacement_x:
        return sample.displacement[0];
      case Quantity::displacement_y:
        return sample.displacement[1];
      case Quantity::velocity:
        return sample.velocity.norm();
      case Quantity::velocity_x:
        return sample.velocity[0];
      case Quantity::velocity_y:
        return sample.velocity[1];
      case Quantity::plastic_strain:
        return sample.plastic_strain;
      case Quantity::block:
        return ids.block;
      case Quantity::material:
        return ids.material;
    }
    return 0.;
  }
} // namespace NMM
