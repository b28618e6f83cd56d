// nmm-hard-cases: the cases that cut methods are known to suffer from, as a
// table. Every number in doc/hard-cases.md comes from this program:
//   nmm-hard-cases --markdown doc/hard-cases.md --csv tests/performance/hard-cases.csv

#include <nmm/base/program.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <support/hard_cases/hard_cases.h>
#include <support/hard_cases/table.h>

using namespace NMM;
using namespace NMM::HardCases;

namespace
{
  const std::vector<Stabilization> stabilizations = {
    Stabilization::aggregation,
    Stabilization::ghost_penalty,
    Stabilization::none};

  Measure
  everything()
  {
    Measure measure;
    measure.cg_iterations = true;
    return measure;
  }


  void
  slivers(Report &report, const bool quick)
  {
    report.section("1. Slivers",
                   "The unit square on right-angled triangles of h = 1/16 that "
                   "fit it, except "
                   "that its upper side lies epsilon h above a mesh line, "
                   "epsilon = 1e-1 ... "
                   "1e-14, or rises from it by 1, 0.01 or 1e-6 degrees; that "
                   "side is free of "
                   "traction, loaded, or held. Smooth exact solution; "
                   "\"uncut\" is epsilon = "
                   "0. Each row is the worst over the sweep.");
    for (const Stabilization stabilization : stabilizations)
      for (const Side side : {Side::free, Side::loaded, Side::fixed})
      {
        const Result uncut =
          sliver(0., 0., side, stabilization, 16, 0, everything());
        Worst worst, patch;
        for (int exponent = 1; exponent <= 14; exponent += quick ? 3 : 1)
          for (const double angle : {0., 1., 0.01, 1e-6})
          {
            // an angle needs no second parameter
            if (angle != 0. && exponent > 1)
              continue;
            const double epsilon = angle == 0. ? std::pow(10., -exponent) : 0.;
            const Result result =
              sliver(epsilon, angle, side, stabilization, 16, 0, everything());
            report.csv("sliver", result);
            worst.add(result);
            for (unsigned int degree = 1; degree <= 2; ++degree)
            {
              Measure errors_only;
              errors_only.condition = false;
              patch.add(sliver(
                epsilon, angle, side, stabilization, 16, degree, errors_only));
            }
          }
        report.row(to_string(side), stabilization, uncut, worst, patch);
      }
  }


  void
  disks(Report &report, const bool quick)
  {
    const unsigned int n = quick ? 20 : 200;
    report.section(
      "2. A disk anywhere on the mesh",
      "The unit disk (true arcs), its left half held and its right "
      "half loaded, on equilateral triangles of h = 0.2 at " +
        std::to_string(n) +
        " random offsets and rotations; \"uncut\" is a hexagon of "
        "equal area that the same triangles fit.");
    const Result uncut = fitted_hexagon(0.2, everything());
    for (const Stabilization stabilization : stabilizations)
    {
      Worst worst, patch;
      for (unsigned int seed = 1; seed <= n; ++seed)
      {
        const Result result =
          moved_disk(seed, 0.2, stabilization, 0, everything());
        report.csv("disk", result);
        worst.add(result);
        Measure errors_only;
        errors_only.condition = false;
        patch.add(moved_disk(seed, 0.2, stabilization, 2, errors_only));
      }
      report.row("disk", stabilization, uncut, worst, patch);
    }
  }


  const std::vector<Stabilization> with_stabilization =
    {Stabilization::aggregation, Stabilization::ghost_penalty};


  const std::vector<std::string> header_of_pairs = {
    "case",
    "condition",
    "L2 u",
    "energy norm",
    "condition, ghost penalty",
    "L2 u, ghost penalty",
    "energy norm, ghost penalty"};


  std::vector<std::string>
  cells_of(const Result &result)
  {
    if (!result.failure.empty())
      return {"refused", "-", "-"};
    return {Report::number(result.stiffness_condition),
            Report::number(result.displacement_error),
            Report::number(result.energy_error)};
  }


  /// Lines of a result each of @p results, and of the one at the same place among @p others.
  void
  add_pairs(Report                    &report,
            const std::vector<Result> &results,
            const std::vector<Result> &others)
  {
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      std::vector<std::string> line   = {results[i].variant};
      const auto               first  = cells_of(results[i]);
      const auto               second = i < others.size()
                                          ? cells_of(others[i])
                                          : std::vector<std::string>(first.size(), "-");
      line.insert(line.end(), first.begin(), first.end());
      line.insert(line.end(), second.begin(), second.end());
      report.line(line);
    }
  }


  void
  layers(Report &report)
  {
    report.section(
      "3. Thin layers and sharp wedges",
      "A column between smooth walls with a layer of its own stiffness between "
      "two closed joints, and two closed joints that cross at 1 degree; "
      "quadratic exact solutions. A layer thinner than a cell gets a "
      "mathematical mesh of its own, one stretched row of triangles. Errors "
      "are rounding times the condition number, which grows with contrast h / "
      "thickness. From 1e14 on the program refuses.");
    report.header(header_of_pairs);
    std::map<Stabilization, std::vector<Result>> results;
    for (const Stabilization stabilization : with_stabilization)
    {
      const auto add = [&](const std::string &name, const Result &result) {
        report.csv(name, result);
        results[stabilization].push_back(result);
      };
      for (const double thickness : {1e-3, 1e-6, 1e-9})
        for (const double contrast : {1e-6, 1e-3, 1., 1e6})
          add("layer",
              thin_layer(thickness, contrast, stabilization, Measure()));
      for (const double h : {0.2, 0.1})
        add("wedge", sharp_wedges(h, stabilization, Measure()));
    }
    add_pairs(report,
              results[Stabilization::aggregation],
              results[Stabilization::ghost_penalty]);
  }


  void
  small_blocks(Report &report)
  {
    report.section(
      "5. Blocks smaller than a cell",
      "A block of 1e-1 ... 1e-6 of a cell, alone (one side held, the others "
      "loaded) or tied into a frame; constant stress, and a rigid rotation, "
      "for which the energy norm is absolute (that of a strain of 1 would be "
      "about the block's size). Each row is the worst over the sizes and over "
      "a square, a triangle and a disk.");
    report.header({"case",
                   "stabilization",
                   "condition",
                   "mass matrix",
                   "L2 u",
                   "energy norm",
                   "failures"});
    for (const Stabilization stabilization : with_stabilization)
    {
      std::map<std::pair<bool, bool>, Worst> worst;
      for (const Shape shape : {Shape::square, Shape::triangle, Shape::disk})
        for (const bool in_frame : {false, true})
          for (const bool rigid : {false, true})
            for (int exponent = 1; exponent <= 6; ++exponent)
            {
              const Result result = small_block(shape,
                                                std::pow(10., -exponent),
                                                in_frame,
                                                rigid,
                                                stabilization,
                                                Measure());
              report.csv("small block", result);
              worst[{in_frame, rigid}].add(result);
            }
      for (const auto &[key, one] : worst)
        report.line(
          {std::string(key.first ? "in a frame" : "alone") +
             (key.second ? ", rotation" : ", constant stress"),
           to_string(stabilization),
           Report::number(one.condition),
           Report::number(one.mass_condition),
           Report::number(one.displacement_error),
           Report::number(one.energy_error),
           std::to_string(one.n_failures) + " of " + std::to_string(one.n)});
    }
  }


  void
  coincidences(Report &report)
  {
    report.section(
      "4. Joints on mesh lines and through nodes",
      "The unit square with a joint exactly along mesh lines, along the "
      "triangles' hypotenuses, or through nodes at a slope, and the same joint "
      "1, 10 and 1000 floating point numbers higher. Largest change of "
      "displacement or stress over their largest value, at 81 points. With "
      "aggregation it is rounding; the ghost penalty adds energy where slivers "
      "appear, so its result jumps by a part of the discretization error.");
    report.header({"joint",
                   "state",
                   "1",
                   "10",
                   "1000",
                   "1, ghost penalty",
                   "10, ghost penalty",
                   "1000, ghost penalty"});
    for (const Track track : {Track::along_mesh_lines,
                              Track::along_diagonals,
                              Track::through_nodes})
      for (const JointState state : {JointState::closed, JointState::open})
      {
        std::vector<std::string> cells = {to_string(track),
                                          state == JointState::closed ? "closed"
                                                                      : "open"};
        for (const Stabilization stabilization : with_stabilization)
        {
          const Coincidence exact =
            joint_on_mesh(track, state, 0, stabilization);
          for (const unsigned int n_ulp : {1u, 10u, 1000u})
            cells.push_back(Report::number(difference(
              exact, joint_on_mesh(track, state, n_ulp, stabilization))));
        }
        report.line(cells);
      }
  }


  void
  interfaces(Report &report)
  {
    report.section(
      "Bonded interfaces",
      "A disk with a bonded round inclusion of another stiffness; the "
      "interface runs through the cells. Full order, 3 in L2 and 2 in the "
      "energy norm, whatever the contrast.");
    report.header(header_of_pairs);
    std::map<Stabilization, std::vector<Result>> results;
    for (const Stabilization stabilization : with_stabilization)
      for (const double contrast : {1e-6, 1e-3, 1e3, 1e6})
        for (const double h : {0.2, 0.1, 0.05})
        {
          results[stabilization].push_back(
            bonded_inclusion(contrast, h, stabilization, Measure()));
          report.csv("inclusion", results[stabilization].back());
        }
    add_pairs(report,
              results[Stabilization::aggregation],
              results[Stabilization::ghost_penalty]);
  }


  void
  limits(Report &report, const bool quick)
  {
    report.section(
      "6. Nearly incompressible, slender",
      "The disk in plane strain with a divergence-free displacement, beside "
      "the hexagon that the triangles fit, and cantilevers of depth 1 under an "
      "end load (exact cubic displacement). Towards nu = 0.5 errors grow, cut "
      "or fitted alike, and the condition number grows like 1 / (1 - 2 nu); "
      "that of a slender body grows like (length/depth)^4.");
    report.header({"case",
                   "condition",
                   "L2 u",
                   "energy norm",
                   "condition, fitted hexagon",
                   "L2 u, fitted hexagon",
                   "energy norm, fitted hexagon"});
    std::vector<Result> results, fitted;
    const auto add = [&](const Result &result, std::vector<Result> &all) {
      report.csv("limits", result);
      all.push_back(result);
    };
    for (const double nu : {0.3, 0.49, 0.499, 0.49999})
      for (const double h : {0.2, 0.1, 0.05, 0.025})
        if (!quick || h > 0.06)
        {
          add(
            nearly_incompressible(nu, h, Stabilization::aggregation, Measure()),
            results);
          add(fitted_hexagon(h, Measure(), nu, true), fitted);
        }
    for (const double length : {10., 100.})
      for (const double h : {1., 0.5, 0.25})
        if (!quick || h > 0.3)
          add(slender_beam(length, h, Stabilization::aggregation, Measure()),
              results);
    add_pairs(report, results, fitted);
  }


  void
  networks(Report &report, const bool quick)
  {
    const unsigned int n          = quick ? 100 : 2000;
    unsigned int       n_failures = 0, n_regions = 0;
    double             area = 0., patch = 0.;
    for (unsigned int seed = 1; seed <= n; ++seed)
    {
      const Network network =
        random_network(seed, 60, Stabilization::aggregation);
      if (!network.solved.failure.empty())
        report.csv("network", network.solved);
      n_failures += !network.solved.failure.empty();
      n_regions += network.n_regions;
      area  = std::max(area, network.area_error);
      patch = std::max(patch, network.solved.displacement_error);
    }
    report.section(
      "7. Random networks",
      "The unit square with up to 60 closed joints and interfaces whose ends "
      "lie on a grid of 33 x 33 points on which the nodes of the mesh lie as "
      "well; aggregation, quadratic exact solution. " +
        std::to_string(n) + " networks (seeds 1, 2, ...) with " +
        std::to_string(n_regions) + " regions: " + std::to_string(n_failures) +
        " failures, largest error of the area " + Report::number(area) +
        ", of u in the patch test " + Report::number(patch) + ".");
  }


  void
  cost(Report &report, const bool quick)
  {
    report.section(
      "Cost",
      "The quarter ring of step-nmm-1. Aggregation: finding roots and making "
      "constraints, over sparsity pattern and assembly, shortest of five runs "
      "each. Iterations of conjugate gradients with ML to a relative residual "
      "of 1e-11; \"fitted\" is a polar mesh.");
    report.header({"unknowns",
                   "aggregation / assembly",
                   "iterations, aggregation",
                   "iterations, ghost penalty",
                   "iterations, fitted (unknowns)"});
    for (const double h : {0.06, 0.0152})
    {
      if (quick && h < 0.03)
        continue;
      const Cost result = cost_on_ring(h);
      report.line({std::to_string(result.n_unknowns),
                   Report::number(100. * result.aggregation_seconds /
                                  result.assembly_seconds) +
                     " %",
                   std::to_string(result.cg_iterations),
                   std::to_string(result.ghost_cg_iterations),
                   std::to_string(result.fitted_cg_iterations) + " (" +
                     std::to_string(result.n_fitted_unknowns) + ")"});
    }
  }


  void
  run(int argc, char **argv)
  {
    bool        quick = false;
    std::string markdown_file, csv_file;
    for (int i = 1; i < argc; ++i)
    {
      const std::string argument = argv[i];
      if (argument == "--quick")
        quick = true;
      else if (argument == "--markdown" && i + 1 < argc)
        markdown_file = argv[++i];
      else if (argument == "--csv" && i + 1 < argc)
        csv_file = argv[++i];
      else
        AssertThrow(false,
                    InputError("unknown argument '" + argument + "'",
                               "command line",
                               "nmm-hard-cases [--quick] [--markdown FILE] "
                               "[--csv FILE]"));
    }
    Report report;
    slivers(report, quick);
    disks(report, quick);
    layers(report);
    interfaces(report);
    coincidences(report);
    small_blocks(report);
    limits(report, quick);
    networks(report, quick);
    cost(report, quick);
    report.write(markdown_file, csv_file);
  }
} // namespace


int
main(int argc, char **argv)
{
  const NMM::MPISession mpi(argv[0]);
  try
  {
    run(argc, argv);
  }
  catch (const InputError &error)
  {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  catch (const NumericalFailure &failure)
  {
    std::cerr << failure.what() << std::endl;
    return 3;
  }
  return 0;
}
