#ifndef nmm_applications_static_analysis_h
#define nmm_applications_static_analysis_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/io/output_directory.h>
#include <nmm/io/probes.h>
#include <nmm/io/progress.h>
#include <nmm/io/scene.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/mechanics/thick_ring.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <optional>
#include <string>

/**
 * A scene's static analysis, from geometry to files. The order is fixed:
 * build(), print_report(), solve(), verify(), write(). All input errors come out
 * of build(), so that nothing is written for a scene that is wrong.
 *
 * Lifetime: the scene and the progress display must outlive it.
 */
class StaticAnalysis
{
public:
  StaticAnalysis(const NMM::Scene &scene,
                 NMM::Progress    &progress,
                 MPI_Comm          communicator);

  /// Cut, make covers and quadrature, check the problem. @throws
  /// NMM::InputError.
  void
  build();

  /// Notices, changes made by cleaning, and counts.
  void
  print_report();

  /// @throws NMM::NumericalFailure.
  void
  solve();

  /// Errors against the exact solution, strain energy.
  void
  verify();

  /// All files the scene asks for; without a solution those that need none.
  void
  write(const NMM::OutputDirectory &directory);

private:
  const NMM::Scene &scene;
  NMM::Progress    &progress;
  MPI_Comm          communicator;
  NMM::Summary      summary;
  bool              is_solved = false;

  // Each object refers to those above it.
  std::vector<NMM::CleaningAction>           cleaning_actions;
  std::vector<std::string>                   own_mesh_notices;
  std::unique_ptr<NMM::PhysicalMesh>         physical_mesh;
  std::unique_ptr<NMM::MathematicalMesh>     mathematical_mesh;
  std::unique_ptr<NMM::ManifoldMesh>         manifold_mesh;
  std::unique_ptr<NMM::CoverSystem>          covers;
  NMM::Aggregation                           aggregation;
  dealii::AffineConstraints<double>          constraints;
  std::unique_ptr<NMM::GhostPenalty>         ghost_penalty;
  std::unique_ptr<NMM::QuadratureCollection> quadrature;
  NMM::ElasticityProblem                     problem;
  std::optional<NMM::ThickRing>              exact_solution;
  std::unique_ptr<NMM::ProbePoints>          probes, hoop_probe;
  std::unique_ptr<NMM::StaticElasticity>     elasticity;
  std::unique_ptr<NMM::DisplacementField>    field;
  std::unique_ptr<NMM::StressRecovery>       recovery;
  std::unique_ptr<NMM::FieldEvaluator>       evaluator;

  void
  add_counts();

  void
  cut();

  void
  make_covers();

  void
  make_exact_solution();

  /// Condition number and its place into the summary; a warning above the
  /// limit.
  void
  estimate_condition();

  void
  add_errors();

  /// Elastic energy of the solid [J].
  double
  strain_energy() const;

  void
  write_summary(const NMM::OutputDirectory &directory);
};

#endif
