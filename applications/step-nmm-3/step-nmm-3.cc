// step-nmm-3: a cylinder pressed between two plates, on a mesh that does not fit it.
//
// This program follows the paper's Figs. 8 and 9. While the contact is narrow,
// Hertz's formulas hold, and the pressure can be judged point by point; then
// the plates approach by 0.4 of the radius, and the force is compared with that
// of two other programs; and in the end there is the paper's own set-up, a whole
// cylinder between two plates that deform.

// @sect3{Include files}

#include <nmm/base/program.h>
#include <nmm/contact/assembly/statics.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

// `hertz.cc` has the parameters, Hertz's formulas and the comparison with reference values, `figures.gp` the
// figures. They are apart from this page since nothing of the method is in them.
#include "disk_compression_csv.h"
#include "figures_gp.h"
#include "hertz.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

namespace StepNMM3
{
  using namespace dealii;
  using NMM::CurvePiece;

  // @sect3{Geometry}

  // By symmetry a quarter is enough as long as the plates are rigid: here the
  // lower right one. The arc stays an arc, and its normals are those of a circle.
  NMM::Geometry
  make_quarter_disk()
  {
    return NMM::parse_geometry(R"(
      boundary name=arc    material=cylinder CIRCULARSTRING (0 -1, 0.7071067811865476 -0.7071067811865476, 1 0)
      boundary name=middle material=cylinder LINESTRING (1 0, 0 0)
      boundary name=axis   material=cylinder LINESTRING (0 0, 0 -1))",
                               "the quarter disk");
  }


  // The paper's set-up. The plates touch the circle in one point each; that is
  // no special case for an exact arrangement.
  NMM::Geometry
  make_press()
  {
    return NMM::parse_geometry(R"(
      boundary name=cylinder material=cylinder CIRCLE (0 0, 1)
      boundary name=lower  material=plate LINESTRING (-1.2 -1.4, 1.2 -1.4)
      boundary name=bottom material=plate LINESTRING (1.2 -1.4, 1.2 -1, -1.2 -1, -1.2 -1.4)
      boundary name=top    material=plate LINESTRING (-1.2 1.4, -1.2 1, 1.2 1, 1.2 1.4)
      boundary name=upper  material=plate LINESTRING (1.2 1.4, -1.2 1.4))",
                               "the press");
  }


  // Small triangles where there will be contact, and nowhere else.
  NMM::GradedMeshParameters
  make_mesh_parameters(const Parameters          &parameters,
                       const double               contact_size,
                       const double               half_width,
                       const std::vector<double> &heights)
  {
    NMM::GradedMeshParameters mesh;
    mesh.cell_size = std::max(parameters.cell_size, contact_size);
    mesh.offset    = parameters.placement.offset;
    mesh.rotation  = parameters.placement.rotation;
    for (const double y : heights)
    {
      NMM::LocalSize box;
      box.kind          = NMM::LocalSize::Kind::box;
      const double high = 0.2 * half_width;
      box.lower         = Point<2>(-half_width, y - high);
      box.upper         = Point<2>(half_width, y + high);
      box.size          = contact_size;
      box.growth        = parameters.growth;
      mesh.local_sizes.push_back(box);
    }
    return mesh;
  }


  // @sect3{Materials and conditions}

  NMM::ElasticityProblem
  make_problem(const Parameters                              &parameters,
               const std::shared_ptr<const NMM::MaterialLaw> &law)
  {
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_strain;
    problem.materials   = {
        {"cylinder", parameters.youngs_modulus, parameters.poissons_ratio},
        {"plate", parameters.plate_modulus, parameters.poissons_ratio}};
    for (NMM::Material &material : problem.materials)
      material.law = law;
    return problem;
  }


  void
  add_condition(NMM::ElasticityProblem            &problem,
                const std::string                 &curve,
                const NMM::BoundaryCondition::Type type,
                const std::vector<double>         &value)
  {
    problem.boundary_conditions.push_back(
      {curve,
       curve,
       type,
       std::make_shared<Functions::ConstantFunction<2>>(value)});
  }


  // Half of the approach moves the middle of the cylinder down to the rigid plate.
  NMM::ElasticityProblem
  make_quarter_problem(const Parameters &parameters,
                       const std::shared_ptr<const NMM::MaterialLaw> &law,
                       const double                                   approach)
  {
    NMM::ElasticityProblem problem = make_problem(parameters, law);
    const auto type = NMM::BoundaryCondition::Type::normal_displacement;
    add_condition(problem, "axis", type, {0.});
    add_condition(problem, "middle", type, {-0.5 * approach});
    return problem;
  }


  // Between frictionless plates nothing holds the cylinder against sideways
  // motion and rotation, and before there is contact nothing holds it at all. By
  // symmetry its middle moves down half as far as the top plate, and its
  // vertical axis stays vertical. Two soft springs (12) say so. The forces in them
  // are what the mesh lacks in symmetry.
  NMM::ElasticityProblem
  make_press_problem(const Parameters &parameters)
  {
    NMM::ElasticityProblem problem =
      make_problem(parameters, NMM::material_law("neo-Hookean"));
    const auto type = NMM::BoundaryCondition::Type::displacement;
    add_condition(problem, "lower", type, {0., 0.});
    add_condition(problem, "upper", type, {0., -parameters.approach});

    NMM::FixedPoint middle;
    middle.point        = Point<2>(0., 0.);
    middle.displacement = Tensor<1, 2>({0., -0.5 * parameters.approach});
    middle.stiffness    = parameters.youngs_modulus;
    NMM::FixedPoint above(middle);
    above.point          = Point<2>(0., 0.5 * parameters.radius);
    above.components[1]  = false;
    problem.fixed_points = {middle, above};
    return problem;
  }


  // @sect3{The model}

  // Everything from the curves to the solver, in the order it is made. The
  // stages are timed, in seconds of the processor.
  class Model
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    struct Setup
    {
      NMM::Geometry                   geometry;
      std::vector<NMM::RigidObstacle> obstacles;
      NMM::GradedMeshParameters       mesh;
      NMM::ElasticityProblem          problem;
      bool                            is_linear = false;
      NMM::ContactParameters          contact;
    };

    Model(Setup setup);

    // Equal load steps; what is done after each of them gets the load factor and the
    // displacements.
    using Action = std::function<void(double, const Vector &)>;

    void
    run(unsigned int n_steps, const Action &after_step);

    std::vector<PressurePoint>
    pressure_at_reference_places() const;

    std::vector<PressurePoint>
    current_pressure() const;

    std::array<double, 2>
    forces() const;

    Tutorial::Table
    outlines() const;

    Tutorial::Table
    material_lines(const Vector &u) const;

    Timer        timer;
    double       cutting_time = 0., setup_time = 0., total_time = 0.;
    unsigned int n_unknowns = 0, n_iterations = 0, n_cuts = 0;

    const NMM::ElasticityProblem               problem;
    std::unique_ptr<NMM::PhysicalMesh>         physical_mesh;
    std::unique_ptr<NMM::MathematicalMesh>     mathematical_mesh;
    std::unique_ptr<NMM::ManifoldMesh>         manifold_mesh;
    std::unique_ptr<NMM::CoverSystem>          covers;
    std::unique_ptr<NMM::ContactSurface>       surface;
    AffineConstraints<double>                  constraints;
    std::unique_ptr<NMM::QuadratureCollection> quadrature;
    std::unique_ptr<NMM::FiniteElasticity>     elasticity;
    std::unique_ptr<NMM::SolidTerm>            solid;
    std::unique_ptr<NMM::Contact>              contact;
    std::unique_ptr<NMM::ContactStatics>       statics;
  };


  Model::Model(Setup setup)
    : problem(std::move(setup.problem))
  {
    physical_mesh =
      std::make_unique<NMM::PhysicalMesh>(std::move(setup.geometry));
    mathematical_mesh = std::make_unique<NMM::MathematicalMesh>(
      NMM::make_graded_mesh(*physical_mesh, setup.mesh, 2));
    manifold_mesh =
      std::make_unique<NMM::ManifoldMesh>(*mathematical_mesh, *physical_mesh);
    cutting_time = timer.cpu_time();

    // Contact needs the covers of all faces on every rank, and so does what these depend on by
    // aggregation.
    covers = std::make_unique<NMM::CoverSystem>(*manifold_mesh, MPI_COMM_WORLD);
    covers->make_boundary_relevant();
    surface = std::make_unique<NMM::ContactSurface>(*covers,
                                                    std::move(setup.obstacles));
    const NMM::Aggregation aggregation = NMM::aggregate(*covers);
    constraints = NMM::make_constraints(*covers, aggregation, 2);
    quadrature  = std::make_unique<NMM::QuadratureCollection>(
      *manifold_mesh,
      2,
      setup.is_linear ? 2 : 4,
      covers->locally_owned_elements());
    elasticity = std::make_unique<NMM::FiniteElasticity>(*covers,
                                                         *quadrature,
                                                         constraints,
                                                         problem);
    solid      = NMM::make_solid_at_rest(*elasticity,
                                    setup.is_linear ? NMM::Kinematics::small
                                                         : NMM::Kinematics::finite);

    // Of two bodies the softer one carries the contact points: the stiff one's
    // boundary bends less from edge to edge.
    setup.contact.slave_priority.assign(physical_mesh->n_blocks(), 0);
    for (const auto &region : physical_mesh->regions())
      if (physical_mesh->material_names()[region.material] == "plate")
        setup.contact.slave_priority[region.block] = 1;
    contact =
      std::make_unique<NMM::Contact>(*surface, constraints, setup.contact);
    statics    = std::make_unique<NMM::ContactStatics>(*solid, *contact);
    setup_time = timer.cpu_time() - cutting_time;
    n_unknowns = 2 * (covers->n_covers() - aggregation.cover_to_root.size());
  }


  void
  Model::run(const unsigned int n_steps, const Action &after_step)
  {
    statics->run(NMM::LoadSteps::equal(n_steps),
                 [&](const NMM::ContactStep &step, const Vector &u) {
                   n_iterations += step.n_iterations + step.n_lost_iterations;
                   n_cuts += step.n_cuts;
                   if (step.is_asked)
                     after_step(step.load_factor, u);
                 });
    total_time = timer.cpu_time();
  }


  // A contact point is on the rank that owns its edge.
  std::vector<PressurePoint>
  of_all_ranks(const std::vector<PressurePoint> &points)
  {
    std::vector<double> mine;
    for (const PressurePoint &point : points)
      mine.insert(mine.end(), {point.x, point.pressure, point.weight});
    std::vector<PressurePoint> result;
    for (const auto &part : Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      for (unsigned int i = 0; i < part.size(); i += 3)
        result.push_back({part[i], part[i + 1], part[i + 2]});
    return result;
  }


  // Hertz's theory is linear: it does not know whether x is where a point was or
  // where it went, and points of the contact move inwards by 3 percent of x at
  // a half-width of 0.1 R. In the linear problem it has to be the reference
  // place, where the pressure acts.
  std::vector<PressurePoint>
  Model::pressure_at_reference_places() const
  {
    std::vector<PressurePoint> result;
    for (const NMM::ContactPoint &point : contact->points())
      if (point.master != NMM::invalid_index)
        result.push_back(
          {std::abs(surface->reference_place(point.edge, point.s).x[0]),
           point.pressure,
           point.weight});
    return of_all_ranks(result);
  }


  // The springs' pressure is per reference length; what Fig. 9 shows is force
  // over current length.
  std::vector<PressurePoint>
  Model::current_pressure() const
  {
    std::vector<PressurePoint> result;
    for (const NMM::ContactPoint &point : contact->points())
      if (point.pressure > 0. && point.normal[1] > 0.)
      {
        const double stretch =
          surface->place(point.edge, point.s).a.norm() /
          surface->reference_place(point.edge, point.s).a.norm();
        result.push_back(
          {point.x[0], point.pressure / stretch, point.weight * stretch});
      }
    return of_all_ranks(result);
  }


  // Force on the cylinder from below and from above [N/m].
  std::array<double, 2>
  Model::forces() const
  {
    std::array<double, 2> result{{0., 0.}};
    for (const NMM::ContactPoint &point : contact->points())
      if (point.pressure > 0.)
        result[point.normal[1] > 0. ? 0 : 1] +=
          point.weight * point.pressure * std::abs(point.normal[1]);
    for (double &force : result)
      force = Utilities::MPI::sum(force, MPI_COMM_WORLD);
    return result;
  }


  // Outlines come from the surface, which knows where its edges are; material
  // lines from the displacement field.
  Tutorial::Table
  Model::outlines() const
  {
    Tutorial::Table table;
    for (unsigned int e = 0; e < surface->edges().size(); ++e)
    {
      if (surface->is_rigid(e))
        continue;
      constexpr unsigned int n = 4;
      for (unsigned int i = 0; i <= n; ++i)
      {
        const Point<2> x = surface->place(e, i / double(n)).x;
        table.add({{"x_m", x[0]}, {"y_m", x[1]}});
      }
      table.add_break();
    }
    return table;
  }


  Tutorial::Table
  Model::material_lines(const Vector &u) const
  {
    const NMM::DisplacementField field(*covers, problem, u);
    constexpr unsigned int       n_lines = 4, n = 80;
    const auto                   owned = covers->locally_owned_elements();
    // line, position on it, and where the point is, for points in this rank's
    // elements
    std::vector<double> mine;
    for (unsigned int line = 0; line < 2 * (2 * n_lines + 1); ++line)
    {
      const double a = (line / 2 / double(n_lines) - 1.) * 0.98;
      const double b = std::sqrt(1. - a * a);
      for (unsigned int k = 0; k <= n; ++k)
      {
        const double       c = (2. * k / n - 1.) * b * (1. - 1e-6);
        const Point<2>     x = line % 2 == 0 ? Point<2>(a, c) : Point<2>(c, a);
        const unsigned int element = manifold_mesh->find_element(x);
        if (element == NMM::invalid_index || element < owned.first ||
            element >= owned.second)
          continue;
        const Point<2> now =
          x + field.displacement(element,
                                 mathematical_mesh->real_to_reference(
                                   manifold_mesh->cell(element), x));
        mine.insert(mine.end(), {double(line), double(k), now[0], now[1]});
      }
    }
    std::map<std::pair<double, double>, Point<2>> points;
    for (const auto &part : Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      for (unsigned int i = 0; i < part.size(); i += 4)
        points[{part[i], part[i + 1]}] = Point<2>(part[i + 2], part[i + 3]);
    Tutorial::Table table;
    double          last_line = 0.;
    for (const auto &[place, x] : points)
    {
      if (place.first != last_line)
        table.add_break();
      last_line = place.first;
      table.add({{"x_m", x[0]}, {"y_m", x[1]}});
    }
    return table;
  }


  // @sect3{Springs}

  // The penalty method needs stiff springs, and its Newton iteration more
  // steps the stiffer they are. With multipliers, springs of ten times the
  // stiffness of a triangle are enough.
  NMM::ContactParameters
  make_contact_parameters(const Parameters &parameters,
                          const Enforcement enforcement,
                          const double      contact_size,
                          const double      approach,
                          const double      penalty_spring = 0.)
  {
    const bool             is_augmented = enforcement == Enforcement::augmented;
    NMM::CoulombLaw        law;
    NMM::ContactParameters contact;
    law.normal_stiffness =
      penalty_spring > 0. && !is_augmented
        ? penalty_spring
        : (is_augmented ? 10. : 30.) * parameters.youngs_modulus / contact_size;
    contact.law = std::make_shared<NMM::CoulombLaw>(law);
    if (is_augmented)
      contact.penetration_tolerance = 1e-4 * approach;
    contact.reach = 0.05 * parameters.radius;
    return contact;
  }


  NMM::RigidObstacle
  make_rigid_plate(const double radius)
  {
    NMM::RigidObstacle plate;
    plate.name   = "plate";
    plate.pieces = {
      CurvePiece::segment({2. * radius, -radius}, {-2. * radius, -radius})};
    return plate;
  }


  // A quarter of the cylinder on a rigid plate.
  Model::Setup
  make_quarter_setup(const Parameters  &parameters,
                     const double       contact_size,
                     const double       half_width,
                     const std::string &law,
                     const double       approach)
  {
    const double R = parameters.radius;
    Model::Setup setup;
    setup.geometry  = make_quarter_disk();
    setup.obstacles = {make_rigid_plate(R)};
    setup.mesh =
      make_mesh_parameters(parameters, contact_size, half_width, {-R});
    setup.problem =
      make_quarter_problem(parameters, NMM::material_law(law), approach);
    return setup;
  }


  // @sect3{Small strain: Hertz}

  // The approach that belongs to a half-width is imposed in one step. The points of the contact are appended to
  // @p pressure.
  Tutorial::Row
  run_hertz(const Parameters           &parameters,
            const double                half_width,
            const double                contact_ratio,
            const Enforcement           enforcement,
            std::vector<PressurePoint> &pressure)
  {
    const Hertz  hertz = Hertz::from_half_width(parameters, half_width);
    const double size  = contact_ratio * half_width;
    Model::Setup setup = make_quarter_setup(parameters,
                                            size,
                                            1.1 * half_width,
                                            "St. Venant-Kirchhoff",
                                            hertz.approach);
    setup.is_linear    = true;
    setup.contact =
      make_contact_parameters(parameters, enforcement, size, hertz.approach);
    Model model(std::move(setup));
    model.run(1, [](double, const Model::Vector &) {});

    pressure = model.pressure_at_reference_places();
    return Tutorial::Row{{"springs", name(enforcement)},
                         {"half_width_m", half_width},
                         {"size_over_b", contact_ratio},
                         {"unknowns", model.n_unknowns},
                         {"iterations", model.n_iterations}} +
           // a quarter has half of the contact
           compare(hertz, 2. * model.forces()[0], pressure) +
           Tutorial::Row{{"cutting_s", model.cutting_time},
                         {"covers_s", model.setup_time},
                         {"total_s", model.total_time}};
  }


  void
  run_hertz_study(const Parameters &parameters)
  {
    Tutorial::Table table("Against Hertz; errors in percent"), points;
    const auto      add = [&](const double      b,
                         const Enforcement enforcement,
                         const double      ratio) {
      // the fastest of some runs: others share the caches
      std::vector<PressurePoint> pressure;
      Tutorial::Row              best;
      for (unsigned int i = 0; i < parameters.n_repetitions; ++i)
      {
        const Tutorial::Row row =
          run_hertz(parameters, b, ratio, enforcement, pressure);
        if (i == 0 || number(row, "total_s") < number(best, "total_s"))
          best = row;
      }
      table.add(best);
      const Hertz hertz = Hertz::from_half_width(parameters, b);
      for (const auto &[x, p, weight] : pressure)
        if (x < 1.3 * b)
          points.add({{"x_over_b", x / b},
                      {"p_over_p0", p / hertz.peak},
                      {"springs", name(enforcement)},
                      {"half_width_m", b},
                      {"size_over_b", ratio},
                      {"error_over_p0", (p - hertz.pressure(x)) / hertz.peak}});
    };
    for (const double half_width : parameters.half_widths)
      for (const Enforcement enforcement :
           {Enforcement::penalty, Enforcement::augmented})
        for (const double ratio : parameters.contact_ratios)
          add(half_width, enforcement, ratio);
    points.write(parameters.prefix + "pressure.csv");
  }


  // The mesh moved and turned at random: the error must not depend on luck.
  void
  run_placements(Parameters parameters)
  {
    for (const double ratio : parameters.contact_ratios)
    {
      Tutorial::Table table;
      for (const Tutorial::Placement &placement : Tutorial::random_placements(
             parameters.n_placements, parameters.seed, parameters.cell_size))
      {
        std::vector<PressurePoint> pressure;
        parameters.placement = placement;
        table.add(run_hertz(parameters,
                            parameters.half_widths[0],
                            ratio,
                            Enforcement::augmented,
                            pressure));
      }
      table.print_ranges("The mesh moved and turned at random, augmented",
                         {"size_over_b",
                          "unknowns",
                          "force_%",
                          "peak_%",
                          "width_%",
                          "L2_p_%",
                          "ripple_%",
                          "iterations"});
    }
  }


  // @sect3{Large compression}

  // Beyond small strain: the force against the approach, and what the tables have of it.
  Tutorial::Row
  compression_row(const Parameters               &parameters,
                  const Enforcement               enforcement,
                  const double                    size,
                  const Model                    &model,
                  const std::map<double, double> &forces)
  {
    return Tutorial::Row{{"springs", name(enforcement)},
                         {"contact_size_m", size},
                         {"unknowns", model.n_unknowns},
                         {"cuts", model.n_cuts},
                         {"iterations", model.n_iterations},
                         {"total_s", model.total_time}} +
           compare_forces(parameters, forces);
  }


  Tutorial::Row
  force_row(const Parameters &parameters,
            const double      approach,
            const double      force)
  {
    const double R = parameters.radius;
    return {{"approach_over_R", approach / R},
            {"F_over_ER", force / (parameters.youngs_modulus * R)}};
  }


  // The same quarter with the neo-Hookean law and any
  // deformation gradient, to an approach of 0.4 R; beside it, for the figure, Hertz.
  void
  run_compression_study(const Parameters &parameters)
  {
    Tutorial::Table table(
      "Quarter disk, neo-Hookean, rigid plate: relative "
      "errors of the force"),
      curves, hertz_curve;
    const double step = parameters.approach / parameters.n_load_steps;
    for (const Enforcement enforcement :
         {Enforcement::penalty, Enforcement::augmented})
      for (const double size : parameters.compression_sizes)
      {
        Model::Setup setup = make_quarter_setup(parameters,
                                                size,
                                                0.5 * parameters.radius,
                                                "neo-Hookean",
                                                parameters.approach);
        setup.contact =
          make_contact_parameters(parameters, enforcement, size, 10. * step);
        Model                    model(std::move(setup));
        std::map<double, double> forces;
        model.run(parameters.n_load_steps,
                  [&](const double load_factor, const Model::Vector &) {
                    forces[parameters.approach * load_factor] =
                      2. * model.forces()[0];
                  });
        table.add(
          compression_row(parameters, enforcement, size, model, forces));
        if (enforcement != Enforcement::augmented)
          continue;
        for (const auto &[approach, force] : forces)
          curves.add(force_row(parameters, approach, force));
        curves.add_break();
      }
    for (unsigned int i = 1; i <= 40; ++i)
    {
      const Hertz hertz = Hertz::from_half_width(parameters, 0.01 * i);
      if (hertz.approach <= parameters.approach)
        hertz_curve.add(force_row(parameters, hertz.approach, hertz.force));
    }
    table.write(parameters.prefix + "compression.csv");
    curves.write(parameters.prefix + "forces.csv");
    hertz_curve.write(parameters.prefix + "hertz-forces.csv");
  }


  // @sect3{The paper's press}

  // A whole cylinder, two plates a thousand times as stiff, and springs as in
  // Table 1, or multipliers. One mathematical mesh covers all three bodies: where they share a
  // triangle, each has covers of its own.
  void
  run_press(const Parameters &parameters, const Enforcement enforcement)
  {
    const double R = parameters.radius, size = parameters.press_size;
    const double step = parameters.approach / parameters.n_load_steps;
    Model::Setup setup;
    setup.geometry = make_press();
    setup.mesh     = make_mesh_parameters(parameters, size, 0.5 * R, {-R, R});
    setup.problem  = make_press_problem(parameters);
    setup.contact  = make_contact_parameters(
      parameters, enforcement, size, 10. * step, parameters.spring);
    Model model(std::move(setup));

    Tutorial::Table            pressure, hertz_pressure, curve;
    std::vector<Tutorial::Row> stages;
    std::map<double, double>   forces_of_approach;
    unsigned int               n_drawn = 0;
    model.run(parameters.n_load_steps,
              [&](const double load_factor, const Model::Vector &u) {
                const double approach = parameters.approach * load_factor;
                const auto   forces   = model.forces();
                const double force    = 0.5 * (forces[0] + forces[1]);
                const auto   points   = model.current_pressure();
                const Hertz  hertz    = Hertz::from_force(parameters, force);
                stages.push_back(stage_row(approach, forces, hertz, points));
                forces_of_approach[approach] = force;
                curve.add(force_row(parameters, approach, force));
                if (std::abs(4. * load_factor - std::round(4. * load_factor)) >
                    1e-6)
                  return;
                add_stage(points, hertz, pressure, hertz_pressure);
                const std::string prefix =
                  parameters.prefix + "stage-" + std::to_string(++n_drawn);
                if (enforcement != Enforcement::augmented)
                  return;
                model.outlines().write(prefix + "-outlines.csv");
                model.material_lines(u).write(prefix + "-lines.csv");
              });

    Tutorial::Table table("The paper's press, " + name(enforcement));
    table.add(compression_row(
      parameters, enforcement, size, model, forces_of_approach));
    Tutorial::Table stage_table("Its stages, beside Hertz at the same force");
    for (const Tutorial::Row &stage : stages)
      stage_table.add(stage);
    pressure.write(parameters.prefix + name(enforcement) + "-stages.csv");
    hertz_pressure.write(parameters.prefix + "stages-hertz.csv");
    curve.write(parameters.prefix + "press-forces.csv");
  }
} // namespace StepNMM3


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM3;
  return Tutorial::run<Parameters>(
    "step-nmm-3", argc, argv, [](const Parameters &parameters) {
      run_hertz_study(parameters);
      run_placements(parameters);
      run_compression_study(parameters);
      // figures show what the last one leaves, with multipliers
      run_press(parameters, Enforcement::penalty);
      run_press(parameters, Enforcement::augmented);
      Tutorial::draw_figures(parameters.prefix,
                             figures_gp,
                             disk_compression_csv);
    });
}
