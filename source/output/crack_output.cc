#include <nmm/output/crack_output.h>

#include <deal.II/base/data_out_base.h>

#include "geometry/piece_geometry.h"
#include <algorithm>
#include <output/double_points.h>
#include <sstream>
#include <tuple>

namespace NMM
{
  using dealii::Point;

  void
  write_tips(const std::vector<TipSample> &tips,
             const OutputDirectory        &directory,
             const std::string            &name)
  {
    namespace DataOutBase = dealii::DataOutBase;

    const std::vector<std::string>        names = {"K_I",
                                                   "K_II",
                                                   "T",
                                                   "energy_release_rate",
                                                   "direction",
                                                   "direction",
                                                   "displacement",
                                                   "displacement"};
    std::vector<DataOutBase::Patch<0, 2>> patches(tips.size());
    for (unsigned int i = 0; i < tips.size(); ++i)
    {
      const TipSample          &tip   = tips[i];
      DataOutBase::Patch<0, 2> &patch = patches[i];
      patch.vertices[0]               = tip.x;
      patch.patch_index               = i;
      patch.data.reinit(names.size(), 1);
      unsigned int row = 0;
      for (const double value : {tip.factors.K_I,
                                 tip.factors.K_II,
                                 tip.factors.T,
                                 tip.factors.energy_release_rate,
                                 tip.direction[0],
                                 tip.direction[1],
                                 tip.displacement[0],
                                 tip.displacement[1]})
        patch.data(row++, 0) = static_cast<float>(value);
      AssertDimension(row, names.size());
    }

    using namespace dealii::DataComponentInterpretation;
    const std::vector<std::tuple<unsigned int,
                                 unsigned int,
                                 std::string,
                                 DataComponentInterpretation>>
      vectors = {{4, 5, "direction", component_is_part_of_vector},
                 {6, 7, "displacement", component_is_part_of_vector}};
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    directory.write_text(name, [&](std::ostream &out) {
      std::ostringstream text;
      DataOutBase::write_vtu(patches, names, vectors, flags, text);
      std::vector<Point<2>> points;
      for (const TipSample &tip : tips)
        points.push_back(tip.x);
      out << internal::with_double_points(text.str(), points);
    });
  }


  void
  add_cracks(const CrackSample &cracks, PictureData &data)
  {
    for (const TipSample &tip : cracks.tips)
      data.tips.push_back({tip.x, tip.displacement});

    const auto is_on = [](const auto &increment, const Point<2> &x) {
      // The cut may move an increment by rounding.
      constexpr double tolerance = 1e-6;
      const auto &[start, end]   = increment;
      return internal::nearest_point(CurvePiece::segment(start, end), x)
               .distance(x) <= tolerance * start.distance(end);
    };
    const auto first_grown = std::stable_partition(
      data.outlines.begin(),
      data.outlines.end(),
      [&](const PictureData::Polyline &line) {
        return std::none_of(cracks.increments.begin(),
                            cracks.increments.end(),
                            [&](const auto &increment) {
                              return is_on(increment, line.front().position) &&
                                     is_on(increment, line.back().position);
                            });
      });
    data.grown_faces.assign(first_grown, data.outlines.end());
    data.outlines.erase(first_grown, data.outlines.end());
  }
} // namespace NMM
