// step-nmm-4: a jointed slope that leans on a wall, and what becomes of it without.
//
// This program follows the paper's Fig. 11: blocks of rock, cut by joints, rest
// against a wall. Equilibrium under gravity comes first; at t = 0 the wall is taken
// away, and the blocks stand or slide, as their friction has it. Each block is
// one triangle of the mathematical mesh, six nodes, twelve unknowns.

// @sect3{Include files}

#include <nmm/base/program.h>
#include <nmm/contact/contact.h>
#include <nmm/contact/contact_term.h>
#include <nmm/contact/coulomb_law.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/dynamics/time_integrator.h>
#include <nmm/geometry/joint_network.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/contact_output.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

// `study.cc` has the parameters, the tables, the comparison of runs that begin the same, and the
// pictures. It is apart from this page since nothing of the method is in it.
#include "study.h"
#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>

namespace StepNMM4
{
  using namespace dealii;
  using NMM::CurvePiece;

  // @sect3{Geometry}

  // Where layers and ground lie [m]. The ground dips a little more steeply than the
  // layers, so that no sliver is left between the lowest joint and the ground.
  const Point<2> toe(0., 0.), back(20.7, 12.), top(20.7, 19.),
    crest(12.95, 19.), edge(0., 11.5);


  // The layers are a set of joints that run through. Joints across a layer
  // end at its faces and are offset from one layer to the next by half of a block, as
  // bricks are: in rock, too, layers break one by one. They reach into the
  // next layer by a length that means nothing, so that they surely meet its face; what
  // bounds no block does not count (`drops_ends`).
  NMM::Geometry
  make_slope(const Parameters &parameters)
  {
    NMM::Geometry geometry;
    geometry.add_polygon({toe, back, top, crest, edge},
                         "slope",
                         NMM::CurveRole::boundary,
                         "rock");
    NMM::JointSet layers;
    layers.name       = "layers";
    layers.dip        = parameters.dip;
    layers.spacing    = parameters.layer;
    layers.drops_ends = true;
    for (NMM::Curve &joint : NMM::make_joints(layers, geometry))
      geometry.add(std::move(joint));

    const double         angle = parameters.dip * numbers::PI / 180.;
    const Tensor<1, 2>   along({std::cos(angle), std::sin(angle)});
    const Tensor<1, 2>   across({-along[1], along[0]});
    constexpr double     overshoot = 1e-6;
    const double         highest = across * edge, furthest = along * top;
    const BoundingBox<2> box({toe, top});
    for (int row = 0; row * parameters.layer < highest; ++row)
      for (int i = -static_cast<int>(furthest / parameters.block_length);
           i * parameters.block_length < furthest;
           ++i)
      {
        const double s =
          (i + (row % 2 == 0 ? 0.7 : 0.2)) * parameters.block_length;
        const Point<2> middle(s * along +
                              (row + 0.5) * parameters.layer * across);
        if (!box.point_inside(middle))
          continue;
        const double half = 0.5 * parameters.layer + overshoot;
        NMM::Curve   joint;
        joint.name       = "cross joint";
        joint.role       = NMM::CurveRole::joint;
        joint.drops_ends = true;
        joint.is_clipped = true;
        joint.pieces     = {
              CurvePiece::segment(middle - half * across, middle + half * across)};
        geometry.add(std::move(joint));
      }
    return geometry;
  }


  // @sect3{Ground and wall}

  // Bodies that do not deform are on the left of their lines.
  std::vector<NMM::RigidObstacle>
  make_obstacles()
  {
    NMM::RigidObstacle ground;
    ground.name                   = "ground";
    const std::vector<Point<2>> p = {Point<2>(back[0], 40.),
                                     back,
                                     toe,
                                     Point<2>(-80., 0.)};
    for (unsigned int i = 0; i + 1 < p.size(); ++i)
      ground.pieces.push_back(CurvePiece::segment(p[i], p[i + 1]));

    NMM::RigidObstacle wall;
    wall.name   = "wall";
    wall.pieces = {CurvePiece::segment({0., -1.}, {0., 14.})};
    return {ground, wall};
  }


  // @sect3{Material and springs}

  NMM::ElasticityProblem
  make_problem(const Parameters &parameters)
  {
    NMM::Material rock;
    rock.name           = "rock";
    rock.youngs_modulus = parameters.youngs_modulus;
    rock.poissons_ratio = parameters.poissons_ratio;
    rock.density        = parameters.density;
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_strain;
    problem.materials   = {rock};
    problem.gravity     = Tensor<1, 2>({0., -parameters.gravity});
    return problem;
  }


  // Springs conserve: without dashpots blocks would bounce for ever. A face of two
  // metres of rock on a spring of 1e10 Pa/m is critically damped by 1.4e7 Pa s/m; a
  // corner, which has less spring, needs more.
  NMM::ContactParameters
  make_contact_parameters(const Parameters &parameters,
                          const double      friction_angle)
  {
    NMM::CoulombLaw law;
    law.normal_stiffness = parameters.spring;
    law.shear_stiffness  = parameters.spring;
    law.normal_damping   = parameters.dashpot;
    law.shear_damping    = parameters.dashpot;
    law.friction         = std::tan(friction_angle * numbers::PI / 180.);
    NMM::ContactParameters contact;
    contact.law   = std::make_shared<NMM::CoulombLaw>(law);
    contact.reach = 0.05;
    return contact;
  }


  // @sect3{The model}

  // Everything from joints to forces, in the order it is made.
  class Slope
  {
  public:
    Slope(const Parameters &parameters, double friction_angle);

    Outcome
    run(double step, const std::string &name);

  private:
    using Vector = NMM::MechanicalModel::Vector;

    const Parameters                           parameters;
    const double                               friction_angle;
    NMM::ElasticityProblem                     problem;
    std::unique_ptr<NMM::PhysicalMesh>         physical_mesh;
    NMM::OwnMeshes                             meshes;
    std::unique_ptr<NMM::CoverSystem>          covers;
    std::unique_ptr<NMM::ContactSurface>       surface;
    NMM::Aggregation                           aggregation;
    AffineConstraints<double>                  constraints;
    std::unique_ptr<NMM::QuadratureCollection> quadrature, mass_quadrature;
    std::unique_ptr<NMM::FiniteElasticity>     elasticity;
    std::unique_ptr<NMM::FiniteSolid>          model;
    std::unique_ptr<NMM::Contact>              contact;

    Vector
    find_equilibrium();

    void
    set_in_motion(NMM::TimeIntegrator &integrator,
                  double               step,
                  Outcome             &outcome);

    Vector
    relevant(const Vector &owned) const;

    Row
    make_row(const NMM::TimeIntegrator &integrator) const;

    NMM::PictureData
    draw(const Vector &u, const NMM::PictureParameters &output) const;

    /// Root of the mean area [m].
    double
    block_size() const;
  };


  // A regular mesh much coarser than blocks, and then a mesh of its own for each block:
  // where a block is smaller than the cells, the smallest triangle around it. That
  // is the paper's second mesh taken to its end: twelve unknowns move the block,
  // turn it and let its strain vary linearly.
  Slope::Slope(const Parameters &parameters, const double friction_angle)
    : parameters(parameters)
    , friction_angle(friction_angle)
    , problem(make_problem(parameters))
  {
    physical_mesh = std::make_unique<NMM::PhysicalMesh>(make_slope(parameters));
    NMM::RegularMeshParameters mesh;
    mesh.cell_size = 5. * parameters.block_length;
    NMM::OwnMeshParameters own;
    own.every_region = true;
    meshes =
      NMM::make_own_meshes(std::make_unique<NMM::MathematicalMesh>(
                             NMM::make_regular_mesh(*physical_mesh, mesh, 2)),
                           *physical_mesh,
                           own);

    covers =
      std::make_unique<NMM::CoverSystem>(*meshes.manifold_mesh, MPI_COMM_WORLD);
    surface = std::make_unique<NMM::ContactSurface>(*covers, make_obstacles());
    aggregation = NMM::aggregate(*covers);
    constraints = NMM::make_constraints(*covers, aggregation, 2);
    quadrature  = std::make_unique<NMM::QuadratureCollection>(
      *meshes.manifold_mesh, 2, 4, covers->locally_owned_elements());
    mass_quadrature = std::make_unique<NMM::QuadratureCollection>(
      *meshes.manifold_mesh, 4, 4, covers->locally_owned_elements());
    elasticity = std::make_unique<NMM::FiniteElasticity>(
      *covers, *quadrature, constraints, problem, /* may_float = */ true);
    model = std::make_unique<NMM::FiniteSolid>(
      *elasticity,
      NMM::Loading(),
      NMM::make_mass_matrix(*elasticity, *mass_quadrature));
    contact =
      std::make_unique<NMM::Contact>(*surface,
                                     constraints,
                                     make_contact_parameters(parameters,
                                                             friction_angle));
  }


  double
  Slope::block_size() const
  {
    double area = 0.;
    for (const NMM::PhysicalMesh::Region &region : physical_mesh->regions())
      area += region.area;
    return std::sqrt(area / physical_mesh->n_blocks());
  }


  Slope::Vector
  Slope::relevant(const Vector &owned) const
  {
    Vector result(model->layout().locally_owned,
                  model->layout().locally_relevant,
                  MPI_COMM_WORLD);
    result = owned;
    return result;
  }


  // @sect3{Equilibrium}

  // Contact alone holds the blocks, and where each finds its place is not known
  // before: load steps of a static analysis would have to decide for hundreds of
  // points at once. Relaxation lets the blocks move, and stops them whenever
  // their kinetic energy has passed a peak. The wall stands. Places where points stick are
  // remembered by `contact`, and the motion goes on from them.
  Slope::Vector
  Slope::find_equilibrium()
  {
    NMM::ContactTerm          touch(model->layout(), *contact);
    NMM::MechanicalModel      forces(model->layout(), {model.get(), &touch});
    NMM::TimeIntegrator       integrator(forces,
                                   NMM::TimeScheme::constant_acceleration());
    NMM::RelaxationParameters relaxation;
    relaxation.step = 1e-3;
    NMM::relax(integrator, relaxation);
    return integrator.state().u;
  }


  // @sect3{Release and motion}

  // The wall, obstacle 1, is there until the time 0. The scheme conserves energy in the contacts, too, so that the account shows what
  // friction, dashpots and the damping of the rock take, and nothing else. Dozens of
  // points that stick or slip by turns can cost Newton's method many iterations.
  Outcome
  Slope::run(const double step, const std::string &name)
  {
    Outcome outcome;
    outcome.name           = name;
    outcome.friction_angle = friction_angle;
    outcome.step           = step;
    outcome.n_blocks       = physical_mesh->n_blocks();
    outcome.n_unknowns =
      2 * (covers->n_covers() - aggregation.cover_to_root.size());

    Timer        timer;
    const Vector u     = find_equilibrium();
    outcome.start_time = timer.cpu_time();

    NMM::ContactTerm     touch(model->layout(), *contact, {{1, 0.}});
    NMM::MechanicalModel forces(model->layout(), {model.get(), &touch});
    NMM::TimeIntegrator  integrator(forces,
                                   NMM::TimeScheme::energy_momentum(),
                                   {/* mass = */ 0., parameters.damping});
    integrator.initialize(u,
                          Vector(model->layout().locally_owned,
                                 MPI_COMM_WORLD));
    set_in_motion(integrator, step, outcome);
    outcome.motion_time = timer.cpu_time() - outcome.start_time;
    outcome.finish();
    return outcome;
  }


  // Until nothing moves any more, or the end.
  void
  Slope::set_in_motion(NMM::TimeIntegrator &integrator,
                       const double         step,
                       Outcome             &outcome)
  {
    NMM::StepControlParameters steps;
    steps.initial_step = step;
    const NMM::StepControl control(steps);

    Tutorial::Table on_screen("Run " + outcome.name + ": energies [J/m]", 10);
    Film            film(parameters, outcome);
    auto            next_stage = parameters.stages.begin();
    double          next_frame = 0., next_row = 0., at_rest_since = -1.;
    const auto      record = [&](const bool is_last) {
      const Row row = make_row(integrator);
      outcome.rows.push_back(row);
      if (row.time >= next_row || is_last)
        on_screen.add(cells(row));
      while (next_row <= row.time)
        next_row += parameters.row_interval;

      const bool is_stage =
        row.time == 0. || is_last ||
        (next_stage != parameters.stages.end() && row.time >= *next_stage);
      if (!is_stage && row.time < next_frame)
        return;
      const NMM::PictureData picture =
        draw(relevant(integrator.state().u), film.output());
      film.add_frame(row.time, picture);
      if (is_stage)
        film.draw_stage(row.time, picture);
      while (next_frame <= row.time)
        next_frame += parameters.frame_interval;
      while (next_stage != parameters.stages.end() && row.time >= *next_stage)
        ++next_stage;
    };

    const double rest = parameters.rest * parameters.density *
                        parameters.gravity * block_size() *
                        physical_mesh->n_blocks() * block_size() * block_size();
    record(false);
    NMM::StepRecord step_record;
    while (!outcome.is_at_rest &&
           control.advance(integrator, parameters.end_time, step_record))
    {
      ++outcome.n_steps;
      outcome.n_iterations +=
        step_record.report.n_iterations + step_record.n_lost_iterations;
      outcome.n_cuts += step_record.n_cuts;
      const NMM::Account &account = integrator.account();
      const double        time    = integrator.state().time;
      if (account.kinetic > rest)
        at_rest_since = -1.;
      else if (at_rest_since < 0.)
        at_rest_since = time;
      outcome.is_at_rest =
        at_rest_since >= 0. && time - at_rest_since >= parameters.rest_duration;
      record(outcome.is_at_rest || time >= parameters.end_time * (1. - 1e-12));
    }
    film.finish();
  }


  // @sect3{What is reported}

  Row
  Slope::make_row(const NMM::TimeIntegrator &integrator) const
  {
    const NMM::Account &account = integrator.account();
    Row                 row;
    row.time          = integrator.state().time;
    row.kinetic       = account.kinetic;
    row.strain        = account.strain;
    row.contact       = account.conditions;
    row.dissipated    = account.dissipated;
    row.external_work = account.external_work;
    row.balance       = account.balance;

    const NMM::ContactReport &report = contact->report();
    row.n_stick                      = report.n_stick;
    row.n_slip                       = report.n_slip;
    row.penetration                  = report.largest_penetration;
    row.penetration_over_block       = row.penetration / block_size();
    // what penetrates without pressing is none of the contact's springs
    row.overlap            = surface->largest_overlap();
    row.overlap_over_block = row.overlap / block_size();

    // the density is the same everywhere
    const NMM::ManifoldMesh     &mesh = *meshes.manifold_mesh;
    const NMM::DisplacementField field(*covers,
                                       problem,
                                       relevant(integrator.state().u));
    std::vector<double>          local(3, 0.), sums(3);
    const auto [first, last] = covers->locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
    {
      const Quadrature<2> &rule = mass_quadrature->rule(element);
      const unsigned int   cell = mesh.cell(element);
      const double         area = meshes.mathematical_mesh->cell_area(cell);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const Point<2> x =
          meshes.mathematical_mesh->reference_to_real(cell, rule.point(q)) +
          field.displacement(element, rule.point(q));
        local[0] += rule.weight(q) * area;
        local[1] += rule.weight(q) * area * x[0];
        local[2] += rule.weight(q) * area * x[1];
      }
    }
    Utilities::MPI::sum(local, MPI_COMM_WORLD, sums);
    row.center_of_mass = Point<2>(sums[1] / sums[0], sums[2] / sums[0]);
    return row;
  }


  NMM::PictureData
  Slope::draw(const Vector &u, const NMM::PictureParameters &output) const
  {
    const NMM::DisplacementField field(*covers, problem, u);
    const NMM::StressRecovery    recovery(field, aggregation);
    const NMM::FieldEvaluator    evaluator(field, recovery, problem);
    const NMM::FieldTriangles    triangles(*covers, &evaluator);
    NMM::PictureData             data =
      NMM::make_picture_data(*covers, triangles, &evaluator, output);
    NMM::add_contact(*surface,
                     NMM::gather_contact_points(*surface, contact->points()),
                     data);
    return data;
  }
} // namespace StepNMM4


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM4;
  return Tutorial::run(
    argc,
    argv,
    [](const std::string &parameter_file, const std::string &output_directory) {
      const Parameters parameters =
        read_parameters(parameter_file, output_directory);
      Tutorial::make_output_directory(output_directory);

      std::vector<Outcome> outcomes;
      for (const double friction_angle : parameters.friction_angles)
      {
        std::ostringstream number;
        number << std::setprecision(12) << friction_angle;
        const std::string name = number.str();
        outcomes.push_back(
          Slope(parameters, friction_angle).run(parameters.step, name));
        if (outcomes.back().stands())
          continue;
        if (parameters.is_halved)
          outcomes.push_back(
            Slope(parameters, friction_angle)
              .run(0.5 * parameters.step, name + "-half-step"));
        const unsigned int n_perturbed =
          parameters.perturbation > 0. ? parameters.n_perturbed : 0;
        for (unsigned int k = 1; k <= n_perturbed; ++k)
        {
          const double perturbed = friction_angle + k * parameters.perturbation;
          const std::string run_name =
            name + "-perturbed" +
            (n_perturbed == 1 ? "" : "-" + std::to_string(k));
          outcomes.push_back(
            Slope(parameters, perturbed).run(parameters.step, run_name));
          if (n_perturbed > 1 && parameters.is_halved)
            outcomes.push_back(
              Slope(parameters, perturbed)
                .run(0.5 * parameters.step, run_name + "-half-step"));
        }
      }
      report_runs(output_directory + "/step-nmm-4-", outcomes);
      print_means(outcomes);
    });
}
