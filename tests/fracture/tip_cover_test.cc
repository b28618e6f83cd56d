// Covers of crack tips: with their functions the full order, wherever the tip lies, and the right
// work of all loads.

#include <nmm/fracture/intensity_factors.h>
#include <nmm/fracture/tip_cover.h>
#include <nmm/linear_algebra/condition_number.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "westergaard.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <linear_algebra/direct_solver.h>
#include <mechanics/boundary_terms.h>
#include <mechanics/disk_system.h>
#include <mechanics/model.h>
#include <mechanics/trace_constant.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  constexpr auto displacement_condition = BoundaryCondition::Type::displacement;

  /// A square with a crack, a cover about its tip and a mesh of cells of one size.
  class CoveredModel
  {
  public:
    CoveredModel(const std::string           &joint,
                 const RegularMeshParameters &mesh,
                 const Stabilization stabilization = Stabilization::aggregation)
    {
      Geometry geometry = parse_geometry(
        "boundary name=outline POLYGON ((-1 -1, 1 -1, 1 1, -1 1))\n" + joint,
        "");
      ElasticityProblem problem;
      problem.plane_state = PlaneState::plane_strain;
      problem.materials   = {material("rock", 1000., 0.3)};
      const PhysicalMesh solid{Geometry(geometry)};
      tip_covers = make_tip_covers(solid, problem);
      add_circles(tip_covers, solid, geometry);
      model =
        std::make_unique<Model>(std::move(geometry), mesh, 2, stabilization);
      model->problem = problem;
      for (const auto &cover : tip_covers)
        model->disks.push_back(cover.get());
    }

    PlaneElasticity
    elasticity() const
    {
      return model->problem.materials[0].plane_elasticity(
        model->problem.plane_state);
    }

    IntensityFactors
    factors() const
    {
      return compute_intensity_factors(
        *model->field,
        model->problem,
        find_crack_tips(model->physical_mesh).at(0));
    }

    /// Condition number of the stiffness matrix after diagonal scaling.
    double
    condition_of_stiffness() const
    {
      return estimate_condition_number(model->system->system_matrix(),
                                       model->covers,
                                       model->constraints)
        .value();
    }

    /// The equations of the coefficients that remain when the other unknowns are eliminated, C -
    /// B^T K^-1 B: its condition number after diagonal scaling, and the smallest ratio of its
    /// diagonal to that of C, which shows how many digits the elimination costs.
    std::pair<double, double>
    condition_of_coefficients() const
    {
      const internal::CurveConditions conditions(model->manifold_mesh,
                                                 model->problem);
      internal::TraceConstants        trace_constants(model->covers,
                                               *model->quadrature,
                                               model->constraints,
                                               conditions);
      const internal::EdgeTerms       edge_terms(model->covers,
                                           model->problem,
                                           trace_constants);
      internal::DiskSystem            disks(model->covers,
                                 model->constraints,
                                 model->problem,
                                 model->disks);
      disks.assemble(edge_terms, conditions, model->system->system_rhs());
      internal::DirectSolver solver;
      solver.factorize(model->system->system_matrix());
      const unsigned int               n = disks.couplings().size();
      dealii::LAPACKFullMatrix<double> scaled(n, n);
      dealii::FullMatrix<double>       S(disks.own_matrix());
      double                           smallest = 1.;
      for (unsigned int j = 0; j < n; ++j)
      {
        auto x = disks.couplings()[j];
        solver.solve(disks.couplings()[j], x);
        for (unsigned int i = 0; i < n; ++i)
          S(i, j) -= disks.couplings()[i] * x;
        smallest = std::min(smallest, S(j, j) / disks.own_matrix()(j, j));
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          scaled(i, j) =
            0.5 * (S(i, j) + S(j, i)) / std::sqrt(S(i, i) * S(j, j));
      dealii::FullMatrix<double> vectors;
      dealii::Vector<double>     values;
      scaled.compute_eigenvalues_symmetric(-1e3, 1e3, 1e-12, values, vectors);
      return {values(n - 1) / values(0), smallest};
    }

    std::vector<std::unique_ptr<TipCover>> tip_covers;
    std::unique_ptr<Model>                 model;
  };


  /// Solve with the exact displacement on the outline; the relative errors of u and of the stress.
  ErrorNorms
  solve_westergaard(CoveredModel &solid)
  {
    Model            &model = *solid.model;
    const Westergaard exact(solid.tip_covers.at(0)->tip(), solid.elasticity());
    model.problem.boundary_conditions = {
      condition(displacement_condition,
                "outline",
                vector_function(
                  [&](const Point<2> &x) { return exact.displacement(x); }))};
    model.solve();
    return compute_errors(
      *model.field,
      [&](const Point<2> &x) { return exact.displacement(x); },
      [&](const Point<2> &x) {
        return solid.elasticity().stress(dealii::symmetrize(exact.gradient(x)));
      });
  }


  // GetFEM 5.4.2 with enrichment in a fixed radius has 1.2e-3 in the energy norm and 1.7e-6 in K at
  // 15,682 unknowns (half of the length scale; this square has twice the size in crack lengths).
  TEST(TipCover, HasFullOrderOnCellsOfOneSize)
  {
    const std::string joint = "joint LINESTRING (-2 -0.3, 0.1 0.05)";
    CoveredModel      coarse(joint, mesh_parameters(0.2, {}, 0.3)),
      fine(joint, mesh_parameters(0.1, {}, 0.3));
    const ErrorNorms before = solve_westergaard(coarse),
                     after  = solve_westergaard(fine);
    EXPECT_GT(std::log2(before.displacement / after.displacement), 2.9);
    EXPECT_GT(std::log2(before.stress / after.stress), 1.9);
    EXPECT_LT(after.stress, 1.2e-3);
    const IntensityFactors k     = fine.factors();
    const double           exact = std::sqrt(dealii::numbers::PI);
    EXPECT_NEAR(k.K_I / exact, 1., 1.7e-6);
    EXPECT_NEAR(k.K_II / exact, 0., 1.7e-6);
    // T = 0; an error of the stress of 1e-3 at most
    EXPECT_NEAR(k.T, 0., 1e-3);
  }


  // The tip at 1e-1 to 1e-12 of a cell from a node, from an edge, and from both sides.
  TEST(TipCover, DoesNotDependOnTheTipsPlaceInTheCell)
  {
    constexpr double h     = 0.25;
    const auto       solve = [&](const Tensor<1, 2> &d) {
      RegularMeshParameters mesh = mesh_parameters(h, d);
      mesh.pattern               = MeshPattern::right_angled;
      auto solid =
        std::make_unique<CoveredModel>("joint LINESTRING (-2 0, 0 0)", mesh);
      const ErrorNorms errors = solve_westergaard(*solid);
      return std::make_pair(errors, std::move(solid));
    };
    const auto [generic, solid] = solve(Tensor<1, 2>({0.33 * h, 0.21 * h}));
    const double condition      = solid->condition_of_stiffness();
    for (const double distance : {1e-1, 1e-4, 1e-8, 1e-12})
      for (const Tensor<1, 2> &d : {Tensor<1, 2>({distance * h, 0.}),
                                    Tensor<1, 2>({0., distance * h}),
                                    Tensor<1, 2>({-distance * h, distance * h}),
                                    Tensor<1, 2>({0.4 * h, distance * h})})
      {
        const auto [errors, model] = solve(d);
        EXPECT_LT(errors.displacement, 1.5 * generic.displacement) << d;
        EXPECT_LT(errors.stress, 1.5 * generic.stress) << d;
        EXPECT_LT(model->condition_of_stiffness(), 10. * condition) << d;
        // The functions are independent of each other, whatever the mesh is. They are nearly
        // polynomials where r^(3/2) is: some digits of 16 are lost.
        const auto [of_coefficients, smallest] =
          model->condition_of_coefficients();
        EXPECT_LT(of_coefficients, 10. * condition) << d;
        EXPECT_GT(smallest, 1e-8) << d;
      }
  }


  // A quadratic displacement with its body force, initial stress and pressure on the faces needs no
  // tip functions. Their coefficients vanish if the work of each load is right.
  TEST(TipCover, SmoothFieldNeedsNone)
  {
    // the pressure bears the name of a second joint in the same place
    CoveredModel solid(
      "joint name=crack LINESTRING (-2 0, 0.1 0)\n"
      "joint name=water LINESTRING (-2 0, 0.1 0)",
      mesh_parameters(0.3));
    Model    &model           = *solid.model;
    Material &rock            = model.problem.materials[0];
    rock.initial_stress[0][0] = -20.;
    rock.initial_stress[0][1] = 7.;
    rock.initial_stress[1][1] = 12.;
    rock.density              = 2.;
    const PlaneElasticity e   = solid.elasticity();
    QuadraticField        field;
    field.constant     = Tensor<1, 2>({0.3, -0.2});
    field.linear[0][0] = 0.7;
    field.linear[1][1] = -0.4;
    // no shear on the crack at y = 0: mu (u_x,y + u_y,x) = -7 for all x
    field.linear[0][1]       = 0.5;
    field.linear[1][0]       = -0.5 - 7. / e.mu;
    field.quadratic[0][0][0] = 0.3;
    field.quadratic[0][1][1] = -0.6;
    field.quadratic[0][0][1] = 0.25;
    field.quadratic[1][0][0] = -0.25;
    field.quadratic[1][0][1] = 0.35;
    field.quadratic[1][1][1] = 0.9;
    // half of the body force as gravity, the rest as a function
    const Tensor<1, 2> f  = field.body_force(e);
    model.problem.gravity = 0.25 * f;
    model.problem.body_force =
      vector_function([&](const Point<2> &) { return 0.5 * f; });
    model.problem.boundary_conditions = {
      condition(displacement_condition,
                "outline",
                vector_function(
                  [&](const Point<2> &x) { return field.displacement(x); })),
      condition(BoundaryCondition::Type::pressure,
                "water",
                std::make_shared<dealii::ScalarFunctionFromFunctionObject<2>>(
                  [&](const Point<2> &x) {
                    return -(e.stress(dealii::symmetrize(field.gradient(x))) +
                             rock.initial_stress)[1][1];
                  }))};
    model.solve();
    // Stresses are of the size 1e3, and the elimination costs up to six digits of 16. A load with a
    // wrong sign or factor gives 1e3.
    for (const double c : model.system->disk_coefficients().at(0))
      EXPECT_NEAR(c, 0., 1e-6);
    const ErrorNorms errors = compute_errors(
      *model.field,
      [&](const Point<2> &x) { return field.displacement(x); },
      [&](const Point<2> &x) {
        return e.stress(dealii::symmetrize(field.gradient(x))) +
               rock.initial_stress;
      });
    EXPECT_LT(errors.displacement, 1e-11);
    EXPECT_LT(errors.stress, 1e-11);
  }


  // Half of the work of the loads, here of the exact displacement on the outline: the energy is
  // computed without integrals of singular functions.
  TEST(TipCover, StrainEnergyIsThatOfTheExactField)
  {
    CoveredModel solid("joint LINESTRING (-2 -0.3, 0.1 0.05)",
                       mesh_parameters(0.1));
    (void)solve_westergaard(solid);
    const Model      &model = *solid.model;
    const Westergaard exact(solid.tip_covers.at(0)->tip(), solid.elasticity());
    double            energy = model.system->disk_energy();
    for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
    {
      const auto  &rule = model.quadrature->rule(e);
      const double det =
        2. * model.mathematical_mesh.cell_area(model.manifold_mesh.cell(e));
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const auto strain =
          dealii::symmetrize(model.field->gradient_of_covers(e, rule.point(q)));
        energy += 0.5 * det * rule.weight(q) *
                  (solid.elasticity().stress(strain) * strain);
      }
    }
    // half of the integral of sigma n . u over the outline; the crack's faces are free
    double                  work = 0.;
    const dealii::QGauss<1> gauss(8);
    const Point<2> corners[4] = {{-1., -1.}, {1., -1.}, {1., 1.}, {-1., 1.}};
    for (unsigned int side = 0; side < 4; ++side)
    {
      const Tensor<1, 2> way = corners[(side + 1) % 4] - corners[side];
      const Tensor<1, 2> n({way[1] / 2., -way[0] / 2.});
      // the crack leaves through the left side at y = -0.125: no jump within a piece
      constexpr unsigned int n_pieces = 160;
      for (unsigned int i = 0; i < n_pieces; ++i)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const Point<2> x =
            corners[side] + (i + gauss.point(q)[0]) / n_pieces * way;
          work +=
            0.5 * 2. / n_pieces * gauss.weight(q) *
            (solid.elasticity().stress(dealii::symmetrize(exact.gradient(x))) *
             n * exact.displacement(x));
        }
    }
    // the energy error is the square of 1e-3; the penalty on the outline adds as much
    EXPECT_NEAR(energy / work, 1., 1e-5);
  }


  // Tips that are near each other have disks that do not overlap; an arc and a force at the tip leave
  // no room.
  TEST(TipCover, FitsOrIsLeftOut)
  {
    const auto covers_of = [](const std::string       &joints,
                              const ElasticityProblem &problem) {
      return make_tip_covers(
        PhysicalMesh(parse_geometry(
          "boundary name=outline POLYGON ((-1 -1, 1 -1, 1 1, -1 1))\n" + joints,
          "")),
        problem);
    };
    ElasticityProblem problem;
    problem.materials = {material()};
    const auto two    = covers_of(
      "joint LINESTRING (-0.5 0, 0 0)\n"
         "joint LINESTRING (0.1 0.1, 0.5 0.1)",
      problem);
    ASSERT_EQ(two.size(), 4u);
    for (const auto &a : two)
      for (const auto &b : two)
      {
        const double distance = a->tip().point.distance(b->tip().point);
        EXPECT_TRUE(a == b || a->radius() + b->radius() < distance);
      }
    // straight over 0.3: 0.9 times that
    const std::string kink   = "joint LINESTRING (-2 0.1, -0.3 0, 0 0)";
    const auto        kinked = covers_of(kink, problem);
    ASSERT_EQ(kinked.size(), 1u);
    EXPECT_NEAR(kinked[0]->radius(), 0.27, 1e-12);
    const PhysicalMesh solid(parse_geometry(
      "boundary name=outline POLYGON ((-1 -1, 1 -1, 1 1, -1 1))\n" + kink, ""));
    EXPECT_TRUE(make_tip_covers(solid, problem, 0., 0.4).empty());
    EXPECT_TRUE(make_tip_covers(solid, problem, 0.3).empty());
    EXPECT_TRUE(
      covers_of("joint CIRCULARSTRING (-2 0, -0.5 0.2, 0 0)", problem).empty());
    problem.point_forces.resize(1);
    problem.point_forces[0].point = Point<2>(0., 0.01);
    const auto small = covers_of("joint LINESTRING (-2 0, 0 0)", problem);
    ASSERT_EQ(small.size(), 1u);
    EXPECT_NEAR(small[0]->radius(), 0.008, 1e-12);
    problem.point_forces[0].point = Point<2>(0., 0.);
    EXPECT_TRUE(covers_of("joint LINESTRING (-2 0, 0 0)", problem).empty());
  }


  // The crack runs along edges of the mesh, so that the elements beside it are whole. At a face
  // their displacement is that of their side, and not the mean of both.
  TEST(TipCover, FacesAlongEdgesOfTheMeshOpen)
  {
    RegularMeshParameters mesh = mesh_parameters(0.125);
    mesh.pattern               = MeshPattern::right_angled;
    CoveredModel solid("joint LINESTRING (-2 0, 0 0)", mesh);
    solve_westergaard(solid);
    const ManifoldMesh &elements = solid.model->manifold_mesh;
    unsigned int        n_whole  = 0;
    for (unsigned int e = 0; e < elements.n_elements(); ++e)
      for (const ElementEdge &edge : elements.edges(e))
      {
        const Point<2> x = edge.start + 0.5 * (edge.end - edge.start);
        if (edge.curve_set == invalid_index || x[1] != 0. || x[0] > -0.1)
          continue;
        n_whole += elements.is_whole(e);
        const auto u = [&](const Point<2> &y) {
          return solid.model->field->displacement(
            e,
            elements.mathematical_mesh().real_to_reference(elements.cell(e),
                                                           y));
        };
        // The field is continuous up to the face; half of the opening is 1e-3 and more.
        const Tensor<1, 2> inwards = elements.reference_point(e) - x;
        EXPECT_NEAR((u(x) - u(x + 1e-6 * inwards)).norm(), 0., 1e-7);
        EXPECT_GT(std::copysign(1., inwards[1]) * u(x)[1], 1e-4);
      }
    EXPECT_GT(n_whole, 4u);
  }
} // namespace
