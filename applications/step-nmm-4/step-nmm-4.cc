// step-nmm-4: a jointed slope that leans on a wall, and what becomes of it without.
//
// This program follows the paper's Fig. 11: blocks of rock, cut by joints, rest
// against a wall. Equilibrium under gravity comes first; at t = 0 the wall is taken
// away, and the blocks stand or slide, as their friction has it. Each block is
// one triangle of the mathematical mesh, six nodes, twelve unknowns.

// @sect3{Include files}

#include <nmm/base/program.h>
#include <nmm/contact/assembly/term.h>
#include <nmm/contact/contact.h>
#include <nmm/contact/law/coulomb_law.h>
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
#include <nmm/output/animation.h>
#include <nmm/output/contact_output.h>
#include <nmm/output/picture.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

// `runs.cc` compares runs that begin the same. It is apart from this page since nothing of the method is in it.
#include "runs.h"
#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <memory>
#include <sstream>

namespace StepNMM4
{
  using namespace dealii;
  using NMM::CurvePiece;

  // @sect3{Parameters}

  // The paper's numbers, and what it does not say.
  struct Parameters : Tutorial::ParameterFile
  {
    using ParameterFile::ParameterFile;

    // [kg/m^3], [Pa], [-], [m/s^2]
    double density = 2500., youngs_modulus = 1e9, poissons_ratio = 0.2,
           gravity = 9.81;
    // The paper's springs, 1,000,000 t/m, taken per length of a face [Pa/m].
    double spring = get("Spring", 1e6 * 9806.65, positive);
    // Dashpots, normal and along faces [Pa s/m].
    double dashpot = get("Dashpot", 2e7, not_negative);
    // Of the rock, times its stiffness [s]: a block's own vibrations, which steps do
    // not resolve, end within a few milliseconds.
    double damping = get("Rock damping", 1e-3, not_negative);

    // Of layers [degrees], [m]; length of blocks along them [m].
    double dip          = 30.;
    double layer        = get("Layer", 2., Patterns::Double(0.5, 5.));
    double block_length = get("Block length", 2.3, Patterns::Double(0.5, 10.));

    // One run for each [degrees].
    std::vector<double> friction_angles =
      get<std::vector<double>>("Friction angles",
                               {35., 20.},
                               Patterns::List(Patterns::Double(0., 89.), 1));
    // Longest step [s], and whether what falls is computed with half of it, too.
    double step      = get("Time step", 0.01, positive);
    bool   is_halved = get("Half step", true);
    // What falls is computed once more with a friction angle that differs by this
    // [degrees]; 0: it is not. Tells what of the end can be predicted at all.
    double perturbation = get("Perturbation", 1e-7, not_negative);
    // As many runs, with 1, 2, ... times this; if more than one, each with half of
    // the step, too, to tell what the step does to their mean.
    unsigned int n_perturbed =
      get("Perturbed runs", 1u, Patterns::Integer(0, 1000));
    // Runs end here, or at rest [s].
    double end_time = get("End time", 12., positive);
    // Rest: kinetic energy over what all would gain by falling as far as a block is
    // wide, at most, for so long [s].
    double rest = 1e-7, rest_duration = 0.5;
    // Of pictures besides the begin, ascending; the last one is at the end [s].
    std::vector<double> stages =
      get<std::vector<double>>("Stages",
                               {1., 2.},
                               Patterns::List(not_negative, 0));
    // Between frames of the animation and rows of the table on the screen [s].
    double frame_interval = 0.1, row_interval = 0.5;
  };


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
    NMM::RigidObstacle ground, wall;
    ground.name   = "ground";
    ground.pieces = {CurvePiece::segment({back[0], 40.}, back),
                     CurvePiece::segment(back, toe),
                     CurvePiece::segment(toe, {-80., 0.})};
    wall.name     = "wall";
    wall.pieces   = {CurvePiece::segment({0., -1.}, {0., 14.})};
    return {ground, wall};
  }


  // @sect3{Material and springs}

  NMM::ElasticityProblem
  make_problem(const Parameters &parameters)
  {
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_strain;
    problem.materials   = {{"rock",
                            parameters.youngs_modulus,
                            parameters.poissons_ratio,
                            parameters.density}};
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


  // @sect3{Pictures}

  // Stages and the page that plays all frames, on the first rank, all in the same part of the plane.
  class Film
  {
  public:
    Film(const std::string &prefix, const double friction_angle)
      : prefix(prefix)
    {
      std::ostringstream text;
      text << "Slope, friction angle " << friction_angle << " degrees";
      title                        = text.str();
      parameters.quantity          = NMM::Quantity::displacement;
      parameters.deformation_scale = 1.;
      parameters.mesh_lines        = false;
      parameters.picture_width     = 1200;
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
        return;
      // an earlier run's frames
      const std::string frames = prefix + "-animation.frames";
      std::filesystem::remove(frames);
      animation = std::make_unique<NMM::Animation>(frames);
    }

    void
    add(const double time, const NMM::PictureData &data, const bool is_stage)
    {
      if (!animation)
        return;
      animation->add_frame(time, data);
      if (!is_stage)
        return;
      std::ostringstream note;
      note << title << ", t = " << std::fixed << std::setprecision(2) << time
           << " s";
      NMM::PictureFrame frame;
      frame.view = std::make_pair(Point<2>(-33., -1.), Point<2>(21.5, 20.5));
      NMM::draw_picture(data,
                        parameters,
                        note.str(),
                        prefix + "-stage-" + std::to_string(++n_stages) +
                          ".png",
                        frame);
    }

    void
    finish()
    {
      if (!animation)
        return;
      std::ofstream out(prefix + "-animation.html");
      animation->write(out, title, parameters);
      animation->discard();
    }

    // How pictures are coloured.
    NMM::PictureParameters parameters;

  private:
    std::string                     prefix, title;
    std::unique_ptr<NMM::Animation> animation;
    unsigned int                    n_stages = 0;
  };


  // @sect3{The model}

  // Everything from joints to forces, in the order it is made.
  class Slope
  {
  public:
    Slope(const Parameters &parameters, double friction_angle);

    Run
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
    set_in_motion(NMM::TimeIntegrator &integrator, Run &run);

    Vector
    relevant(const Vector &owned) const;

    Point<2>
    center_of_mass(const NMM::TimeIntegrator &integrator) const;

    Tutorial::Row
    row(const NMM::TimeIntegrator &integrator, const Point<2> &center) const;

    Tutorial::Row
    summary(const Run &run) const;

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
    covers->make_boundary_relevant();
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
  Run
  Slope::run(const double step, const std::string &name)
  {
    Run run;
    run.name = name;
    run.step = step;

    const Vector         u = find_equilibrium();
    NMM::ContactTerm     touch(model->layout(), *contact, {{1, 0.}});
    NMM::MechanicalModel forces(model->layout(), {model.get(), &touch});
    model->damp({/* mass = */ 0., parameters.damping},
                /* is_conserving = */ true);
    NMM::TimeIntegrator integrator(forces, NMM::TimeScheme::energy_momentum());
    integrator.initialize(u,
                          Vector(model->layout().locally_owned,
                                 MPI_COMM_WORLD));
    set_in_motion(integrator, run);
    return run;
  }


  // Until nothing moves any more, or the end. A step of the history has a picture each tenth of a second, and a
  // row on the screen each half of a second.
  void
  Slope::set_in_motion(NMM::TimeIntegrator &integrator, Run &run)
  {
    Tutorial::Table on_screen("Run " + run.name + ": energies [J/m]", 8);
    Film            film(parameters.prefix + run.name, friction_angle);
    auto            next_stage = parameters.stages.begin();
    double          next_frame = 0., next_row = 0.;
    const auto      record = [&](const bool is_last) {
      const double time = integrator.state().time;
      run.times.push_back(time);
      run.centers.push_back(center_of_mass(integrator));
      const Tutorial::Row step = row(integrator, run.centers.back());
      run.history.add(step);
      if (time >= next_row || is_last)
        on_screen.add(step);
      while (next_row <= time)
        next_row += parameters.row_interval;

      const bool is_stage =
        time == 0. || is_last ||
        (next_stage != parameters.stages.end() && time >= *next_stage);
      if (!is_stage && time < next_frame)
        return;
      film.add(time,
               draw(relevant(integrator.state().u), film.parameters),
               is_stage);
      while (next_frame <= time)
        next_frame += parameters.frame_interval;
      while (next_stage != parameters.stages.end() && time >= *next_stage)
        ++next_stage;
    };

    Timer                      timer;
    NMM::StepControlParameters steps;
    steps.initial_step = run.step;
    const NMM::StepControl control(steps);
    NMM::StepRecord        step;
    const double           rest = parameters.rest * parameters.density *
                        parameters.gravity * block_size() *
                        physical_mesh->n_blocks() * block_size() * block_size();
    double       at_rest_since = -1.;
    bool         is_at_rest    = false;
    unsigned int n_iterations = 0, n_cuts = 0;
    record(false);
    while (!is_at_rest &&
           control.advance(integrator, parameters.end_time, step))
    {
      n_iterations += step.report.n_iterations + step.n_lost_iterations;
      n_cuts += step.n_cuts;
      const double time = integrator.state().time;
      if (integrator.account().kinetic > rest)
        at_rest_since = -1.;
      else if (at_rest_since < 0.)
        at_rest_since = time;
      is_at_rest =
        at_rest_since >= 0. && time - at_rest_since >= parameters.rest_duration;
      record(is_at_rest || time >= parameters.end_time * (1. - 1e-12));
    }
    film.finish();

    constexpr double settlement = 0.05;
    run.stands = is_at_rest && run.way_at(run.times.back()) < settlement;
    run.row    = Tutorial::Row{{"run", run.name},
                            {"stands", run.stands},
                            {"is_at_rest", is_at_rest},
                            {"end_time", run.times.back()},
                            {"steps", run.times.size() - 1},
                            {"cuts", n_cuts},
                            {"iterations", n_iterations}} +
              summary(run) +
              Tutorial::Row{{"motion_seconds", timer.cpu_time()}};
  }


  // @sect3{What is reported}

  // A step: energies per unit thickness [J/m], and how deep blocks are in each other over their size [-].
  // What penetrates without pressing is none of the contact's springs: the overlap counts it, too.
  Tutorial::Row
  Slope::row(const NMM::TimeIntegrator &integrator,
             const Point<2>            &center) const
  {
    const NMM::Account &account = integrator.account();
    return {{"time", integrator.state().time},
            {"x", center[0]},
            {"y", center[1]},
            {"kinetic", account.kinetic},
            {"external_work", account.external_work},
            {"dissipated", account.dissipated},
            {"balance", account.balance},
            {"penetration_over_block",
             contact->report().largest_penetration / block_size()},
            {"overlap_over_block", surface->largest_overlap() / block_size()}};
  }


  // What the table of runs has of the history: the largest error of the account over the potential energy released
  // until the end, and penetrations.
  Tutorial::Row
  Slope::summary(const Run &run) const
  {
    const double released      = run.history.column("external_work").back();
    double       account_error = 0.;
    for (const double balance : run.history.column("balance"))
      account_error = std::max(account_error, std::abs(balance));
    if (released != 0.)
      account_error /= std::abs(released);
    const Extent penetration(run.history.column("penetration_over_block")),
      overlap(run.history.column("overlap_over_block"));
    return {{"account_error", account_error},
            {"largest_penetration", penetration.largest},
            {"penetration_at_rest", penetration.last},
            {"largest_overlap", overlap.largest},
            {"overlap_at_rest", overlap.last},
            {"median_penetration", penetration.median},
            {"median_overlap", overlap.median},
            {"blocks", physical_mesh->n_blocks()},
            {"unknowns",
             2 * (covers->n_covers() - aggregation.cover_to_root.size())},
            {"released", released},
            {"way", run.way_at(run.times.back())}};
  }


  // The density is the same everywhere.
  Point<2>
  Slope::center_of_mass(const NMM::TimeIntegrator &integrator) const
  {
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
    return Point<2>(sums[1] / sums[0], sums[2] / sums[0]);
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


  // @sect3{The study}

  // What falls is computed once more with half of the step, and with friction angles that are nearly the same.
  void
  run_study(const Parameters &parameters)
  {
    std::vector<Run> runs;
    const auto       add = [&](const double       friction_angle,
                         const std::string &name,
                         const bool         is_halved) {
      runs.push_back(Slope(parameters, friction_angle)
                       .run((is_halved ? 0.5 : 1.) * parameters.step,
                            name + (is_halved ? "-half-step" : "")));
    };
    const unsigned int n_perturbed =
      parameters.perturbation > 0. ? parameters.n_perturbed : 0;
    for (const double friction_angle : parameters.friction_angles)
    {
      std::ostringstream name;
      name << std::setprecision(12) << friction_angle;
      add(friction_angle, name.str(), false);
      if (runs.back().stands)
        continue;
      if (parameters.is_halved)
        add(friction_angle, name.str(), true);
      for (unsigned int k = 1; k <= n_perturbed; ++k)
      {
        const double perturbed = friction_angle + k * parameters.perturbation;
        const std::string run_name =
          name.str() + "-perturbed" +
          (n_perturbed == 1 ? "" : "-" + std::to_string(k));
        add(perturbed, run_name, false);
        if (n_perturbed > 1 && parameters.is_halved)
          add(perturbed, run_name, true);
      }
    }
    report_runs(parameters.prefix, runs);
  }
} // namespace StepNMM4


// @sect3{The main function}

int
main(int argc, char **argv)
{
  return Tutorial::run<StepNMM4::Parameters>("step-nmm-4",
                                             argc,
                                             argv,
                                             StepNMM4::run_study);
}
