#ifndef nmm_applications_static_start_h
#define nmm_applications_static_start_h

#include <nmm/covers/cover_system.h>
#include <nmm/io/progress.h>
#include <nmm/io/scene.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/newton_solver.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/lac/affine_constraints.h>

#include "contact_analysis.h"

/// What a dynamic analysis is made of, for its start.
struct StartInput
{
  const NMM::Scene                        &scene;
  const NMM::CoverSystem                  &covers;
  const NMM::QuadratureCollection         &quadrature;
  const NMM::QuadratureCollection         &mass_quadrature;
  const dealii::AffineConstraints<double> &constraints;
  const NMM::ElasticityProblem            &problem;
  /// Null without contact.
  ContactAnalysis *contact;
  NMM::Progress   &progress;
};


struct StartReport
{
  unsigned int n_steps = 0, n_iterations = 0;
};


/// Newton's method for time steps and relaxation; more iterations than the default
/// where there is contact and the scene does not say how many.
NMM::NewtonParameters
motion_newton_parameters(const NMM::Scene &scene);


/**
 * The state a dynamic analysis starts from, if that is not the undeformed one:
 * equilibrium of loads, supports and obstacles as they are at t = 0, before anything is
 * released and without motion of the ground. Contact remembers what it came to: places
 * of sticking, bonds that broke. Returns displacements of owned unknowns [m].
 * Collective. @throws NMM::NumericalFailure if there is none.
 */
NMM::FiniteElasticity::Vector
find_start(const StartInput &input, StartReport &report);

#endif
