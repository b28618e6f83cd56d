#ifndef nmm_source_scene_static_start_h
#define nmm_source_scene_static_start_h

#include <nmm/contact/assembly/term.h>
#include <nmm/covers/cover_system.h>
#include <nmm/dynamics/time_integrator.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/output/progress.h>
#include <nmm/quadrature/element_quadrature.h>
#include <nmm/scene/scene.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>
#include <scene/contact_analysis.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The objects of a dynamic analysis that its start needs.
    struct StartInput
    {
      const Scene                             &scene;
      const CoverSystem                       &covers;
      const QuadratureCollection              &quadrature;
      const QuadratureCollection              &mass_quadrature;
      const dealii::AffineConstraints<double> &constraints;
      const ElasticityProblem                 &problem;
      /// Null without contact.
      ContactAnalysis *contact;
      /// The start is a stage of it.
      Progress &progress;
    };


    /// The equations of a relaxation from which a motion starts. Loads keep their values of t = 0
    /// while its time advances.
    class StartRelaxation
    {
    public:
      /// The objects of @p input must outlive this one.
      explicit StartRelaxation(const StartInput &input);

      TimeIntegrator &
      integrator()
      {
        return *time_integrator;
      }

      /// The terms of inelastic materials; null if there are none.
      InelasticTerms *
      inelastic_terms() const;

      /// Length of the first step [s] if the relaxation goes on from a state that the integrator
      /// was given, else 0.
      double continued_step = 0.;
      /// Called before each step with its length [s], if given.
      std::function<void(double)> before_step;

    private:
      FiniteElasticity                 elasticity;
      std::unique_ptr<SolidTerm>       model;
      std::unique_ptr<ContactTerm>     contact_term;
      std::unique_ptr<MechanicalModel> mechanics;
      std::unique_ptr<TimeIntegrator>  time_integrator;
    };


    struct StartReport
    {
      unsigned int n_steps = 0, n_iterations = 0;
      /// InelasticTerms::internal_state(); empty if all materials are elastic.
      std::vector<char> material_state;
    };


    /// Parameters of Newton's method for time steps and relaxation. With contact or materials that
    /// yield there are more iterations than by default, unless the scene gives a number.
    NewtonParameters
    motion_newton_parameters(const Scene &scene, Progress &progress);


    /**
     * Finds the equilibrium from which a dynamic analysis starts, if it does not start undeformed.
     * Loads, supports and obstacles are those of t = 0, before any release
     * and without motion of the ground. The contact keeps its history from the start: anchors of
     * the stick state and broken bonds. Returns the displacements of owned unknowns [m].
     * Collective. @throws NumericalFailure if there is no equilibrium.
     */
    FiniteElasticity::Vector
    find_start(const StartInput &input, StartReport &report);


    /// As find_start(), by a relaxation that may have begun already.
    FiniteElasticity::Vector
    find_start(const StartInput &input,
               StartRelaxation  &relaxation,
               StartReport      &report);
  } // namespace internal
} // namespace NMM

#endif
