#include <nmm/materials/hyperelastic_law.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <scene/current_stress.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;
    using Stress = dealii::SymmetricTensor<2, 2>;

    namespace
    {
      FieldSample::Stress
      finite_stress(const FiniteElasticity          &elasticity,
                    const std::vector<unsigned int> &region_to_material,
                    const unsigned int               element,
                    const Point<2>                  &xi,
                    const Tensor<2, 2>              &H)
      {
        const ElasticityProblem &problem = elasticity.elasticity_problem();
        const ManifoldMesh &mesh   = elasticity.cover_system().manifold_mesh();
        const unsigned int  region = mesh.region(element);
        const Material     &material =
          problem.materials[region_to_material[region]];
        FieldSample::Stress stress;
        if (elasticity.law(region).cauchy_stress(H, stress.in_plane) !=
            Deformation::admissible)
        {
          // Where det F <= 0 there is no stress.
          const double nan        = std::numeric_limits<double>::quiet_NaN();
          stress.in_plane[0][0]   = stress.in_plane[1][1] =
            stress.in_plane[0][1] = stress.zz = nan;
          return stress;
        }
        const Point<2> x =
          mesh.mathematical_mesh().reference_to_real(mesh.cell(element), xi);
        double stretch;
        if (material.varying_initial_stress &&
            elasticity.law(region).out_of_plane_stretch(H, stretch) ==
              Deformation::admissible)
        {
          // The law has no initial stress: F S_0 F^T / (s det F) is added.
          const Tensor<2, 2> F = deformation_gradient(H);
          stress.in_plane +=
            dealii::symmetrize(F * Tensor<2, 2>(material.initial_stress_at(x)) *
                               dealii::transpose(F)) /
            (stretch * dealii::determinant(F));
        }
        if (problem.plane_state == PlaneState::plane_strain)
          stress.zz = material.initial_stress_zz_at(x, problem.plane_state) +
                      elasticity.law(region).plane_strain_stress(H);
        return stress;
      }


      /// A linear function of reference coordinates in an element.
      template <typename Value>
      struct LinearFit
      {
        Value    mean = {}, slope[2] = {};
        Point<2> center;

        Value
        operator()(const Point<2> &xi) const
        {
          return mean + (xi[0] - center[0]) * slope[0] +
                 (xi[1] - center[1]) * slope[1];
        }
      };


      /// The least-squares fit to value(q) at the points q of a rule.
      template <typename Value, typename ValueAtPoint>
      LinearFit<Value>
      fit(const dealii::Quadrature<2> &rule, const ValueAtPoint &value)
      {
        double           sum = 0.;
        LinearFit<Value> result;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          sum += rule.weight(q);
          result.mean += rule.weight(q) * value(q);
          result.center += rule.weight(q) * Tensor<1, 2>(rule.point(q));
        }
        result.mean /= sum;
        result.center /= sum;

        Tensor<2, 2> moments;
        Value        first_moments[2] = {};
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Tensor<1, 2> d = rule.point(q) - result.center;
          moments += rule.weight(q) * dealii::outer_product(d, d);
          for (unsigned int c = 0; c < 2; ++c)
            first_moments[c] += rule.weight(q) * d[c] * value(q);
        }
        // A single point, or points on a line, do not determine the gradient.
        const double trace = moments[0][0] + moments[1][1];
        if (dealii::determinant(moments) > 1e-8 * trace * trace)
        {
          const Tensor<2, 2> inverse = dealii::invert(moments);
          for (unsigned int c = 0; c < 2; ++c)
            result.slope[c] = inverse[c][0] * first_moments[0] +
                              inverse[c][1] * first_moments[1];
        }
        return result;
      }


      /// Area per unit quadrature weight in an element [m^2].
      double
      area_of_weight(const ManifoldMesh &mesh, const unsigned int element)
      {
        return 2. * mesh.mathematical_mesh().cell_area(mesh.cell(element));
      }
    } // namespace


    namespace CurrentStress
    {
      FieldEvaluator::StressLaw
      finite(const FiniteElasticity &elasticity)
      {
        return [&elasticity,
                region_to_material =
                  elasticity.elasticity_problem().region_to_material(
                    elasticity.cover_system().manifold_mesh().physical_mesh())](
                 const unsigned int  element,
                 const Point<2>     &xi,
                 const Tensor<2, 2> &gradient) {
          return finite_stress(
            elasticity, region_to_material, element, xi, gradient);
        };
      }


      ElementStress
      in_material_axes(const DisplacementField &field,
                       const FiniteElasticity  &elasticity,
                       const Kinematics         kinematics)
      {
        if (kinematics != Kinematics::finite)
          return [field](const unsigned int element, const Point<2> &xi) {
            return field.stress(element, xi);
          };
        return [field, law = finite(elasticity)](const unsigned int element,
                                                 const Point<2>    &xi) {
          const Tensor<2, 2> gradient = field.gradient(element, xi);
          const Tensor<2, 2> rotation = dealii::project_onto_orthogonal_tensors(
            Tensor<2, 2>(dealii::unit_symmetric_tensor<2>()) + gradient);
          const Stress stress = law(element, xi, gradient).in_plane;
          return dealii::symmetrize(transpose(rotation) * Tensor<2, 2>(stress) *
                                    rotation);
        };
      }


      FieldEvaluator::StressLaw
      of(const SolidTerm &solid, const QuadratureCollection &quadrature)
      {
        const bool is_finite = solid.kinematics() == Kinematics::finite;
        if (solid.inelastic_terms() == nullptr)
          return is_finite ? finite(solid.elasticity())
                           : FieldEvaluator::StressLaw();
        const InelasticTerms    &terms  = *solid.inelastic_terms();
        const CoverSystem       &covers = solid.elasticity().cover_system();
        const ElasticityProblem &problem =
          solid.elasticity().elasticity_problem();
        const auto [first, last] = covers.locally_owned_elements();
        std::vector<std::optional<LinearFit<Stress>>> in_plane(last - first);
        std::vector<LinearFit<double>>                across(last - first);
        for (unsigned int element = first; element < last; ++element)
          if (const auto values = terms.values(element); !values.empty())
          {
            const dealii::Quadrature<2> &rule = quadrature.rule(element);
            in_plane[element - first] =
              fit<Stress>(rule, [&](const unsigned int q) {
                return values[q].stress;
              });
            across[element - first] =
              fit<double>(rule, [&](const unsigned int q) {
                return values[q].stress_zz;
              });
          }
        const ManifoldMesh &mesh = covers.manifold_mesh();
        return [first    = first,
                in_plane = std::move(in_plane),
                across   = std::move(across),
                &mesh,
                &problem,
                elastic = is_finite ? finite(solid.elasticity())
                                    : FieldEvaluator::StressLaw(),
                region_to_material =
                  problem.region_to_material(mesh.physical_mesh())](
                 const unsigned int  element,
                 const Point<2>     &xi,
                 const Tensor<2, 2> &gradient) -> FieldSample::Stress {
          const unsigned int i = element - first;
          if (in_plane[i])
            return {(*in_plane[i])(xi), across[i](xi)};
          if (elastic)
            return elastic(element, xi, gradient);
          const Material &material =
            problem.materials[region_to_material[mesh.region(element)]];
          const Stress   strain = dealii::symmetrize(gradient);
          const Point<2> x =
            mesh.mathematical_mesh().reference_to_real(mesh.cell(element), xi);
          return {material.initial_stress_at(x) +
                    material.elasticity_tensor(problem.plane_state) * strain,
                  material.out_of_plane_stress(strain, problem.plane_state, x)};
        };
      }


      FieldEvaluator::ScalarField
      plastic_strain(const InelasticTerms       &terms,
                     const CoverSystem          &covers,
                     const QuadratureCollection &quadrature)
      {
        const auto [first, last] = covers.locally_owned_elements();
        std::vector<LinearFit<double>> fits(last - first);
        for (unsigned int element = first; element < last; ++element)
          if (const auto values = terms.values(element); !values.empty())
            fits[element - first] =
              fit<double>(quadrature.rule(element), [&](const unsigned int q) {
                return values[q].equivalent_plastic_strain;
              });
        return
          [first = first, fits = std::move(fits)](const unsigned int element,
                                                  const Point<2>    &xi) {
            return std::max(0., fits[element - first](xi));
          };
      }


      double
      area(const DisplacementField    &field,
           const QuadratureCollection &quadrature)
      {
        const CoverSystem  &covers = field.cover_system();
        const ManifoldMesh &mesh   = covers.manifold_mesh();
        const auto [first, last]   = covers.locally_owned_elements();
        double sum                 = 0.;
        for (unsigned int element = first; element < last; ++element)
        {
          const dealii::Quadrature<2> &rule = quadrature.rule(element);
          for (unsigned int q = 0; q < rule.size(); ++q)
            sum +=
              area_of_weight(mesh, element) * rule.weight(q) *
              (1. + determinant_change(field.gradient(element, rule.point(q))));
        }
        return dealii::Utilities::MPI::sum(sum, covers.communicator());
      }
    } // namespace CurrentStress
  }   // namespace internal
} // namespace NMM
