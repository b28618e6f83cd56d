// Excavation in stages: blocks are removed from a stressed solid, and the tractions on the walls that
// this leaves are released in shares.

#include <nmm/base/exceptions.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr double inner = 1., outer = 3., pressure = 2., modulus_of_rock = 1e4,
                   ratio_of_rock = 0.25;


  /// A disk whose rim is held, under an initial pressure in its plane. A tied joint divides it into a
  /// core, which can be removed, and a ring.
  struct StressedDisk
  {
    explicit StressedDisk(const Kinematics   kinematics = Kinematics::small,
                          const unsigned int n_cores    = 1)
      : model(geometry(n_cores), mesh_parameters(0.25, {}, 11.), 2)
    {
      model.problem.plane_state = PlaneState::plane_strain;
      model.problem.materials   = {
          material("rock", modulus_of_rock, ratio_of_rock)};
      for (unsigned int c = 0; c < 2; ++c)
        model.problem.materials[0].initial_stress[c][c] = -pressure;
      model.problem.boundary_conditions = {
        condition(BoundaryCondition::Type::displacement, "rim")};
      elasticity = std::make_unique<FiniteElasticity>(model.covers,
                                                      *model.quadrature,
                                                      model.constraints,
                                                      model.problem,
                                                      /* may_float = */ true);
      solid      = make_solid_at_rest(*elasticity, kinematics);
      statics    = std::make_unique<NonlinearStatics>(*solid);
      core = model.manifold_mesh.block(model.manifold_mesh.find_element({}));
    }

    /// With a second, square core beside the first one if @p n_cores is 2.
    static Geometry
    geometry(const unsigned int n_cores)
    {
      Geometry result;
      result.add_circle({0., 0.}, outer, "rim", CurveRole::boundary);
      const double s = std::sqrt(0.5) * inner;
      Curve        wall;
      wall.name   = "wall";
      wall.role   = CurveRole::joint;
      wall.state  = JointState::closed;
      wall.pieces = {CurvePiece::arc({inner, 0.}, {s, s}, {0., inner}),
                     CurvePiece::arc({0., inner}, {-s, s}, {-inner, 0.}),
                     CurvePiece::arc({-inner, 0.}, {-s, -s}, {0., -inner}),
                     CurvePiece::arc({0., -inner}, {s, -s}, {inner, 0.})};
      result.add(wall);
      if (n_cores > 1)
      {
        Curve second;
        second.name   = "second wall";
        second.role   = CurveRole::joint;
        second.state  = JointState::closed;
        second.pieces = {CurvePiece::segment({1.5, -0.25}, {2., -0.25}),
                         CurvePiece::segment({2., -0.25}, {2., 0.25}),
                         CurvePiece::segment({2., 0.25}, {1.5, 0.25}),
                         CurvePiece::segment({1.5, 0.25}, {1.5, -0.25})};
        result.add(second);
      }
      return result;
    }

    unsigned int
    other_core() const
    {
      return model.manifold_mesh.block(
        model.manifold_mesh.find_element({1.75, 0.}));
    }

    /// Go on to a load factor in one step.
    void
    go_to(const double load_factor)
    {
      LoadSteps steps;
      steps.load_factors = {load_factor};
      statics->run(steps);
    }

    void
    stage(const StageChange &change, const double end)
    {
      statics->begin_stage(change, end);
      go_to(end);
    }

    /// Inward displacement of the wall at an angle [rad]; the largest one of all ranks.
    double
    closure(const double angle) const
    {
      const DisplacementField field(model.covers,
                                    model.problem,
                                    statics->solution());
      const Point<2>          n(std::cos(angle), std::sin(angle));
      const Point<2>          x = (1. + 1e-9) * inner * n;
      const auto [element, xi]  = model.locate(x);
      const auto [first, last]  = model.covers.locally_owned_elements();
      const double u            = element >= first && element < last
                                    ? -field.displacement(element, xi) * n
                                    : -1e300;
      return dealii::Utilities::MPI::max(u, model.covers.communicator());
    }

    Model                             model;
    std::unique_ptr<FiniteElasticity> elasticity;
    std::unique_ptr<SolidTerm>        solid;
    std::unique_ptr<NonlinearStatics> statics;
    unsigned int                      core = 0;
  };


  /// Lame's solution u = A r + B / r with u = 0 at the rim and the change p of the radial stress at the
  /// wall: p = 2 (lambda + mu) A - 2 mu B / a^2, and B = -A b^2.
  double
  exact_closure()
  {
    const PlaneElasticity e = material("", modulus_of_rock, ratio_of_rock)
                                .plane_elasticity(PlaneState::plane_strain);
    const double ratio = outer * outer / (inner * inner);
    const double A = pressure / (2. * (e.lambda + e.mu) + 2. * e.mu * ratio);
    return -A * inner * (1. - ratio);
  }


  // Nothing moves before the core is removed, and then the wall closes by Lame's solution.
  TEST(Stages, ARemovedCoreReleasesTheWallMPI)
  {
    StressedDisk disk;
    disk.go_to(1.);
    // rounding of pressures over the modulus
    EXPECT_LT(disk.statics->solution().linfty_norm(),
              1e-13 * pressure / modulus_of_rock * outer);
    disk.stage({{disk.core}, 1.}, 2.);
    for (const double angle : {0.1, 1., 2.5, 4.})
      // error of cells of a quarter of a radius at this wall
      EXPECT_NEAR(disk.closure(angle), exact_closure(), 2e-3 * exact_closure());
  }


  // A share of 0.3, then 0.7, then all: each is that share of the whole, and the sum does not depend
  // on the way. Steps within a stage release in proportion.
  TEST(Stages, SharesAddUpMPI)
  {
    StressedDisk at_once, by_shares;
    for (StressedDisk *disk : {&at_once, &by_shares})
      disk->go_to(1.);
    at_once.stage({{at_once.core}, 1.}, 2.);
    const double whole = at_once.closure(0.3);
    by_shares.statics->begin_stage({{by_shares.core}, 0.3}, 2.);
    by_shares.go_to(1.5);
    // Newton's method leaves 1e-9 of the forces
    EXPECT_NEAR(by_shares.closure(0.3), 0.15 * whole, 1e-8 * whole);
    by_shares.go_to(2.);
    EXPECT_NEAR(by_shares.closure(0.3), 0.3 * whole, 1e-8 * whole);
    by_shares.stage({{}, 0.7}, 3.);
    EXPECT_NEAR(by_shares.closure(0.3), 0.7 * whole, 1e-8 * whole);
    by_shares.stage({{}, 1.}, 4.);
    auto difference = at_once.statics->solution();
    difference -= by_shares.statics->solution();
    EXPECT_LT(difference.linfty_norm(), 1e-10 * whole * outer);
  }


  // In finite displacements the wall closes by as much to first order in the strain.
  TEST(Stages, FiniteDisplacements)
  {
    StressedDisk disk(Kinematics::finite);
    disk.go_to(1.);
    disk.stage({{disk.core}, 0.5}, 2.);
    // strains of 2e-4, and the error of the mesh
    EXPECT_NEAR(disk.closure(1.),
                0.5 * exact_closure(),
                2.5e-3 * 0.5 * exact_closure());
  }


  // A run that begins anew has all blocks again.
  TEST(Stages, BeginAnewWithAllBlocks)
  {
    StressedDisk disk;
    disk.go_to(1.);
    disk.stage({{disk.core}, 1.}, 2.);
    disk.go_to(1.);
    EXPECT_LT(disk.statics->solution().linfty_norm(),
              1e-13 * pressure / modulus_of_rock * outer);
  }


  // What an earlier stage has released completely stays so when nothing of a second core is released.
  TEST(Stages, LaterBlocksAreReleasedOnTheirOwn)
  {
    StressedDisk disk(Kinematics::small, /* n_cores = */ 2);
    disk.go_to(1.);
    disk.stage({{disk.core}, 1.}, 2.);
    const double once = disk.closure(1.);
    disk.stage({{disk.other_core()}, 0.}, 3.);
    // nothing of the second one is released, and Newton's method leaves 1e-9 of the forces
    EXPECT_NEAR(disk.closure(1.), once, 1e-8 * once);
    disk.stage({{}, 1.}, 4.);
    EXPECT_GT(std::abs(disk.closure(1.) - once), 1e-3 * once);
  }


  TEST(Stages, WrongChangesAreRefused)
  {
    StressedDisk disk;
    disk.go_to(1.);
    EXPECT_THROW(disk.statics->begin_stage({{99}, 1.}, 2.), InputError);
    EXPECT_THROW(disk.statics->begin_stage({{disk.core}, 1.5}, 2.), InputError);
    disk.stage({{disk.core}, 0.5}, 2.);
    EXPECT_THROW(disk.statics->begin_stage({{disk.core}, 1.}, 3.), InputError);
    EXPECT_THROW(disk.statics->begin_stage({{}, 0.2}, 3.), InputError);
  }
} // namespace
