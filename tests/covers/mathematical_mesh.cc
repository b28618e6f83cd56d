#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/mathematical_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>

#include "support/random_scenes.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;

namespace
{
  double
  shortest_edge(const MathematicalMesh &mesh)
  {
    double shortest = 1e300;
    for (const auto &edge : mesh.edges())
      shortest = std::min(shortest,
                          mesh.vertices()[edge.vertices[0]].distance(
                            mesh.vertices()[edge.vertices[1]]));
    return shortest;
  }


  double
  smallest_angle(const MathematicalMesh &mesh)
  {
    double smallest = numbers::PI;
    for (const auto &v : mesh.cells())
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Tensor<1, 2> a = mesh.vertices()[v[(i + 1) % 3]] -
                               mesh.vertices()[v[i]],
                           b = mesh.vertices()[v[(i + 2) % 3]] -
                               mesh.vertices()[v[i]];
        smallest = std::min(smallest, std::acos(a * b / (a.norm() * b.norm())));
      }
    return smallest;
  }


  double
  element_area(const ManifoldMesh &mesh)
  {
    double area = 0.;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      area += mesh.area(e);
    return area;
  }


  GradedMeshParameters
  graded_towards_corner(const double smallest)
  {
    GradedMeshParameters parameters;
    parameters.cell_size = 0.2;
    LocalSize corner;
    corner.kind   = LocalSize::Kind::point;
    corner.point  = Point<2>(1., 1.);
    corner.size   = smallest;
    corner.growth = 0.3;
    parameters.local_sizes.push_back(corner);
    return parameters;
  }
} // namespace


TEST(RegularMesh, EquilateralTrianglesOfTheWantedSize)
{
  const PhysicalMesh    physical(make_box(3., 1.));
  RegularMeshParameters parameters;
  parameters.cell_size        = 0.25;
  parameters.rotation         = 17.;
  const MathematicalMesh mesh = make_regular_mesh(physical, parameters, 2);
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
  {
    EXPECT_NEAR(mesh.cell_area(c), std::sqrt(3.) / 4. * 0.0625, 1e-15);
    EXPECT_NEAR(mesh.cell_diameter(c), 0.25, 1e-15);
  }
}


TEST(RegularMesh, OffsetAndRotationMoveTheNodes)
{
  const PhysicalMesh    physical(make_box(1., 1.));
  RegularMeshParameters parameters;
  parameters.cell_size        = 0.3;
  parameters.offset           = Tensor<1, 2>({0.07, -0.02});
  parameters.rotation         = 30.;
  const MathematicalMesh mesh = make_regular_mesh(physical, parameters, 1);
  // the box's centre plus the offset is a node, and so is one cell further
  // along the direction of the rotation
  for (const Point<2> &wanted :
       {Point<2>(0.57, 0.48),
        Point<2>(0.57 + 0.3 * std::sqrt(3.) / 2., 0.48 + 0.15)})
  {
    double nearest = 1e300;
    for (const Point<2> &v : mesh.vertices())
      nearest = std::min(nearest, v.distance(wanted));
    EXPECT_LT(nearest, 1e-14);
  }
}


TEST(RegularMesh, BadCellSizes)
{
  const PhysicalMesh physical(make_box(1., 1.));
  for (const double size : {0., -1., std::nan(""), 1e-9})
  {
    RegularMeshParameters parameters;
    parameters.cell_size = size;
    EXPECT_THROW(make_regular_mesh(physical, parameters, 2), InputError)
      << size;
  }
}


TEST(MathematicalMesh, RejectsDegreesAndCellsItCannotUse)
{
  Triangulation<2> squares;
  GridGenerator::hyper_cube(squares);
  EXPECT_THROW(MathematicalMesh(squares, 2), InputError);
  Triangulation<2> triangles;
  GridGenerator::subdivided_hyper_cube_with_simplices(triangles, 1);
  EXPECT_THROW(MathematicalMesh(triangles, 3), InputError);
  EXPECT_THROW(MathematicalMesh(triangles, 0), InputError);
  EXPECT_THROW(MathematicalMesh(std::make_unique<Triangulation<2>>(), 2),
               InputError);
}


TEST(MathematicalMesh, EdgesKnowTheirCellsAndCovers)
{
  Triangulation<2> triangulation;
  GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 3);
  const MathematicalMesh mesh(triangulation, 2);
  for (const auto &edge : mesh.edges())
    for (unsigned int side = 0; side < 2; ++side)
    {
      const unsigned int c = edge.cells[side];
      if (c == invalid_index)
        continue;
      // cell 0 lies to the left
      Point<2> center;
      for (const unsigned int v : mesh.cell_vertices(c))
        center += mesh.vertices()[v] / 3.;
      const Point<2> a = mesh.vertices()[edge.vertices[0]],
                     b = mesh.vertices()[edge.vertices[1]];
      const double left =
        (b[0] - a[0]) * (center[1] - a[1]) - (b[1] - a[1]) * (center[0] - a[0]);
      EXPECT_GT(side == 0 ? left : -left, 0.);
    }
  // the finite element's own support points are the nodes
  const auto &points = mesh.fe().get_unit_support_points();
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    for (unsigned int i = 0; i < 6; ++i)
      EXPECT_LT(mesh.reference_to_real(c, points[i])
                  .distance(mesh.cover_node(mesh.cell_covers(c)[i])),
                1e-15);
}


TEST(GradedMesh, SizesFollowTheField)
{
  const PhysicalMesh         physical(make_box(1., 1.));
  const GradedMeshParameters parameters = graded_towards_corner(0.02);
  const MathematicalMesh     mesh = make_graded_mesh(physical, parameters, 2);
  const SizeField            size(physical, parameters);
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
  {
    Point<2> center;
    for (const unsigned int v : mesh.cell_vertices(c))
      center += mesh.vertices()[v] / 3.;
    // the field is asked at the centre of the triangle before it was halved
    EXPECT_LT(mesh.cell_diameter(c), size(center) * 1.15 + 1e-12);
  }
  // 0.2 / 2^4 is the first size below 0.02
  EXPECT_NEAR(shortest_edge(mesh), 0.0125, 0.0125 * 0.14);
  EXPECT_GT(smallest_angle(mesh), numbers::PI / 6. - 1e-12);
  // a fraction of the 1.4e4 cells of a uniform mesh of the smallest size
  EXPECT_LT(mesh.n_cells(), 1500u);
}


TEST(GradedMesh, IsConforming)
{
  const PhysicalMesh   physical(make_box(1., 1.));
  GradedMeshParameters parameters = graded_towards_corner(0.001);
  parameters.rotation             = 11.;
  const MathematicalMesh mesh     = make_graded_mesh(physical, parameters, 2);
  const ManifoldMesh     manifold(mesh, physical);
  const CoverSystem      covers(manifold, MPI_COMM_SELF);
  EXPECT_NEAR(element_area(manifold), 1., 1e-13);
  // Euler's formula for a disk, and every edge but those around it between two
  // cells: a hanging node would break both
  unsigned int n_single = 0;
  for (const auto &edge : mesh.edges())
    n_single +=
      (edge.cells[0] == invalid_index) != (edge.cells[1] == invalid_index);
  const unsigned int n_vertices = mesh.vertices().size(),
                     n_edges = mesh.edges().size(), n_cells = mesh.n_cells();
  EXPECT_EQ(n_vertices + n_cells, n_edges + 1);
  EXPECT_EQ(3 * n_cells, 2 * n_edges - n_single);
  EXPECT_LT(n_single, n_edges / 10);
}


TEST(GradedMesh, WithoutLocalSizesItIsTheRegularMesh)
{
  const PhysicalMesh   physical(make_box(1., 0.6));
  GradedMeshParameters parameters;
  parameters.cell_size           = 0.13;
  parameters.rotation            = 5.;
  const MathematicalMesh regular = make_regular_mesh(physical, parameters, 2),
                         graded  = make_graded_mesh(physical, parameters, 2);
  const ManifoldMesh manifold_a(regular, physical),
    manifold_b(graded, physical);
  EXPECT_EQ(manifold_a.n_elements(), manifold_b.n_elements());
  EXPECT_EQ(CoverSystem(manifold_a, MPI_COMM_SELF).n_covers(),
            CoverSystem(manifold_b, MPI_COMM_SELF).n_covers());
}


TEST(GradedMesh, BadSizes)
{
  const PhysicalMesh   physical(make_box(1., 1.));
  GradedMeshParameters parameters  = graded_towards_corner(0.02);
  parameters.local_sizes[0].growth = 2.;
  EXPECT_THROW(make_graded_mesh(physical, parameters, 2), InputError);
  parameters.local_sizes[0].growth = 0.2;
  parameters.local_sizes[0].size   = 0.;
  EXPECT_THROW(make_graded_mesh(physical, parameters, 2), InputError);
  parameters.local_sizes[0].size  = 0.02;
  parameters.local_sizes[0].kind  = LocalSize::Kind::curve;
  parameters.local_sizes[0].curve = "nowhere";
  EXPECT_THROW(make_graded_mesh(physical, parameters, 2), InputError);
}


TEST(GmshMesh, ReadsTrianglesAndRefusesOthers)
{
  const std::string name = std::string(NMM_TEST_OUTPUT_DIR) + "/square.msh";
  {
    std::ofstream file(name);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
            "$Nodes\n4\n1 -1 -1 0\n2 2 -1 0\n3 2 2 0\n4 -1 2 0\n$EndNodes\n"
            "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n";
  }
  const MathematicalMesh mesh = read_gmsh_mesh(name, 2);
  EXPECT_EQ(mesh.n_cells(), 2u);
  const PhysicalMesh physical(make_box(1., 1.));
  EXPECT_NEAR(element_area(ManifoldMesh(mesh, physical)), 1., 1e-15);

  EXPECT_THROW(read_gmsh_mesh("no such file.msh", 2), InputError);
}


// One sentence says what is wrong, without the stack trace of deal.II.
TEST(GmshMesh, SaysWhatIsWrong)
{
  const std::string name = std::string(NMM_TEST_OUTPUT_DIR) + "/bad.msh";
  const auto expect = [&](const std::string &text, const std::string &part) {
    std::ofstream(name) << text;
    SCOPED_TRACE(text);
    try
    {
      read_gmsh_mesh(name, 2);
      ADD_FAILURE() << "it was read";
    }
    catch (const InputError &error)
    {
      EXPECT_NE(error.message().find(part), std::string::npos)
        << error.message();
      EXPECT_LT(error.message().size(), 300u);
      EXPECT_EQ(error.message().find('\n'), std::string::npos);
    }
  };
  const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string square =
    "$Nodes\n4\n1 -1 -1 0\n2 2 -1 0\n3 2 2 0\n4 -1 2 0\n$EndNodes\n";
  const auto elements = [](const std::string &number,
                           const std::string &lines) {
    return "$Elements\n" + number + "\n" + lines + "$EndElements\n";
  };
  const std::string two = "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n";

  expect("this is no mesh\n", "no gmsh mesh");
  expect(std::string("\x01\x00\xff\xfe junk", 9), "no gmsh mesh");
  expect("$MeshFormat\n2.2 1 8\n\x01\n$EndMeshFormat\n", "binary");
  expect("$MeshFormat\n3 0 8\n$EndMeshFormat\n", "format 3");
  expect(format + square + elements("1", "1 3 2 1 1 1 2 3 4\n"),
         "1 quadrilaterals");
  expect(format + square + elements("1", "1 9 2 1 1 1 2 3 4 1 2\n"),
         "second or higher order");
  expect(format + square + elements("1", "1 4 2 1 1 1 2 3 4\n"),
         "neither triangles nor lines");
  expect(format + square + elements("1", "1 1 2 1 1 1 2\n"), "no triangles");
  expect(format + square + elements("3", two + "3 2 2 1 1 1 2 3\n"), "overlap");
  expect(format + square + elements("2", "1 2 2 1 1 1 2 3\n2 2 2 1 1 2 3 4\n"),
         "overlap");
  expect(format + square + "$Elements\n2\n" + two, "ends early");
  expect(format + square + elements("2", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 9\n"),
         "cannot be read");
  expect(format + "$Nodes\n4000000000\n1 -1 -1 0\n$EndNodes\n" +
           elements("2", two),
         "$Nodes");
  expect(format +
           "$Nodes\n4\n1 -1 -1 0\n2 2 -1 0\n3 5 -1 0\n4 -1 2 0\n$EndNodes\n" +
           elements("1", "1 2 2 1 1 1 2 3\n"),
         "no area");
  // Two triangles that share an edge in space, but not its nodes.
  expect(format +
           "$Nodes\n6\n1 -1 -1 0\n2 2 -1 0\n3 2 2 0\n4 -1 2 0\n5 -1 -1 0\n"
           "6 2 2 0\n$EndNodes\n" +
           elements("2", "1 2 2 1 1 1 2 3\n2 2 2 1 1 5 6 4\n"),
         "two nodes at");
  // Format 4.1, quadrilaterals
  expect(
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n-1 -1 0\n2 -1 0\n2 2 0\n"
    "-1 2 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 3 1\n1 1 2 3 4\n"
    "$EndElements\n",
    "1 quadrilaterals");
}
