#include <nmm/contact/diagnostics/face_forces.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/output/contact_output.h>

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

// What is told of contact points: sums, tables, points for ParaView, pictures.
using namespace NMM;
using dealii::Point;
using dealii::Tensor;

namespace
{
  namespace fs = std::filesystem;

  /// A unit square on a floor that has moved to the right by 3.
  struct Touching
  {
    Touching()
      : physical_mesh([]() {
        Geometry geometry;
        geometry.add_polygon({{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}},
                             "a, \"b\"");
        return geometry;
      }())
      , mathematical_mesh(make_regular_mesh(
          physical_mesh,
          []() {
            RegularMeshParameters parameters;
            parameters.cell_size = 0.7;
            return parameters;
          }(),
          2))
      , manifold_mesh(mathematical_mesh, physical_mesh)
      , covers(manifold_mesh, MPI_COMM_WORLD)
      , surface(covers, {floor()})
    {
      surface.set_time(3.);
      // in front of the floor
      unsigned int e = 0;
      while (surface.reference_place(e, 0.5).x[1] > 1e-9)
        ++e;
      ContactPoint point;
      point.edge = e;
      point.s    = 0.25;
      point.x =
        Point<2>(surface.reference_place(e, 0.25).x) + Point<2>(0.5, 0.);
      point.weight   = 0.5;
      point.gap      = -1e-3;
      point.pressure = 8.;
      point.shear    = 3.;
      point.state    = ContactState::slip;
      point.normal   = Point<2>(0., 1.);
      point.master   = surface.edges().size() - 1;
      points.push_back(point);
      // without a master: told of nowhere
      point.master = invalid_index;
      point.state  = ContactState::open;
      points.push_back(point);
      // near, but open
      point.master   = surface.edges().size() - 1;
      point.gap      = 0.1;
      point.pressure = point.shear = 0.;
      points.push_back(point);
    }

    static RigidObstacle
    floor()
    {
      RigidObstacle floor;
      floor.name         = "floor";
      floor.pieces       = {CurvePiece::segment({100., 0.}, {-100., 0.})};
      floor.displacement = [](const double t) { return Tensor<1, 2>({t, 0.}); };
      return floor;
    }

    PhysicalMesh              physical_mesh;
    MathematicalMesh          mathematical_mesh;
    ManifoldMesh              manifold_mesh;
    CoverSystem               covers;
    ContactSurface            surface;
    std::vector<ContactPoint> points;
  };


  std::vector<std::string>
  lines_of(const fs::path &name)
  {
    std::ifstream            file(name);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
      lines.push_back(line);
    return lines;
  }


  TEST(ContactOutput, PointsAndSums)
  {
    const Touching touching;
    const auto     samples =
      gather_contact_points(touching.surface, touching.points);
    ASSERT_EQ(samples.size(), 2U);
    const ContactSample &sample = samples[0];
    EXPECT_EQ(to_string(sample.state), "slip");
    EXPECT_EQ(to_string(samples[1].state), "open");
    EXPECT_EQ(sample.x[0] - sample.reference[0], 0.5);
    // pressure lifts the slave, positive shear pulls it towards the right: the
    // floor runs to the left
    EXPECT_EQ(sample.traction()[0], 3.);
    EXPECT_EQ(sample.traction()[1], 8.);
    const auto forces = obstacle_forces(touching.surface, touching.points);
    ASSERT_EQ(forces.size(), 1U);
    EXPECT_EQ(forces[0][0], -1.5);
    EXPECT_EQ(forces[0][1], -4.);
    EXPECT_EQ(largest_pressure(touching.surface, touching.points), 8.);
  }


  TEST(ContactOutput, PictureHasBarsAndObstacles)
  {
    const Touching touching;
    PictureData    data;
    add_contact(touching.surface,
                gather_contact_points(touching.surface, touching.points),
                data);
    ASSERT_EQ(data.obstacles.size(), 1U);
    EXPECT_EQ(data.obstacles[0].front().at(1.)[0], 103.);
    ASSERT_EQ(data.contacts.size(), 1U);
    EXPECT_EQ(data.contacts[0].kind, PictureData::Bar::slips);
    EXPECT_EQ(data.contacts[0].foot.displacement[0], 0.5);

    // an endless floor does not make the solid small
    PictureData::Triangle triangle;
    const double          x[6] = {0., 1., 0., 0.5, 0.5, 0.};
    const double          y[6] = {0., 0., 1., 0., 0.5, 0.5};
    for (unsigned int i = 0; i < 6; ++i)
    {
      triangle.vertices[i].position = Point<2>(x[i], y[i]);
      triangle.values[i]            = 0.;
    }
    data.triangles.push_back(triangle);
    PictureExtents extents;
    extents.add(data, 1.);
    const auto [lower, upper] = extents.view();
    EXPECT_NEAR(lower[0], -0.08, 1e-12);
    EXPECT_NEAR(upper[0], 1.08, 1e-12);
    EXPECT_EQ(lower[1], 0.);
    EXPECT_EQ(upper[1], 1.);
    EXPECT_EQ(extents.largest_traction(), std::hypot(3., 8.));

    // each part is seen
    PictureParameters parameters;
    parameters.picture_width = 300;
    const auto draw          = [&](const PictureData &what) {
      return draw_picture_in_memory(what, parameters, "contact");
    };
    PictureData without = data;
    without.contacts.clear();
    EXPECT_NE(draw(data), draw(without));
    PictureData bare = without;
    bare.obstacles.clear();
    EXPECT_NE(draw(without), draw(bare));
    PictureData other      = data;
    other.contacts[0].kind = PictureData::Bar::sticks;
    EXPECT_NE(draw(data), draw(other));
  }


  TEST(ContactOutput, SeriesGoesOnAfterAStop)
  {
    const fs::path folder = fs::path(NMM_TEST_OUTPUT_DIR) / "contact-series";
    fs::remove_all(folder);
    const OutputDirectory directory(folder);
    directory.create();
    const Touching touching;
    const auto     points =
      gather_contact_points(touching.surface, touching.points);
    const auto write = [&](ContactSeries &series, const unsigned int k) {
      series.write(0.1 * k, "contacts-000" + std::to_string(k), points);
    };
    const auto make = [&]() {
      return ContactSeries(touching.surface, directory, "time", true, true);
    };
    {
      ContactSeries series = make();
      for (const unsigned int k : {0, 1, 2})
        write(series, k);
      // an end that no unbroken run has
      series.finish(0.25, points);
    }
    const auto table = lines_of(folder / "contacts.csv");
    // names, and two points in each of four states
    ASSERT_EQ(table.size(), 9U);
    EXPECT_EQ(table[0],
              "time,x,y,reference_x,reference_y,slave,master,gap,pressure,"
              "shear,state,weight,bonded");
    EXPECT_NE(table[1].find(",\"a, \"\"b\"\"\",floor,-0.001,8,3,slip,0.5,0"),
              std::string::npos)
      << table[1];
    EXPECT_EQ(table[8].substr(0, 5), "0.25,");
    for (const char *name : {"contacts-0002.vtp", "contacts.vtp"})
      EXPECT_TRUE(fs::exists(folder / name)) << name;

    // continued from the second state, to the same end in another way
    {
      ContactSeries series = make();
      series.resume(0.1);
      EXPECT_EQ(lines_of(folder / "contacts.csv").size(), 5U);
      write(series, 2);
      series.finish(0.2, points);
    }
    const auto continued = lines_of(folder / "contacts.csv");
    ASSERT_EQ(continued.size(), 7U);
    for (unsigned int i = 0; i < continued.size(); ++i)
      EXPECT_EQ(continued[i], table[i]);
    std::string list;
    for (const std::string &line : lines_of(folder / "contacts.pvd"))
      list += line;
    for (const char *name :
         {"contacts-0000.vtp", "contacts-0001.vtp", "contacts-0002.vtp"})
      EXPECT_NE(list.find(name), std::string::npos) << list;
    EXPECT_EQ(list.find("contacts.vtp"), std::string::npos) << list;

    // all of it is results of a run
    directory.create();
    EXPECT_TRUE(fs::is_empty(folder));
  }
} // namespace
