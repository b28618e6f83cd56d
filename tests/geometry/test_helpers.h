#ifndef nmm_tests_geometry_test_helpers_h
#define nmm_tests_geometry_test_helpers_h

#include <nmm/base/exceptions.h>
#include <nmm/geometry/physical_mesh.h>

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace geometry_test
{
  using Point = dealii::Point<2>;

  const std::string unit_square =
    "boundary name=square POLYGON ((0 0, 1 0, 1 1, 0 1))\n";


  inline NMM::PhysicalMesh
  mesh_of(const std::string &text)
  {
    return NMM::PhysicalMesh(NMM::parse_geometry(text, "test.wkt"));
  }


  inline double
  total_area(const NMM::PhysicalMesh &mesh)
  {
    double sum = 0.;
    for (const auto &region : mesh.regions())
      sum += region.area;
    return sum;
  }


  /// Message of the InputError that building throws; "" if it throws none.
  template <typename Function>
  std::string
  error_of(const Function &function)
  {
    try
    {
      function();
    }
    catch (const NMM::InputError &error)
    {
      return error.message();
    }
    return "";
  }


  /// Every one of @p parts occurs in @p message.
  inline void
  expect_parts(const std::string              &message,
               const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos)
        << "'" << part << "' is not in: " << message;
  }
} // namespace geometry_test

#endif
