// Functions that are carried over to a solid that was cut further.

#include <nmm/covers/graded_mesh.h>
#include <nmm/mechanics/carried_covers.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Vector = CarriedCovers::Vector;

  /// The pentagon with a crack that has the given points.
  Geometry
  cracked(const std::vector<Point<2>> &crack)
  {
    Geometry geometry;
    geometry.add_polygon(pentagon, "outline");
    geometry.add_polyline(crack, "crack", CurveRole::joint, JointState::open);
    return geometry;
  }


  DisplacementField
  field(const Model &model, const Vector &owned)
  {
    Vector relevant(model.covers.locally_owned_dofs(2),
                    model.covers.locally_relevant_dofs(2),
                    model.covers.communicator());
    relevant = owned;
    return DisplacementField(model.covers, model.problem, relevant);
  }


  /// Largest difference of two functions at all points of the rules after a cut, seen from the
  /// element before the cut that contains the point.
  double
  largest_difference(const Model  &before,
                     const Vector &u_before,
                     const Model  &after,
                     const Vector &u_after)
  {
    const DisplacementField a = field(before, u_before),
                            b = field(after, u_after);
    const auto &cells_before  = before.mathematical_mesh;
    const auto &cells         = after.mathematical_mesh;
    double      largest       = 0.;
    for (unsigned int e = 0; e < after.manifold_mesh.n_elements(); ++e)
      for (const Point<2> &xi : after.quadrature->rule(e).get_points())
      {
        const Point<2> x =
          cells.reference_to_real(after.manifold_mesh.cell(e), xi);
        const unsigned int former = before.manifold_mesh.find_element(x);
        const Point<2>     xi_before =
          cells_before.real_to_reference(before.manifold_mesh.cell(former), x);
        largest = std::max(
          largest,
          (a.displacement(former, xi_before) - b.displacement(e, xi)).norm());
      }
    return largest;
  }

  /// A function that makes a mesh with small cells at the given tips.
  auto
  mesh_with(const std::vector<Point<2>> &tips)
  {
    return [=](const PhysicalMesh &physical_mesh) {
      GradedMeshParameters parameters;
      static_cast<RegularMeshParameters &>(parameters) =
        mesh_parameters(0.2, Tensor<1, 2>({0.03, 0.02}), 17.);
      for (const Point<2> &tip : tips)
      {
        LocalSize size;
        size.kind   = LocalSize::Kind::point;
        size.point  = tip;
        size.size   = 0.002;
        size.growth = 0.3;
        parameters.local_sizes.push_back(size);
      }
      return make_graded_mesh(physical_mesh, parameters, 2);
    };
  }
} // namespace


// On the same mesh there is no projection: the function is the same on both sides of the new faces. The
// tolerance is that of evaluating it at coordinates with rounding errors.
TEST(CarriedCoversTest, SameFunctionOnTheSameMesh)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(0., 1.);
    const Point<2> a(-0.3, 0.2 + 0.5 * random(generator)),
      b(0.3 + 0.2 * random(generator), 0.3 + 0.3 * random(generator)),
      c(b[0] + 0.3 * random(generator), b[1] + 0.3 * random(generator));
    const auto mesh = mesh_parameters(0.13,
                                      Tensor<1, 2>({0.13 * random(generator),
                                                    0.13 * random(generator)}),
                                      60. * random(generator));
    Model      before(cracked({a, b}), mesh, 2, Stabilization::none),
      after(cracked({a, b, c}), mesh, 2, Stabilization::none);
    ASSERT_GT(after.covers.n_covers(), before.covers.n_covers());
    for (Model *model : {&before, &after})
      model->problem.materials = {material()};
    Vector u(before.covers.locally_owned_dofs(2), MPI_COMM_WORLD);
    for (const auto i : u.locally_owned_elements())
      u(i) = 2. * random(generator) - 1.;
    u.compress(dealii::VectorOperation::insert);

    const CarriedCovers carried(before.covers, after.covers, *after.quadrature);
    const Vector        v = carried.carry(u);
    EXPECT_LT(largest_difference(before, u, after, v), 1e-12);
    // Values are copied, not computed.
    for (const double value : v)
      EXPECT_NE(std::find(u.begin(), u.end(), value), u.end());
  }
}


// Cells become smaller at the new tip. Quadratic functions are then the same, one on each side of the crack.
TEST(CarriedCoversTest, QuadraticFunctionOnSmallerCells)
{
  // The crack divides the pentagon, and the additional one leaves it.
  const Point<2> a(-0.5, 0.5), b(1.5, 0.5), c(0.6, 0.5), d(0.7, 0.65);
  const auto     geometry = [&](const bool is_grown) {
    Geometry result = cracked({a, b});
    if (is_grown)
      result.add_polyline({c, d}, "branch", CurveRole::joint, JointState::open);
    return result;
  };
  Model before(geometry(false), mesh_with({c}), Stabilization::none),
    after(geometry(true), mesh_with({c, d}), Stabilization::none);
  ASSERT_GT(after.covers.n_covers(), 1.2 * before.covers.n_covers());
  for (Model *model : {&before, &after})
    model->problem.materials = {material()};

  const auto function = [](const Point<2> &x, const bool is_above) {
    Tensor<1, 2> u({x[0] * x[1] - x[1] * x[1], 1. + x[0] * x[0]});
    return is_above ? u : Tensor<1, 2>({-3. + x[1], 2. * x[0] * x[1]});
  };
  Vector u(before.covers.locally_owned_dofs(2), MPI_COMM_WORLD);
  for (unsigned int e = 0; e < before.manifold_mesh.n_elements(); ++e)
  {
    const auto &m        = before.manifold_mesh;
    const bool  is_above = m.block(e) == m.block(m.find_element({0.4, 1.}));
    for (const unsigned int cover : before.covers.covers(e))
      for (unsigned int i = 0; i < 2; ++i)
        u(2 * cover + i) = function(before.covers.node(cover), is_above)[i];
  }
  u.compress(dealii::VectorOperation::insert);
  const CarriedCovers carried(before.covers, after.covers, *after.quadrature);
  EXPECT_LT(largest_difference(before, u, after, carried.carry(u)), 1e-12);
  for (unsigned int block = 0; block < 2; ++block)
    EXPECT_LT(carried.former_block(block), 2U);
  EXPECT_NE(carried.former_block(0), carried.former_block(1));
}


// Cells become larger where a tip was, and displacements are like the square root of the distance from it. A
// first guess of them is off by less than they are (0.8 of them). From the tip's small cells alone it is
// off by five times as much as they are.
TEST(CarriedCoversTest, LargerCellsBehindATip)
{
  const Point<2> a(-0.5, 0.5), b(0.6, 0.5), c(0.75, 0.6);
  Model          before(cracked({a, b}), mesh_with({b}), Stabilization::none),
    after(cracked({a, b, c}), mesh_with({c}), Stabilization::none);
  const auto largest_cell_at_b = [&](const Model &model) {
    return model.mathematical_mesh.cell_diameter(model.manifold_mesh.cell(
      model.manifold_mesh.find_element(b + Tensor<1, 2>({0., 1e-3}))));
  };
  ASSERT_GT(largest_cell_at_b(after), 10. * largest_cell_at_b(before));
  Vector u(before.covers.locally_owned_dofs(2), MPI_COMM_WORLD);
  for (unsigned int cover = 0; cover < before.covers.n_covers(); ++cover)
    for (unsigned int i = 0; i < 2; ++i)
      u(2 * cover + i) = std::sqrt(before.covers.node(cover).distance(b));
  u.compress(dealii::VectorOperation::insert);
  const Vector v =
    CarriedCovers(before.covers, after.covers, *after.quadrature).carry(u);
  double worst = 0.;
  for (unsigned int cover = 0; cover < after.covers.n_covers(); ++cover)
  {
    const double exact = std::sqrt(after.covers.node(cover).distance(b));
    worst = std::max(worst, std::abs(v(2 * cover) - exact) / exact);
  }
  EXPECT_LT(worst, 1.);
}
