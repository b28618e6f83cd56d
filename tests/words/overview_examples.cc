// The examples in the overview comments of the rooms compile: each stands below as well, between
// "// Example of HEADER" and "// End", in a function with what it needs. The test compares both texts.

#include <nmm/analysis/simulation.h>
#include <nmm/base/program.h>
#include <nmm/contact/assembly/statics.h>
#include <nmm/contact/assembly/term.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/dynamics/step_control.h>
#include <nmm/fracture/fracture.h>
#include <nmm/geometry/crack_extension.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/mechanics/spring_term.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output.h>
#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>
#include <nmm/scene/run_scene.h>
#include <nmm/solution/load_stepping.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <linear_algebra/cover_matrix_assembler.h>
#include <linear_algebra/direct_solver.h>
#include <memory>
#include <regex>
#include <string>
#include <vector>

namespace
{
  using namespace NMM;
  using dealii::Point;
  using dealii::Tensor;
  using Constraints = dealii::AffineConstraints<double>;
  using Vector      = dealii::TrilinosWrappers::MPI::Vector;

  // The functions are compiled and not called.

  [[maybe_unused]] int
  base(char **argv, const std::function<void()> &run)
  {
    // clang-format off
    // Example of base/types.h
    try
      {
        const MPISession mpi(argv[0]);
        run();
      }
    catch (...)
      {
        const ProgramEnd end = explain_exception(false);
        std::cerr << end.message << std::endl;
        return static_cast<int>(end.code);
      }
    return static_cast<int>(ExitCode::success);
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  geometry()
  {
    // clang-format off
    // Example of geometry/geometry.h
    Geometry geometry;
    geometry.add_polygon({Point<2>(0., 0.), Point<2>(1., 0.), Point<2>(1., 1.), Point<2>(0., 1.)},
                         "outline");
    geometry.add_circle(Point<2>(0.5, 0.5), 0.2, "bore", CurveRole::hole);
    geometry.add_polyline({Point<2>(-1., 0.5), Point<2>(2., 0.5)}, "joint", CurveRole::joint);
    const PhysicalMesh solid(std::move(geometry));
    std::cout << solid.n_blocks() << " blocks" << std::endl;
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  covers(const PhysicalMesh &solid)
  {
    // clang-format off
    // Example of covers/mathematical_mesh.h
    RegularMeshParameters parameters;
    parameters.cell_size = 0.1;
    const MathematicalMesh triangles = make_regular_mesh(solid, parameters, 2);
    const ManifoldMesh     elements(triangles, solid);
    CoverSystem            covers(elements, MPI_COMM_WORLD);
    const Aggregation      aggregation = aggregate(covers);
    const auto             constraints = make_constraints(covers, aggregation, 2);
    // End
    // clang-format on
  }


  [[maybe_unused]] double
  quadrature(const ManifoldMesh                            &mesh,
             const std::function<double(const Point<2> &)> &f)
  {
    double integral = 0.;
    // clang-format off
    // Example of quadrature/element_quadrature.h
    const MathematicalMesh    &cells = mesh.mathematical_mesh();
    const QuadratureCollection rules(mesh, 4, 4, {0, mesh.n_elements()});
    for (unsigned int element = 0; element < mesh.n_elements(); ++element)
      {
        const ElementRule rule        = rules.rule(element);
        const double      determinant = 2. * cells.cell_area(mesh.cell(element));
        for (unsigned int q = 0; q < rule.size(); ++q)
          integral += f(rule.point(q)) * rule.weight(q) * determinant;
      }
    // End
    // clang-format on
    return integral;
  }


  [[maybe_unused]] void
  values(const CoverSystem                       &covers,
         const QuadratureCollection              &quadrature,
         const dealii::FiniteElement<2>          &fe,
         const dealii::AffineConstraints<double> &constraints,
         const double                             p,
         const double                             R)
  {
    using namespace dealii;
    const ManifoldMesh              &mesh = covers.manifold_mesh();
    const FEValuesExtractors::Vector displacement(0);
    FullMatrix<double>               element_matrix(6, 6);
    dealii::SparseMatrix<double>     system_matrix;
    dealii::Vector<double>           rhs;
    // clang-format off
    // Example of quadrature/element_values.h
    ElementValues values(covers, quadrature, fe, update_gradients | update_JxW_values);
    for (unsigned int element = 0; element < mesh.n_elements(); ++element)
      {
        values.reinit(element);
        element_matrix = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (const unsigned int i : values.dof_indices())
            for (const unsigned int j : values.dof_indices())
              element_matrix(i, j) +=
                values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
        constraints.distribute_local_to_global(
          element_matrix, values.get_dof_indices(), system_matrix);
      }
    // End
    // Example of quadrature/edge_values.h
    EdgeValues edge(covers, 4, fe, update_values | update_JxW_values | update_normal_vectors);
    for (const EdgePiece &piece : boundary_pieces(covers, "bore"))
      {
        edge.reinit(piece);
        for (const unsigned int q : edge.quadrature_point_indices())
          for (const unsigned int i : edge.dof_indices())
            rhs(edge.get_dof_indices()[i]) -=
              p * edge.normal(q) * edge[displacement].value(i, q) * edge.JxW(q);
      }
    // End
    // Example of quadrature/joint_values.h
    JointValues joint(covers, 4, fe, update_values | update_JxW_values);
    for (const EdgePiece &piece : joint_pieces(covers))
      {
        joint.reinit(piece);
        FullMatrix<double> joint_matrix(joint.n_current_interface_dofs());
        for (const unsigned int q : joint.quadrature_point_indices())
          for (const unsigned int i : joint.dof_indices())
            for (const unsigned int j : joint.dof_indices())
              joint_matrix(i, j) += joint.jump_in_shape_values(i, q) *
                                    joint.jump_in_shape_values(j, q) / R * joint.JxW(q);
        constraints.distribute_local_to_global(
          joint_matrix, joint.get_interface_dof_indices(), system_matrix);
      }
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  materials(const Tensor<2, 2> &H)
  {
    // clang-format off
    // Example of materials/material.h
    Material material;
    material.name           = "steel";
    material.youngs_modulus = 2.1e11;
    material.poissons_ratio = 0.3;
    material.law            = material_law("neo-Hookean");
    material.check(PlaneState::plane_strain);
    const auto law = material.hyperelastic_law(PlaneState::plane_strain);
    HyperelasticLaw::Response response;
    if (law->evaluate(H, response) == Deformation::inverted)
      return;
    // End
    // clang-format on
  }


  struct TiedPair
  {
    std::vector<unsigned int> covers;
  };


  [[maybe_unused]] void
  linear_algebra(
    const CoverSystem                                 &covers,
    const Constraints                                 &constraints,
    const std::vector<TiedPair>                       &tied_pairs,
    const unsigned int                                 first,
    const unsigned int                                 last,
    const std::function<const double *(unsigned int)> &local_matrix,
    const std::function<const double *(unsigned int)> &local_rhs,
    const bool                                        &has_converged,
    dealii::TrilinosWrappers::SparseMatrix            &matrix,
    Vector                                            &rhs,
    Vector                                            &solution)
  {
    using namespace NMM::internal;
    // clang-format off
    // Example of linear_algebra/linear_algebra.h
    CoverMatrixAssembler assembler(covers, constraints);
    for (const auto &pair : tied_pairs)
      assembler.couple(pair.covers);
    assembler.build(matrix, rhs);
    DirectSolver solver(DirectSolver::Symmetry::symmetric);
    while (!has_converged)
      {
        assembler.reset();
        for (unsigned int e = first; e < last; ++e)
          assembler.add(covers.covers(e), local_matrix(e), local_rhs(e));
        assembler.compress();
        solver.factorize(matrix);
        solver.solve(rhs, solution);
        constraints.distribute(solution);
      }
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  solution(StaticSystem &system, const Constraints &constraints, Vector &u)
  {
    // clang-format off
    // Example of solution/newton_solver.h
    NewtonSolver solver;
    const auto attempt = [&](LoadStep &step) {
      system.set_load_factor(step.load_factor);
      step.newton = solver.solve(system, constraints, u);
      if (step.newton.converged)
        return StepVerdict::accepted();
      return StepVerdict::rejected({step.newton.reason});
    };
    LoadStep step;
    take_load_steps(LoadSteps::equal(10), 0., attempt, step);
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  mechanics(CoverSystem                &covers,
            const QuadratureCollection &quadrature,
            const Constraints          &constraints,
            const ElasticityProblem    &problem,
            const Spring               &spring)
  {
    {
      // clang-format off
      // Example of mechanics/elasticity_problem.h
      StaticElasticity elasticity(covers, quadrature, constraints, problem);
      elasticity.assemble();
      elasticity.solve(LinearSolverParameters());
      DisplacementField field(covers, problem, elasticity.solution());
      // End
      // clang-format on
    }
    {
      // clang-format off
      // Example of mechanics/elasticity_problem.h
      FiniteElasticity elasticity(covers, quadrature, constraints, problem);
      NonlinearStatics statics(elasticity);
      statics.run(LoadSteps::equal(10));
      DisplacementField field(covers, problem, statics.solution());
      // End
      // clang-format on
    }
    {
      // clang-format off
      // Example of mechanics/elasticity_problem.h
      FiniteElasticity elasticity(covers, quadrature, constraints, problem);
      const auto solid = make_solid_at_rest(elasticity, Kinematics::finite);
      SpringTerm springs(covers, solid->layout(), {spring});
      NonlinearStatics statics(*solid, NewtonParameters(), {&springs});
      statics.run(LoadSteps::equal(10));
      // End
      // clang-format on
    }
  }


  [[maybe_unused]] void
  contact(CoverSystem &covers, const Constraints &constraints, SolidTerm &solid)
  {
    // clang-format off
    // Example of contact/contact.h
    ContactSurface surface(covers);
    CoulombLaw     law;
    law.normal_stiffness = 1e11;
    law.shear_stiffness  = 1e11;
    law.friction         = std::tan(0.5);
    ContactParameters parameters;
    parameters.law = std::make_shared<CoulombLaw>(law);
    Contact        contact(surface, constraints, parameters);
    ContactStatics statics(solid, contact);
    statics.run(LoadSteps::equal(10));
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  fracture(
    Geometry                                                        &geometry,
    const DisplacementField                                         &field,
    const ElasticityProblem                                         &problem,
    const double                                                     toughness,
    const double                                                     length,
    const std::function<Tensor<1, 2>(const Tensor<1, 2> &, double)> &turned)
  {
    // clang-format off
    // Example of fracture/fracture.h
    const PhysicalMesh physical_mesh(geometry);
    const std::vector<CrackTip> tips = find_crack_tips(physical_mesh);
    GradedMeshParameters mesh;
    mesh.local_sizes = sizes_at_tips(physical_mesh, 0.25);
    for (const CrackTip &tip : tips)
      {
        const IntensityFactors k = compute_intensity_factors(field, problem, tip);
        const auto verdict = HoopStressCriterion().judge(k.K_I, k.K_II);
        if (verdict.equivalent_intensity > toughness)
          extend_crack(geometry, tip.point, turned(tip.direction, verdict.angle), length, "crack");
      }
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  dynamics(FiniteElasticity                           &elasticity,
           const QuadratureCollection                 &mass_quadrature,
           const Loading                              &loading,
           Contact                                    &contact,
           const CoverSystem                          &covers,
           const Spring                               &spring,
           const Vector                               &u,
           const Vector                               &v,
           const double                                end_time,
           const std::function<void(const Account &)> &print)
  {
    // clang-format off
    // Example of dynamics/time_integrator.h
    // the rule of the masses is exact for polynomials of degree 2p
    FiniteSolid solid(elasticity, loading, make_mass_matrix(elasticity, mass_quadrature));
    ContactTerm touch(solid.layout(), contact);
    SpringTerm springs(covers, solid.layout(), {spring});
    MechanicalModel model(solid.layout(), {&solid, &touch, &springs});
    TimeIntegrator integrator(model, TimeScheme::energy_momentum());
    integrator.initialize(u, v);
    StepControlParameters parameters;
    parameters.initial_step = 1e-3;
    StepControl(parameters).run(integrator, end_time, [&](const StepRecord &) {
      print(integrator.account());
      return true;
    });
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  analysis(const Geometry                    &geometry,
           const RegularMeshParameters       &mesh,
           const SimulationParameters        &parameters,
           const StageChange                 &excavation,
           const StepControlParameters       &steps,
           const std::function<void(double)> &print)
  {
    // clang-format off
    // Example of analysis/simulation.h
    const Solid solid(geometry, mesh, MPI_COMM_WORLD);
    Simulation  simulation(solid, parameters);
    simulation.observe([&](const Simulation &now) { print(now.load_factor()); });
    simulation.equilibrate(LoadSteps::equal(10));
    simulation.apply(excavation);
    simulation.equilibrate();
    simulation.advance(1., steps);
    // End
    // clang-format on
  }


  // clang-format off
  // Example of mechanics/force_term.h
  class Band : public ForceTerm                    // a spring of the natural length 0
  {
  public:
    Band(const MaterialVector &d, const double k) : d(d), k(k) {}

    std::vector<Unknowns>
    couplings() const override
    {
      return {d.unknowns};
    }

    ForceProperties
    properties() const override
    {
      return {};                                   // linear and symmetric
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override
    {
      const auto end   = evaluate({d}, *trial.end)[0];
      const auto begin = trial.is_conserving ? evaluate({d}, *trial.begin)[0] : end;
      sum.sink->add(d, 0.5 * k * (begin + end), k * dealii::unit_symmetric_tensor<2>());
      sum.energy_of_conditions += 0.5 * k * end * end;
      return Deformation::admissible;
    }

  private:
    MaterialVector d;
    double         k;
  };
  // End
  // clang-format on


  [[maybe_unused]] void
  output(const CoverSystem       &covers,
         const DisplacementField &field,
         const StressRecovery    &recovery,
         const ElasticityProblem &problem,
         const double             t)
  {
    // clang-format off
    // Example of output/output.h
    const OutputDirectory directory("results");
    directory.create();
    FileSeries series(directory, "fields");
    const FieldEvaluator evaluator(field, recovery, problem);
    const FieldTriangles triangles(covers, &evaluator);
    series.add(t, write_fields_of_state(covers, triangles, directory, "fields-1"));
    PictureParameters parameters;
    parameters.quantity = Quantity::displacement;
    draw_picture(make_picture_data(covers, triangles, &evaluator, parameters),
                 parameters, "A beam", "results/picture.png");
    // End
    // clang-format on
  }


  [[maybe_unused]] void
  scene()
  {
    // clang-format off
    // Example of scene/scene.h
    const Scene scene("beam.prm", {"Mathematical mesh/Cell size=0.1"});
    Progress progress(std::cout, false, MPI_COMM_WORLD);
    bool has_output = false;
    SceneRunOptions options;
    options.output = "results";
    run_scene(scene, options, progress, MPI_COMM_WORLD, has_output);
    // End
    // clang-format on
  }


  std::string
  read(const std::string &file_name)
  {
    std::ifstream in(file_name);
    return {std::istreambuf_iterator<char>(in), {}};
  }


  /// The blocks of @p text between the lines that contain @p begin and @p end, without comments and
  /// blanks.
  std::vector<std::string>
  blocks_between(const std::string &text,
                 const std::string &begin,
                 const std::string &end)
  {
    static const std::regex  comments_and_blanks("//[^\n]*|\\s+");
    static const std::regex  stars("\n *\\*");
    std::vector<std::string> blocks;
    for (std::size_t at = text.find(begin); at != std::string::npos;
         at             = text.find(begin, at))
    {
      const std::size_t first = text.find('\n', at),
                        last  = text.find(end, first);
      const std::string block =
        std::regex_replace(text.substr(first, last - first), stars, "\n");
      blocks.push_back(std::regex_replace(block, comments_and_blanks, ""));
      at = last;
    }
    return blocks;
  }


  TEST(OverviewExamples, StandInTheCommentsAsTheyCompile)
  {
    const std::string here =
      read(NMM_SOURCE_DIR "/tests/words/overview_examples.cc");
    const std::string begin = std::string("// Example") + " of ";
    for (const std::string header : {"base/types.h",
                                     "geometry/geometry.h",
                                     "covers/mathematical_mesh.h",
                                     "quadrature/element_quadrature.h",
                                     "quadrature/element_values.h",
                                     "quadrature/edge_values.h",
                                     "quadrature/joint_values.h",
                                     "materials/material.h",
                                     "linear_algebra/linear_algebra.h",
                                     "solution/newton_solver.h",
                                     "mechanics/elasticity_problem.h",
                                     "contact/contact.h",
                                     "fracture/fracture.h",
                                     "dynamics/time_integrator.h",
                                     "analysis/simulation.h",
                                     "mechanics/force_term.h",
                                     "output/output.h",
                                     "scene/scene.h"})
    {
      const std::vector<std::string> documented =
        blocks_between(read(NMM_SOURCE_DIR "/include/nmm/" + header),
                       "@code",
                       "@endcode");
      EXPECT_FALSE(documented.empty()) << header;
      EXPECT_EQ(documented, blocks_between(here, begin + header, "// End"))
        << header;
    }
  }
} // namespace
