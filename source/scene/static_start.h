#ifndef nmm_source_scene_static_start_h
#define nmm_source_scene_static_start_h

#include <nmm/covers/cover_system.h>
#include <nmm/dynamics/elastic_models.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/output/progress.h>
#include <nmm/quadrature/element_quadrature.h>
#include <nmm/scene/scene.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/lac/affine_constraints.h>

#include <scene/contact_analysis.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// What a dynamic analysis is made of, for its start.
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
      /// Shows how far the start has come.
      Progress::Stage &stage;
    };


    struct StartReport
    {
      unsigned int n_steps = 0, n_iterations = 0;
      /// InelasticTerms::internal_state(); empty if all materials are elastic.
      std::vector<char> material_state;
    };


    /// Those of a body in small displacements; null: its materials are elastic, or it is in
    /// large displacements.
    InelasticTerms *
    inelastic_terms_of(const ElasticModel *model);


    /// Newton's method for time steps and relaxation; more iterations than the default
    /// where there is contact and the scene does not say how many.
    NewtonParameters
    motion_newton_parameters(const Scene &scene);


    /**
     * The state a dynamic analysis starts from, if that is not the undeformed one:
     * equilibrium of loads, supports and obstacles as they are at t = 0, before anything is
     * released and without motion of the ground. Contact remembers what it came to: places
     * of sticking, bonds that broke. Returns displacements of owned unknowns [m].
     * Collective. @throws NumericalFailure if there is none.
     */
    FiniteElasticity::Vector
    find_start(const StartInput &input, StartReport &report);
  } // namespace internal
} // namespace NMM

#endif
