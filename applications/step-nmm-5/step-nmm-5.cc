// step-nmm-5: crack tips, intensity factors, and cracks that grow.
//
// A crack is an open joint that ends inside a block. The mesh does not follow its faces, and becomes
// fine towards its tip by itself. So a crack that grows is a longer joint, and the loop that lets it
// grow is a few lines, on this page.

// @sect3{Include files}

#include <nmm/covers/aggregation.h>
#include <nmm/fracture/fracture.h>
#include <nmm/geometry/crack_extension.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/stress_recovery.h>
#include <nmm/output/output.h>
#include <nmm/scene/run_scene.h>

#include <deal.II/base/function.h>
#include <deal.II/base/timer.h>

// `westergaard.cc` has an exact solution, `figures.gp` the figures. They are apart from
// this page since nothing of the method is in them.
#include "figures_gp.h"
#include "tutorial/table.h"
#include "tutorial/tutorial.h"
#include "westergaard.h"
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>

namespace StepNMM5
{
  using namespace dealii;

  // @sect3{Parameters}

  struct Parameters : Tutorial::ParameterFile
  {
    using ParameterFile::ParameterFile;

    // Sizes of cells at the free radius of the tip over that radius [-].
    std::vector<double> gradings =
      get<std::vector<double>>("Gradings",
                               {0.5, 0.35, 0.25, 0.175, 0.125},
                               positive_list);
    // Sizes of cells of uniform meshes [m].
    std::vector<double> cell_sizes =
      get<std::vector<double>>("Cell sizes",
                               {0.2, 0.1, 0.05, 0.025},
                               positive_list);
    // Lengths of the increments in the beam [in].
    std::vector<double> increments =
      get<std::vector<double>>("Increments", {0.4, 0.2, 0.1}, positive_list);
    // Size of its cells [in], and like gradings [-].
    double beam_cell_size = get("Beam cell size", 0.5, positive);
    double beam_grading   = get("Beam grading", 0.25, positive);
    // Number of the wings' increments, 0 to leave that part out, and their length [m].
    unsigned int n_wing_increments =
      get("Wing increments", 6u, Patterns::Integer(0));
    double wing_increment = get("Wing increment", 0.05, positive);
    // Until when the slope is followed [s]; 0 to leave that part out.
    double slope_end_time = get("Slope end time", 2.5, not_negative);
  };


  // @sect3{A solid with cracks}

  // The stress is infinite at a tip, like $r^{-1/2}$, and cells of one size would give back little for
  // their number. There are two remedies. Cells may become small towards the tip, so that
  // each has the same share in the error. Or a disk around the tip becomes a cover of its own, with the
  // functions that are singular there: then cells need not be small, but the crack must be straight in
  // the disk.
  enum class Tips
  {
    as_meshed,
    graded,
    covered
  };


  // From curves to the displacement, as in step-nmm-1. What is new are covers of tips. Their circles are
  // interfaces, so that they become a part of the geometry before anything is cut.
  class CrackedSolid
  {
  public:
    CrackedSolid(const NMM::Geometry          &geometry,
                 const NMM::ElasticityProblem &problem,
                 const double                  cell_size,
                 const Tips                    tips,
                 const double                  grading,
                 const unsigned int            degree = 2)
      : problem(problem)
      , solid(make_solid(geometry, problem, tips, tip_covers))
      , triangles(make_mesh(solid, cell_size, tips, grading, degree))
      , elements(triangles, solid)
      , covers(elements, MPI_COMM_SELF)
      , aggregation(NMM::aggregate(covers))
      , constraints(NMM::make_constraints(covers, aggregation, 2))
      , quadrature(elements,
                   std::max(1u, 2 * (degree - 1)),
                   2 * degree,
                   covers.locally_owned_elements())
      , elasticity(covers,
                   quadrature,
                   constraints,
                   this->problem,
                   /* ghost_penalty = */ nullptr,
                   pointers_to(tip_covers))
    {
      elasticity.assemble();
      elasticity.solve({});
    }

    std::vector<NMM::CrackTip>
    tips() const
    {
      return NMM::find_crack_tips(solid);
    }

    // The field adds the functions of tip covers, so that everything that reads it has them.
    NMM::DisplacementField
    field() const
    {
      NMM::DisplacementField result(covers, problem, elasticity.solution());
      for (unsigned int i = 0; i < tip_covers.size(); ++i)
        result.add_disk(*tip_covers[i], elasticity.disk_coefficients()[i]);
      return result;
    }

    // Interaction integrals over disks about the tip.
    NMM::IntensityFactors
    factors(const NMM::CrackTip &tip) const
    {
      return NMM::compute_intensity_factors(field(), problem, tip);
    }

    unsigned int
    n_unknowns() const
    {
      unsigned int n =
        2 * (covers.n_covers() - aggregation.cover_to_root.size());
      for (const auto &cover : tip_covers)
        n += cover->n_functions();
      return n;
    }

    void
    draw(const std::string &title,
         const double       range,
         const std::string &file_name) const;

  private:
    using TipCovers = std::vector<std::unique_ptr<NMM::TipCover>>;

    static NMM::PhysicalMesh
    make_solid(NMM::Geometry                 geometry,
               const NMM::ElasticityProblem &problem,
               const Tips                    tips,
               TipCovers                    &tip_covers)
    {
      NMM::PhysicalMesh solid{NMM::Geometry(geometry)};
      if (tips != Tips::covered)
        return solid;
      tip_covers = NMM::make_tip_covers(solid, problem);
      NMM::add_circles(tip_covers, solid, geometry);
      return NMM::PhysicalMesh(std::move(geometry));
    }

    static NMM::MathematicalMesh
    make_mesh(const NMM::PhysicalMesh &solid,
              const double             cell_size,
              const Tips               tips,
              const double             grading,
              const unsigned int       degree)
    {
      NMM::GradedMeshParameters mesh;
      mesh.cell_size = cell_size;
      if (tips != Tips::as_meshed)
        mesh.local_sizes = NMM::sizes_at_tips(solid, grading);
      return NMM::make_graded_mesh(solid, mesh, degree);
    }

    static std::vector<const NMM::DiskCover *>
    pointers_to(const TipCovers &tip_covers)
    {
      std::vector<const NMM::DiskCover *> pointers;
      for (const auto &cover : tip_covers)
        pointers.push_back(cover.get());
      return pointers;
    }

    const NMM::ElasticityProblem    problem;
    TipCovers                       tip_covers;
    const NMM::PhysicalMesh         solid;
    const NMM::MathematicalMesh     triangles;
    const NMM::ManifoldMesh         elements;
    NMM::CoverSystem                covers;
    const NMM::Aggregation          aggregation;
    const AffineConstraints<double> constraints;
    const NMM::QuadratureCollection quadrature;
    NMM::StaticElasticity           elasticity;
  };


  void
  CrackedSolid::draw(const std::string &title,
                     const double       range,
                     const std::string &file_name) const
  {
    const NMM::DisplacementField displacement = field();
    const NMM::StressRecovery    recovery(displacement, aggregation);
    const NMM::FieldEvaluator    evaluator(displacement, recovery, problem);
    const NMM::FieldTriangles    samples(covers, &evaluator);
    NMM::PictureParameters       parameters;
    parameters.range_max   = range;
    parameters.length_unit = "in";
    parameters.stress_unit = "psi";
    NMM::draw_picture(
      NMM::make_picture_data(covers, samples, &evaluator, parameters),
      parameters,
      title,
      file_name);
  }


  // @sect3{Against the exact solution}

  // A square of 2 m around one tip of a crack in an infinite plane. The crack runs obliquely
  // through the triangles. On the outline the exact displacement is prescribed, and the faces of the
  // crack are free, as they are in the exact solution.
  Tutorial::Row
  solve_westergaard(const double       cell_size,
                    const Tips         tips,
                    const double       grading,
                    const unsigned int degree)
  {
    Timer timer;

    const NMM::Geometry    geometry = NMM::parse_geometry(R"(
      boundary name=outline material=rock POLYGON ((-1 -1, 1 -1, 1 1, -1 1))
      joint    name=crack   LINESTRING (-2 -0.3, 0.1 0.05))",
                                                       "the square");
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_strain;
    problem.materials   = {{"rock", 1000., 0.3}};
    const NMM::PlaneElasticity elasticity =
      problem.materials[0].plane_elasticity(problem.plane_state);
    const Westergaard exact(
      NMM::find_crack_tips(NMM::PhysicalMesh(NMM::Geometry(geometry))).front(),
      elasticity);
    problem.boundary_conditions = {
      {"as in the plane",
       "outline",
       NMM::BoundaryCondition::Type::displacement,
       std::make_shared<FunctionFromFunctionObjects<2>>(
         std::vector<std::function<double(const Point<2> &)>>{
           [exact](const Point<2> &x) { return exact.displacement(x)[0]; },
           [exact](const Point<2> &x) { return exact.displacement(x)[1]; }})}};

    const CrackedSolid solid(
      geometry, problem, cell_size, tips, grading, degree);
    const NMM::IntensityFactors k       = solid.factors(solid.tips().front());
    const double                seconds = timer.wall_time();
    const NMM::ErrorNorms       errors  = NMM::compute_errors(
      solid.field(),
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) { return exact.stress(x); });
    return {{"mesh",
             tips == Tips::covered  ? "covered"
             : tips == Tips::graded ? "graded"
                                    : "uniform"},
            {"order", degree},
            {"unknowns", solid.n_unknowns()},
            {"error_K",
             std::max(std::abs(k.K_I - Westergaard::K_I()), std::abs(k.K_II)) /
               Westergaard::K_I()},
            {"error_u", errors.displacement},
            {"error_stress", errors.stress},
            {"seconds", seconds}};
  }


  // Second order with a cover of the tip, on graded meshes, and on meshes that know nothing of
  // the tip; first order on graded ones.
  void
  run_study(const Parameters &parameters)
  {
    Tutorial::Table table(
      "A crack in an infinite plane (Westergaard); relative errors");
    const auto add = [&](const double       cell_size,
                         const Tips         tips,
                         const double       grading,
                         const unsigned int degree) {
      table.add(solve_westergaard(cell_size, tips, grading, degree));
    };
    // the first solution loads libraries, which is not to be measured
    solve_westergaard(0.4, Tips::covered, 0.5, 2);
    for (const double grading : parameters.gradings)
      add(0.8 * grading, Tips::covered, grading, 2);
    for (const double grading : parameters.gradings)
      add(0.8 * grading, Tips::graded, grading, 2);
    for (const double cell_size : parameters.cell_sizes)
      add(cell_size, Tips::as_meshed, 0., 2);
    for (const double grading : parameters.gradings)
      add(0.4 * grading, Tips::graded, 0.5 * grading, 1);
    table.write(parameters.prefix + "study.csv");
  }


  // @sect3{A crack that grows}

  // Bittencourt, Wawrzynek, Ingraffea and Sousa (1996) bent beams with three holes and a notch
  // in three points. Lengths are inches, stresses psi; the load is 1 lb per inch of thickness.
  NMM::Geometry
  make_beam()
  {
    return NMM::parse_geometry(R"(
      boundary name=outline material=PMMA POLYGON ((-10 0, 10 0, 10 8, -10 8))
      hole  name=lower  CIRCLE (-4 2.75, 0.25)
      hole  name=middle CIRCLE (-4 4.75, 0.25)
      hole  name=upper  CIRCLE (-4 6.75, 0.25)
      joint name=notch  LINESTRING (-6 -1, -6 1))",
                               "the beam");
  }


  NMM::ElasticityProblem
  make_bending()
  {
    NMM::ElasticityProblem problem;
    problem.plane_state = NMM::PlaneState::plane_strain;
    problem.materials   = {{"PMMA", 4.75e5, 0.35}};
    problem.point_forces.resize(1);
    problem.point_forces[0].point = Point<2>(0., 8.);
    problem.point_forces[0].force = Tensor<1, 2>({0., -1.});
    problem.fixed_points.resize(2);
    problem.fixed_points[0].point         = Point<2>(-9., 0.);
    problem.fixed_points[1].point         = Point<2>(9., 0.);
    problem.fixed_points[1].components[0] = false;
    return problem;
  }


  Tensor<1, 2>
  turned(const Tensor<1, 2> &direction, const double angle)
  {
    return Tensor<1, 2>(
      {std::cos(angle) * direction[0] - std::sin(angle) * direction[1],
       std::sin(angle) * direction[0] + std::cos(angle) * direction[1]});
  }


  // The way of the crack through the beam.
  struct CrackPath
  {
    std::string criterion;
    // Length of an increment [in].
    double                increment = 0.;
    std::vector<Point<2>> points;
    // At which each increment grows, over that of the first one [-].
    std::vector<double> loads;
    // Curve at which it ends; empty: it did not arrive anywhere.
    std::string end;

    // Where it passes the height @p y [in]; not a number if it does not.
    double
    x_at(const double y) const
    {
      for (unsigned int i = 1; i < points.size(); ++i)
        if (points[i - 1][1] <= y && y <= points[i][1])
          return points[i - 1][0] + (y - points[i - 1][1]) /
                                      (points[i][1] - points[i - 1][1]) *
                                      (points[i][0] - points[i - 1][0]);
      return std::numeric_limits<double>::quiet_NaN();
    }
  };


  // The loop. Everything is proportional to the load, so the load at which the crack of this
  // length grows is the toughness over the equivalent intensity factor under a load of 1; only its
  // ratio to the first one is written (`paths.csv`), for which the toughness does not matter. A criterion
  // gives the direction.
  //
  // Along a path of local symmetry $K_{II}$ vanishes. An increment is straight, so its direction should
  // be the mean of those that the path has at its two ends; the second one is known only when the
  // increment has been made. It is made, looked at, and turned: a turn of the increment by a small angle turns what the crack
  // wants to do at its end back by about the same angle, so the residual falls by twice the turn.
  CrackPath
  grow_crack(const Parameters           &parameters,
             const std::string          &name,
             const NMM::GrowthCriterion &criterion,
             const double                increment)
  {
    const NMM::ElasticityProblem problem  = make_bending();
    NMM::Geometry                geometry = make_beam();
    CrackPath                    path;
    path.criterion = name;
    path.increment = increment;

    // A cover would be as small as the last increment, over which alone the crack is straight.
    const auto solve = [&](const NMM::Geometry &with_crack) {
      return std::make_unique<CrackedSolid>(with_crack,
                                            problem,
                                            parameters.beam_cell_size,
                                            Tips::graded,
                                            parameters.beam_grading);
    };
    std::unique_ptr<CrackedSolid> beam = solve(geometry);
    path.points.push_back(beam->tips().front().point);
    double                 first_intensity = 0.;
    constexpr unsigned int most_increments = 1000, most_turns = 8;
    for (unsigned int i = 0; i < most_increments && path.end.empty(); ++i)
    {
      const NMM::CrackTip                 tip = beam->tips().front();
      const NMM::IntensityFactors         k   = beam->factors(tip);
      const NMM::GrowthCriterion::Verdict verdict =
        criterion.judge(k.K_I, k.K_II);
      double angle = verdict.angle;
      if (i == 0)
        first_intensity = verdict.equivalent_intensity;
      path.loads.push_back(first_intensity / verdict.equivalent_intensity);

      const NMM::Geometry before = geometry;
      for (unsigned int turn = 0; turn < most_turns; ++turn)
      {
        geometry = before;
        const NMM::CrackExtension extension =
          NMM::extend_crack(geometry,
                            tip.point,
                            turned(tip.direction, angle),
                            increment,
                            "crack");
        path.end = extension.met;
        path.points.resize(i + 1);
        path.points.push_back(extension.end);
        // what is drawn in the end has a tip
        if (!path.end.empty())
          break;
        beam = solve(geometry);
        if (!criterion.is_implicit())
          break;
        const NMM::IntensityFactors at_end =
          beam->factors(beam->tips().front());
        const double turn_at_end =
          criterion.judge(at_end.K_I, at_end.K_II).angle;
        const double residual = turn_at_end - (angle - verdict.angle);
        if (std::abs(residual) < 1e-4)
          break;
        angle += 0.5 * residual;
      }
    }
    beam->draw("A crack by " + name + ", increments of " +
                 std::to_string(increment).substr(0, 4) + " in",
               1.5,
               parameters.prefix + "beam.png");
    return path;
  }


  // A table of the points of a path, and the same as a block for gnuplot: two empty lines apart from the next, and with a
  // title.
  void
  write_path(const CrackPath &path,
             Tutorial::Table &table,
             std::ostream    &curves)
  {
    curves << '"' << path.criterion << ", " << path.increment << " in\"\n";
    for (unsigned int i = 0; i < path.points.size(); ++i)
    {
      const Point<2> &x    = path.points[i];
      Tutorial::Value load = "";
      if (i < path.loads.size())
        load = path.loads[i];
      table.add({{"criterion", path.criterion},
                 {"increment_in", path.increment},
                 {"step", i},
                 {"x_in", x[0]},
                 {"y_in", x[1]},
                 {"load", load}});
      curves << x[0] << ' ' << x[1] << '\n';
    }
    curves << "\n\n";
  }


  void
  run_beam(const Parameters &parameters)
  {
    Tutorial::Table table("The beam: paths of the crack [in]"), points;
    std::ofstream   curves(parameters.prefix + "paths.txt");
    curves << std::setprecision(9);
    const auto add = [&](const std::string          &name,
                         const NMM::GrowthCriterion &criterion) {
      for (const double increment : parameters.increments)
      {
        const CrackPath path =
          grow_crack(parameters, name, criterion, increment);
        table.add({{"criterion", name},
                   {"increment", increment},
                   {"increments", path.points.size() - 1},
                   {"x at y = 3", path.x_at(3.)},
                   {"ends at", path.end.empty() ? "nothing" : path.end},
                   {"end x", path.points.back()[0]},
                   {"end y", path.points.back()[1]}});
        write_path(path, points, curves);
      }
    };
    add("hoop stress", NMM::HoopStressCriterion());
    add("local symmetry", NMM::LocalSymmetryCriterion());
    points.write(parameters.prefix + "paths.csv");
  }


  // @sect3{Wings of a closed flaw}

  // Under compression the faces of a crack touch and slide with friction. Contact is the matter of
  // step-nmm-3, and growth with contact needs a search for the load of each length. The library does
  // both for scenes, so this part reads one, sets the increments, and runs it: what the
  // program `nmm` does with `flaw.prm`.
  void
  run(const std::string              &scene_file,
      const std::vector<std::string> &replacements,
      const std::string              &output_directory)
  {
    const NMM::Scene     scene(scene_file, replacements);
    NMM::SceneRunOptions options;
    options.output = output_directory;
    NMM::Progress progress(std::cout,
                           /* is_terminal = */ false,
                           MPI_COMM_WORLD);
    bool          has_output = false;
    NMM::run_scene(scene, options, progress, MPI_COMM_WORLD, has_output);
  }


  void
  run_flaw(const Parameters &parameters)
  {
    run(STEP_NMM_5_FLAW,
        {"Fracture/Increments=" + std::to_string(parameters.n_wing_increments),
         "Fracture/Increment=" + std::to_string(parameters.wing_increment)},
        parameters.prefix + "flaw");
  }


  // @sect3{Rock bridges of a slope}

  // Here cracks grow in motion. Where the equivalent intensity factor of a tip reaches the toughness at the end of a time
  // step, the crack becomes longer by an increment and the solid is cut again. The state is carried over, so that
  // displacements and velocities are the same functions as before, and so are places of sticking and slipping. The
  // forces between the new faces fade while the crack runs along them. A mass that has lost its last bridge
  // is a block like any other from then on: it slides, lands and comes to rest. `slope.prm` has the scene.
  void
  run_slope(const Parameters &parameters)
  {
    const std::string folder = parameters.prefix + "slope";
    run(STEP_NMM_5_SLOPE,
        {"Time/End time=" + std::to_string(parameters.slope_end_time)},
        folder);

    const auto rows_of = [&](const std::string &name) {
      std::ifstream file(folder + "/" + name + ".csv");
      return Tutorial::read_csv(file);
    };
    const auto cells = [](const Tutorial::Record         &record,
                          const std::vector<std::string> &columns) {
      Tutorial::Row row;
      for (const std::string &column : columns)
        row.emplace_back(column, std::stod(record.at(column)));
      return row;
    };
    Tutorial::Table growth("The slope: cracks that grow");
    for (const Tutorial::Record &record : rows_of("growth"))
      growth.add(cells(record, {"time", "x", "y", "end_x", "end_y"}) +
                 Tutorial::Row{{"met", record.at("met")}});

    // a row each quarter of a second
    const auto states = rows_of("history"), probes = rows_of("probes-history");
    Tutorial::Table motion("The slope: energies [J/m], way of the mass [m]");
    double          next = 0.;
    for (unsigned int i = 0; i < states.size() && i < probes.size(); ++i)
      if (std::stod(states[i].at("time")) >= next - 1e-9 ||
          i + 1 == states.size())
      {
        next += 0.25;
        const double way = std::hypot(std::stod(probes[i].at("mass_x")),
                                      std::stod(probes[i].at("mass_y")));
        motion.add(
          cells(states[i],
                {"time", "kinetic", "dissipated", "fracture", "balance"}) +
          Tutorial::Row{{"way", way}});
      }
  }
} // namespace StepNMM5


// @sect3{The main function}

int
main(int argc, char **argv)
{
  using namespace StepNMM5;
  return Tutorial::run<Parameters>(
    "step-nmm-5", argc, argv, [](const Parameters &parameters) {
      Tutorial::check_that_there_is_one_rank("step-nmm-5");
      run_study(parameters);
      run_beam(parameters);
      Tutorial::draw_figures(parameters.prefix, figures_gp);
      if (parameters.n_wing_increments > 0)
        run_flaw(parameters);
      if (parameters.slope_end_time > 0.)
        run_slope(parameters);
    });
}
