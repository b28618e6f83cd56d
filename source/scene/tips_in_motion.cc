#include <deal.II/base/function.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <scene/current_stress.h>
#include <scene/dynamic_analysis.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    // Intensity factors of a solid in motion.
    using dealii::Tensor;

    namespace
    {
      /// Multiplies a function by a number; null stays null.
      void
      scale(std::shared_ptr<const dealii::Function<2>> &function,
            const double                                factor)
      {
        if (!function || factor == 1.)
          return;
        std::vector<std::function<double(const dealii::Point<2> &)>> components;
        for (unsigned int c = 0; c < function->n_components; ++c)
          components.emplace_back(
            [function, factor, c](const dealii::Point<2> &x) {
              return factor * function->value(x, c);
            });
        function =
          std::make_shared<dealii::FunctionFromFunctionObjects<2>>(components);
      }
    } // namespace


    ElasticityProblem
    DynamicAnalysis::problem_now() const
    {
      ElasticityProblem now     = problem;
      const Loading    &loading = motion->parameters().loading;
      if (loading.amplitudes)
      {
        const LoadAmplitudes amplitudes = loading.amplitudes(time());
        now.gravity *= amplitudes.gravity;
        scale(now.body_force, amplitudes.body_force);
        for (unsigned int i = 0; i < amplitudes.boundary_conditions.size(); ++i)
          scale(now.boundary_conditions[i].value,
                amplitudes.boundary_conditions[i]);
      }
      if (loading.base_acceleration)
        now.gravity -= loading.base_acceleration(time());
      return now;
    }


    void
    DynamicAnalysis::compute_tips_in_motion()
    {
      if (!crack_tips)
        return;
      Vector relevant(motion->solid_term().layout().locally_owned,
                      motion->solid_term().layout().locally_relevant,
                      communicator);
      relevant = motion->integrator().state().a;
      const DisplacementField u(solid->covers(), problem, displacement()),
        acceleration(solid->covers(), problem, relevant);
      std::vector<ContactForce> forces;
      if (contact)
        forces = contact->forces_on_faces();
      const ElasticityProblem now = problem_now();
      crack_tips->compute_each(
        [&](const CrackTip &tip, const double radius, DiskRules &rules) {
          const bool is_finite =
            scene.parameters().model.kinematics == Kinematics::finite;
          // Seen by an observer who turns with the material at the tip, displacements are small.
          const Tensor<2, 2> to_tip = transpose(
            is_finite ? rotation_at(tip, u)
                      : Tensor<2, 2>(dealii::unit_symmetric_tensor<2>()));
          TipLoading        tip_loading;
          ElasticityProblem seen = now;
          seen.gravity           = to_tip * now.gravity;
          for (const ContactForce &force : forces)
            tip_loading.contact_forces.push_back(
              {force.x, to_tip * force.normal, to_tip * force.force});
          tip_loading.acceleration = [&](const unsigned int      element,
                                         const dealii::Point<2> &xi) {
            return to_tip * acceleration.displacement(element, xi);
          };
          return NMM::compute_intensity_factors(is_finite ? turned(u, to_tip)
                                                          : u,
                                                seen,
                                                tip,
                                                radius,
                                                tip_loading,
                                                &rules);
        });
    }


    ElementStress
    DynamicAnalysis::stress_in_material_axes() const
    {
      const auto u = std::make_shared<const DisplacementField>(solid->covers(),
                                                               problem,
                                                               displacement());
      if (scene.parameters().model.kinematics != Kinematics::finite)
        return [u](const unsigned int element, const dealii::Point<2> &xi) {
          return u->stress(element, xi);
        };
      return
        [u, law = CurrentStress::finite(motion->solid_term().elasticity())](
          const unsigned int element, const dealii::Point<2> &xi) {
          const Tensor<2, 2> gradient = u->gradient(element, xi);
          const Tensor<2, 2> rotation = dealii::project_onto_orthogonal_tensors(
            Tensor<2, 2>(dealii::unit_symmetric_tensor<2>()) + gradient);
          const dealii::SymmetricTensor<2, 2> stress =
            law(element, xi, gradient).in_plane;
          return dealii::symmetrize(transpose(rotation) * Tensor<2, 2>(stress) *
                                    rotation);
        };
    }


    Tensor<2, 2>
    DynamicAnalysis::rotation_at(const CrackTip          &tip,
                                 const DisplacementField &u) const
    {
      // The rotation R of the mean deformation gradient F = R U.
      const dealii::Point<2> middle(1. / 3., 1. / 3.);
      const auto [first, last] = solid->covers().locally_owned_elements();
      Tensor<2, 2> local;
      for (unsigned int element = first; element < last; ++element)
        if (std::find(tip.regions.begin(),
                      tip.regions.end(),
                      solid->manifold_mesh().region(element)) !=
              tip.regions.end() &&
            solid->manifold_mesh().reference_point(element).distance(
              tip.point) < tip.free_radius)
          local +=
            solid->manifold_mesh().area(element) *
            (dealii::unit_symmetric_tensor<2>() + u.gradient(element, middle));
      return dealii::project_onto_orthogonal_tensors(
        dealii::Utilities::MPI::sum(local, communicator));
    }


    DisplacementField
    DynamicAnalysis::turned(const DisplacementField &u,
                            const Tensor<2, 2>      &rotation) const
    {
      std::vector<Tensor<1, 2>> values(solid->covers().n_covers());
      for (unsigned int cover = 0; cover < values.size(); ++cover)
      {
        const dealii::Point<2> &x = solid->covers().node(cover);
        values[cover] = rotation * (x + u.nodal_value(cover)) - Tensor<1, 2>(x);
      }
      return DisplacementField(solid->covers(), problem, values);
    }
  } // namespace internal
} // namespace NMM
