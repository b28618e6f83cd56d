#include <nmm/base/program.h>
#include <nmm/output/animation.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <sstream>

namespace NMM
{
  namespace
  {
    constexpr unsigned int max_places = 12;
    const std::string      head       = "time,frame 2";


    /// Copies the values of @p quantity from its layer into the triangles, if there is one.
    void
    choose_layer(const Quantity quantity, PictureData &data)
    {
      for (const PictureData::Layer &layer : data.layers)
        if (layer.quantity == quantity)
          for (std::size_t t = 0; t < data.triangles.size(); ++t)
            data.triangles[t].values = layer.values[t];
    }


    /// @p frame with the ranges of values and contact tractions of this picture. The range of
    /// values stays that of @p frame if the user has given one (@p is_given, or no range in
    /// @p frame, since the parameters of the picture then have one), or if the values of this
    /// picture differ by rounding errors only.
    PictureFrame
    own_frame(const PictureData  &data,
              const PictureFrame &frame,
              const bool          is_given)
    {
      constexpr double rounding = 1e-5;
      PictureExtents   extents;
      extents.add(data, data.deformation_scale);
      PictureFrame own         = frame;
      const auto [least, most] = extents.range();
      const double size        = std::max(std::abs(least), std::abs(most));
      if (!is_given && frame.range && most - least > rounding * size)
        own.range = extents.range();
      if (extents.largest_traction() > 0.)
        own.bar_scale = extents.largest_traction();
      return own;
    }


    /// Writes times with as many decimal places as are needed to distinguish neighbours.
    class TimeText
    {
    public:
      TimeText(const double first, const double last, const std::size_t n)
      {
        const double spacing =
          (last - first) / std::max<double>(1., static_cast<double>(n) - 1.);
        if (spacing > 0.)
          n_places = static_cast<int>(std::ceil(-std::log10(spacing))) + 1;
        n_places = std::max(0, n_places);
      }

      std::string
      operator()(const double time, const AnimationParameters &parameters) const
      {
        std::ostringstream text;
        text << parameters.time_name << " = ";
        if (n_places <= static_cast<int>(max_places))
          text << std::fixed << std::setprecision(n_places);
        else
          text << std::scientific << std::setprecision(4);
        text << time;
        if (!parameters.time_unit.empty())
          text << ' ' << parameters.time_unit;
        return text.str();
      }

    private:
      int n_places = 0;
    };
  } // namespace


  void
  AnimationParameters::check() const
  {
    const auto check_least = [](const unsigned int value,
                                const unsigned int least,
                                const char        *name) {
      AssertThrow(value >= least,
                  InputError(std::string(name) + " = " + std::to_string(value),
                             "the moving picture",
                             "give at least " + std::to_string(least)));
    };
    check_least(width, 100, "width");
    check_least(max_frames, 2, "number of frames");
    check_least(n_colours, 2, "number of colours");
    AssertThrow(!view || (view->first[0] < view->second[0] &&
                          view->first[1] < view->second[1]),
                InputError("an empty view",
                           "the moving picture",
                           "give the lower and the upper corner of a box"));
    AssertThrow(!range || range->first < range->second,
                InputError("an empty range of values",
                           "the moving picture",
                           "give the smaller value first"));
  }


  Animation::Animation(std::string name, const double keep_until)
    : file_name(std::move(name))
  {
    const auto time_of = [](const std::string &row) {
      return std::strtod(row.c_str(), nullptr);
    };
    std::function<bool(const std::string &)> is_kept;
    std::string                              line;
    // Frames of a file with another head, written by another version, are dropped.
    if (std::getline(std::ifstream(file_name), line) && line == head)
      is_kept = [&](const std::string &row) {
        return time_of(row) <= keep_until;
      };
    rows.emplace(file_name, head + "\n", is_kept);
    std::ifstream file(file_name);
    std::getline(file, line);
    for (auto position = file.tellg(); std::getline(file, line);
         position      = file.tellg())
      records.push_back({time_of(line), position});
  }


  void
  Animation::add_frame(const double time, const PictureData &data)
  {
    AssertThrow(records.empty() || time >= records.back().time,
                InputError("a frame of an earlier time",
                           "the moving picture",
                           "add frames in the order of their times"));
    const std::vector<char> bytes = dealii::Utilities::pack(data);
    std::ostringstream      row;
    row << time_text(time) << ','
        << dealii::Utilities::encode_base64({bytes.begin(), bytes.end()})
        << '\n';
    const auto position =
      static_cast<std::streamoff>(std::filesystem::file_size(file_name));
    rows->append(row.str());
    records.push_back({time, position});
  }


  unsigned int
  Animation::n_frames() const
  {
    return records.size();
  }


  PictureData
  Animation::read(const Record &record) const
  {
    if (record.data != nullptr)
      return *record.data;
    std::ifstream file(file_name);
    std::string   row;
    file.seekg(record.position);
    std::getline(file, row);
    AssertThrow(file.good(),
                InputError("the file '" + file_name + "' cannot be read",
                           "the moving picture",
                           "leave it in its place while the analysis runs"));
    const std::vector<unsigned char> bytes =
      dealii::Utilities::decode_base64(row.substr(row.find(',') + 1));
    return dealii::Utilities::unpack<PictureData>(
      std::vector<char>(bytes.begin(), bytes.end()));
  }


  std::vector<Quantity>
  Animation::common_quantities(const std::vector<Record>   &shown,
                               const std::vector<Quantity> &quantities) const
  {
    std::vector<Quantity> common = quantities;
    for (const Record &record : shown)
    {
      const auto layers = read(record).layers;
      common.erase(std::remove_if(common.begin(),
                                  common.end(),
                                  [&](const Quantity quantity) {
                                    return std::none_of(
                                      layers.begin(),
                                      layers.end(),
                                      [&](const auto &layer) {
                                        return layer.quantity == quantity;
                                      });
                                  }),
                   common.end());
    }
    return common;
  }


  void
  Animation::write(std::ostream              &out,
                   const std::string         &title,
                   const PictureParameters   &parameters,
                   const AnimationParameters &animation,
                   const LastFrame           &last) const
  {
    animation.check();
    AssertThrow(!records.empty(),
                InputError("no frames", "the moving picture", "add one"));
    std::vector<Record> all = records, chosen;
    if (last.second != nullptr && last.first > all.back().time)
      all.push_back({last.first, 0, last.second});
    const std::size_t n_shown =
      std::min<std::size_t>(all.size(), animation.max_frames);
    for (std::size_t k = 0; k < n_shown; ++k)
      chosen.push_back(
        all[k * (all.size() - 1) / std::max<std::size_t>(1, n_shown - 1)]);

    double scale = parameters.deformation_scale;
    if (scale < 0.)
    {
      PictureExtents at_rest;
      for (const Record &record : chosen)
        at_rest.add(read(record), 0.);
      const auto [lower, upper] = at_rest.view();
      scale = choose_deformation_scale(at_rest.largest_displacement(),
                                       lower.distance(upper),
                                       animation.smallest_hole);
    }
    std::vector<Quantity> quantities = {parameters.quantity};
    for (const Quantity quantity :
         common_quantities(chosen, parameters.animation_quantities))
      quantities.push_back(quantity);
    // The values of the first quantity are in the triangles themselves, the others in layers.
    std::vector<PictureExtents> extents(quantities.size());
    for (const Record &record : chosen)
    {
      PictureData data = read(record);
      for (std::size_t q = 0; q < quantities.size(); ++q)
      {
        if (q > 0)
          choose_layer(quantities[q], data);
        extents[q].add(data, scale);
      }
    }
    std::vector<PictureFrame>      frames(quantities.size());
    std::vector<PictureParameters> of_frames(quantities.size(), parameters);
    std::vector<std::string>       names;
    for (std::size_t q = 0; q < quantities.size(); ++q)
    {
      frames[q].view = animation.view ? *animation.view : extents[q].view(0.01);
      frames[q].bar_scale        = extents[q].largest_traction();
      of_frames[q].quantity      = quantities[q];
      of_frames[q].picture_width = animation.width;
      names.push_back(to_string(quantities[q]));
      if (q == 0 && animation.range)
        frames[q].range = animation.range;
      else if (q > 0 || !(parameters.range_min < parameters.range_max))
        frames[q].range = extents[q].range();
    }

    const TimeText text(chosen.front().time, chosen.back().time, chosen.size());
    AnimationPage  page(out, title, names);
    for (const Record &record : chosen)
    {
      PictureData data               = read(record);
      data.deformation_scale         = scale;
      const std::string        label = text(record.time, animation);
      std::vector<std::string> pictures, own_pictures;
      for (std::size_t q = 0; q < quantities.size(); ++q)
      {
        if (q > 0)
          choose_layer(quantities[q], data);
        frames[q].note       = label;
        const bool has_range = q == 0 && animation.range;
        const auto draw      = [&](const PictureFrame &frame) {
          return draw_picture_in_memory(
            data, of_frames[q], title, frame, animation.n_colours);
        };
        pictures.push_back(draw(frames[q]));
        own_pictures.push_back(draw(own_frame(data, frames[q], has_range)));
        if (own_pictures.back() == pictures.back())
          own_pictures.back().clear();
      }
      page.add_frame(record.time, label, pictures, own_pictures);
    }
    out << "</body>\n</html>\n";
  }


  void
  Animation::discard()
  {
    rows.reset();
    std::filesystem::remove(file_name);
    records.clear();
  }
} // namespace NMM
