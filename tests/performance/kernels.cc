// The innermost loops, each a few hundred times, for callgrind to count their
// instructions; see ./setup.sh bench full. Nothing here calls CGAL, whose interval
// arithmetic needs rounding modes that valgrind does not know.
//
//   valgrind --tool=callgrind --instr-atstart=no nmm-kernels
//
// Each kernel ends with a dump whose name is what|for each of what|how many.

#include <nmm/base/exceptions.h>
#include <nmm/materials/hyperelastic_law.h>
#include <nmm/materials/material.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <contact/assembly/point_terms.h>
#include <iostream>
#include <mechanics/finite_terms.h>
#include <mechanics/linear_terms.h>
#include <string>
#include <vector>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
// a program that counts nothing
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) static_cast<void>(name)
#endif

using namespace NMM;
using namespace NMM::internal;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr unsigned int n_repetitions = 200;

  /// What kernels make, so that nothing is optimized away.
  double sum = 0.;


  template <typename Action>
  void
  measure(const std::string &what, const std::string &per, const Action &action)
  {
    // tables and scratch memory are made by the first call
    action();
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    for (unsigned int i = 0; i < n_repetitions; ++i)
      action();
    const std::string name =
      what + "|" + per + "|" + std::to_string(n_repetitions);
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    CALLGRIND_STOP_INSTRUMENTATION;
    std::cout << what << '\n';
  }


  /// The boundary of a polygon.
  std::vector<ElementEdge>
  polygon(const std::vector<Point<2>> &corners)
  {
    std::vector<ElementEdge> edges(corners.size());
    for (unsigned int i = 0; i < corners.size(); ++i)
    {
      edges[i].start = corners[i];
      edges[i].end   = corners[(i + 1) % corners.size()];
    }
    return edges;
  }


  /// A cell with corners (0.1, 0.2), (1.1, 0.3) and (0.5, 1.1).
  CellFrame
  cell_frame()
  {
    CellFrame frame;
    frame.origin         = Point<2>(0.1, 0.2);
    frame.jacobian[0][0] = 1.;
    frame.jacobian[0][1] = 0.4;
    frame.jacobian[1][0] = 0.1;
    frame.jacobian[1][1] = 0.9;
    return frame;
  }


  void
  measure_rules()
  {
    ElementRuleBuilder builder(4);
    const auto         rule_of = [&](const std::string              &what,
                             const std::vector<ElementEdge> &edges) {
      const dealii::ArrayView<const ElementEdge> view(edges.data(),
                                                      edges.size());
      measure("rule of degree 4: " + what, "element", [&]() {
        sum += builder.build(view, cell_frame()).weight(0);
      });
    };
    rule_of("triangle", polygon({{0.3, 0.3}, {0.7, 0.4}, {0.5, 0.7}}));
    rule_of("quadrilateral",
            polygon({{0.3, 0.3}, {0.7, 0.3}, {0.6, 0.6}, {0.35, 0.5}}));
    rule_of("pentagon",
            polygon(
              {{0.3, 0.3}, {0.6, 0.3}, {0.7, 0.5}, {0.5, 0.7}, {0.35, 0.5}}));
    std::vector<ElementEdge> sector =
      polygon({{0.3, 0.3}, {0.7, 0.3}, {0.3, 0.7}});
    sector[1].center = Point<2>(0.3, 0.3);
    sector[1].radius = 0.4;
    rule_of("sector", sector);
  }


  void
  measure_small()
  {
    const dealii::Quadrature<2> rule = make_triangle_rule(4);
    PlaneElasticity             elasticity;
    elasticity.lambda = 1.;
    elasticity.mu     = 2.;
    LocalSystem              system;
    const ReferenceIntegrals integrals(rule, 2);
    measure("stiffness of a whole element, small", "element", [&]() {
      system.reset(6);
      add_linear_stiffness(integrals,
                           cell_frame().jacobian,
                           elasticity,
                           system);
      sum += system.matrix[0];
    });
    measure("integrals of a cut element, small", "element of 6 points", [&]() {
      sum += ReferenceIntegrals(rule, 2).gradients[0][0];
    });
  }


  void
  measure_finite(const std::shared_ptr<const MaterialLaw> &law,
                 const std::string                        &name)
  {
    Material material;
    material.name           = "rock";
    material.youngs_modulus = 1000.;
    material.poissons_ratio = 0.2;
    material.law            = law;
    const auto hyperelastic =
      material.hyperelastic_law(PlaneState::plane_strain);
    const dealii::Quadrature<2> rule = make_triangle_rule(4);
    std::vector<double>         weights, gradients;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      double g[6][2];
      WeightFunctions::gradients(2, rule.point(q), g);
      weights.push_back(rule.weight(q));
      gradients.insert(gradients.end(), &g[0][0], &g[0][0] + 12);
    }
    const ElementTables::View table = {rule.size(),
                                       weights.data(),
                                       reinterpret_cast<const double(*)[2]>(
                                         gradients.data())};
    LocalDisplacement         u;
    for (unsigned int i = 0; i < 6; ++i)
    {
      u.values[i][0] = 0.01 * i;
      u.values[i][1] = -0.005 * i * i;
    }
    LocalSystem local;
    for (const bool with_tangent : {false, true})
      measure((with_tangent ? "forces and tangent, " : "forces, ") + name,
              "element of " + std::to_string(rule.size()) + " points",
              [&]() {
                local.reset(6, with_tangent);
                const Deformation state =
                  add_volume_terms(*hyperelastic, table, u, nullptr, local);
                sum += local.energy;
                AssertThrow(state == Deformation::admissible,
                            dealii::ExcInternalError());
              });
  }


  void
  measure_contact()
  {
    ContactSurface::Weights slave, master;
    slave.n = master.n = 6;
    for (unsigned int i = 0; i < 6; ++i)
    {
      slave.w[i] = master.w[i] = 1. / 6.;
      slave.dw[i] = master.dw[i] = 0.1 * i - 0.25;
      slave.ddw[i] = master.ddw[i] = 0.;
    }
    ContactSurface::Place place;
    place.a = Tensor<1, 2>({1., 0.1});
    ContactTraction traction;
    traction.pressure         = 1.;
    traction.normal_stiffness = 10.;
    traction.shear            = 0.2;
    traction.shear_stiffness  = 3.;
    ContactLocalSystem local;
    for (const bool with_friction : {false, true})
      measure(std::string("terms with tangent of a contact point") +
                (with_friction ? " that sticks" : " without friction"),
              "point",
              [&]() {
                const ContactKinematics kinematics(
                  slave, master, place, -0.01, with_friction);
                local.n_covers = with_friction ? 18 : 12;
                local.clear();
                add_contact_point(kinematics,
                                  traction,
                                  &slave,
                                  with_friction ? &master : nullptr,
                                  /* with_tangent = */ true,
                                  local);
                sum += local.rhs[0];
              });
  }
} // namespace


int
main()
{
  CALLGRIND_STOP_INSTRUMENTATION;
  measure_rules();
  measure_small();
  measure_finite(material_law("St. Venant-Kirchhoff"), "St. Venant-Kirchhoff");
  measure_finite(material_law("neo-Hookean"), "neo-Hookean");
  measure_contact();
  std::cout << "sum of what was made: " << sum << std::endl;
  return 0;
}
