#include <nmm/output/crack_output.h>
#include <nmm/output/vtu.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <support/random_scenes.h>
#include <zlib.h>

using namespace NMM;
using dealii::Utilities::decode_base64;

namespace
{
  /// The numbers of the array that follows @p what in a file, by VTK's rules: a head
  /// of 16 bytes, with the number of blocks (1), their sizes and the size when
  /// compressed, then a zlib stream.
  template <typename Number>
  std::vector<Number>
  read_array(const std::string &file, const std::string &what)
  {
    const std::size_t at = file.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    const std::size_t first = file.find('\n', file.find("format=", at)) + 1,
                      last  = file.find('\n', first);
    const auto head         = decode_base64(file.substr(first, 24));
    const auto body = decode_base64(file.substr(first + 24, last - first - 24));
    std::uint32_t sizes[4];
    std::memcpy(sizes, head.data(), sizeof(sizes));
    EXPECT_EQ(sizes[0], 1U) << what;
    EXPECT_EQ(sizes[1], sizes[2]) << what;
    EXPECT_EQ(sizes[3], body.size()) << what;
    std::vector<Number> numbers(sizes[1] / sizeof(Number));
    uLongf              size = sizes[1];
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(numbers.data()),
                         &size,
                         body.data(),
                         body.size()),
              Z_OK)
      << what;
    EXPECT_EQ(size, sizes[1]) << what;
    return numbers;
  }


  /// Fields of a rectangle, written and read again.
  TEST(Vtu, ArraysHoldWhatWasGiven)
  {
    const PhysicalMesh    physical_mesh(Testing::make_box(2., 1.));
    RegularMeshParameters parameters;
    parameters.cell_size = 0.04;
    parameters.rotation  = 7.;
    const MathematicalMesh mesh =
      make_regular_mesh(physical_mesh, parameters, 2);
    const ManifoldMesh manifold_mesh(mesh, physical_mesh);
    const CoverSystem  covers(manifold_mesh, MPI_COMM_SELF);
    FieldTriangles     triangles(covers, nullptr);
    const std::size_t  n = triangles.nodes.size();
    ASSERT_GT(n, 2000U);
    triangles.has_velocity = true;
    for (std::size_t t = 0; t < n; ++t)
      for (unsigned int i = 0; i < 6; ++i)
      {
        FieldSample           &sample = triangles.samples[t][i];
        const dealii::Point<2> x      = triangles.nodes[t][i];
        sample.displacement =
          dealii::Tensor<1, 2>({std::sin(x[0]), std::cos(x[1])});
        sample.velocity = dealii::Tensor<1, 2>({std::exp(x[0]), x[0] * x[1]});
        sample.direct.in_plane[0][1] = 1e6 * std::sin(5. * x[0] * x[1]);
        sample.recovered.zz          = -1e6 * x[1];
      }

    const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "nmm-test-vtu";
    const OutputDirectory directory(folder);
    directory.create();
    const std::string name =
      write_fields_of_state(covers, triangles, directory, "fields");
    EXPECT_EQ(name, "fields.vtu");
    std::ifstream     in(folder / name);
    const std::string file((std::istreambuf_iterator<char>(in)), {});
    write_fields_of_state(covers, triangles, directory, "again");
    std::ifstream in_again(folder / "again.vtu");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in_again), {}), file);
    std::filesystem::remove_all(folder);

    const auto points = read_array<double>(file, "<Points>");
    const auto connectivity =
      read_array<std::int32_t>(file, "\"connectivity\"");
    const auto offsets = read_array<std::int32_t>(file, "\"offsets\"");
    const auto types   = read_array<std::uint8_t>(file, "\"types\"");
    const auto u       = read_array<float>(file, "\"displacement\"");
    const auto v       = read_array<float>(file, "\"velocity\"");
    const auto direct  = read_array<float>(file, "\"direct_stress_xy\"");
    const auto zz      = read_array<float>(file, "\"recovered_stress_zz\"");
    const auto mises   = read_array<float>(file, "\"von_mises_stress\"");
    const auto block   = read_array<float>(file, "\"block\"");
    ASSERT_EQ(points.size(), 18 * n);
    ASSERT_EQ(u.size(), 18 * n);
    ASSERT_EQ(v.size(), 18 * n);
    for (const auto *scalars : {&direct, &zz, &mises, &block})
      ASSERT_EQ(scalars->size(), 6 * n);
    ASSERT_EQ(connectivity.size(), 6 * n);
    ASSERT_EQ(offsets.size(), n);
    ASSERT_EQ(types.size(), n);
    for (std::size_t k = 0; k < 6 * n; ++k)
    {
      const FieldSample      &sample = triangles.samples[k / 6][k % 6];
      const dealii::Point<2> &x      = triangles.nodes[k / 6][k % 6];
      // The same positions, and other numbers rounded to single precision.
      for (unsigned int d = 0; d < 2; ++d)
      {
        ASSERT_EQ(points[3 * k + d], x[d]);
        ASSERT_EQ(u[3 * k + d], static_cast<float>(sample.displacement[d]));
        ASSERT_EQ(v[3 * k + d], static_cast<float>(sample.velocity[d]));
      }
      ASSERT_EQ(u[3 * k + 2], 0.f);
      ASSERT_EQ(direct[k], static_cast<float>(sample.direct.in_plane[0][1]));
      ASSERT_EQ(zz[k], static_cast<float>(sample.recovered.zz));
      ASSERT_EQ(mises[k], static_cast<float>(std::abs(sample.recovered.zz)));
      ASSERT_EQ(block[k], 0.f);
      ASSERT_EQ(connectivity[k], static_cast<std::int32_t>(k));
    }
    for (std::size_t t = 0; t < n; ++t)
    {
      ASSERT_EQ(offsets[t], static_cast<std::int32_t>(6 * (t + 1)));
      ASSERT_EQ(types[t], 22);
    }
  }


  TEST(Vtu, TipsHoldWhatWasGiven)
  {
    std::vector<TipSample> tips(2);
    for (unsigned int i = 0; i < 2; ++i)
    {
      tips[i].x            = dealii::Point<2>(1. + i, 0.3);
      tips[i].direction    = dealii::Tensor<1, 2>({0.6, -0.8});
      tips[i].displacement = dealii::Tensor<1, 2>({1e-3 * i, 2e-3});
      tips[i].factors.K_I  = 1e6 + i;
      tips[i].factors.K_II = -2e5;
      tips[i].factors.T    = -3e6;
      tips[i].factors.energy_release_rate = 40.5 + i;
    }
    const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "nmm-test-tips";
    const OutputDirectory directory(folder);
    directory.create();
    const auto written = [&](const std::vector<TipSample> &samples) {
      write_tips(samples, directory, "tips.vtu");
      std::ifstream in(folder / "tips.vtu");
      return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string file = written(tips), empty = written({});
    std::filesystem::remove_all(folder);

    using Floats         = std::vector<float>;
    const auto expect_is = [&](const std::string &name, const Floats &values) {
      EXPECT_EQ(read_array<float>(file, name), values) << name;
    };
    EXPECT_EQ(read_array<double>(file, "<Points>"),
              (std::vector<double>{1., 0.3, 0., 2., 0.3, 0.}));
    expect_is("\"K_I\"", {1e6f, 1000001.f});
    expect_is("\"K_II\"", {-2e5f, -2e5f});
    expect_is("\"T\"", {-3e6f, -3e6f});
    expect_is("\"energy_release_rate\"", {40.5f, 41.5f});
    expect_is("\"direction\"", {0.6f, -0.8f, 0.f, 0.6f, -0.8f, 0.f});
    expect_is("\"displacement\"", {0.f, 2e-3f, 0.f, 1e-3f, 2e-3f, 0.f});
    // VTK's vertices
    EXPECT_EQ(read_array<std::uint8_t>(file, "\"types\""),
              (std::vector<std::uint8_t>{1, 1}));
    EXPECT_NE(empty.find("NumberOfPoints=\"0\""), std::string::npos) << empty;
  }
} // namespace
