#include <nmm/base/program.h>
#include <nmm/output/animation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using Vertex = PictureData::Vertex;

    constexpr char         frame_magic[]     = "NMMfram3";
    constexpr std::size_t  frame_magic_size  = 8;
    constexpr std::size_t  frame_header_size = frame_magic_size + 2 * 8;
    constexpr unsigned int max_places        = 12;


    /// Numbers one after the other in native byte order.
    class Packer
    {
    public:
      template <typename T>
      void
      add(const T value)
      {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        buffer.append(bytes, sizeof(T));
      }

      std::string buffer;
    };


    class Unpacker
    {
    public:
      explicit Unpacker(const std::string &buffer)
        : buffer(&buffer)
      {
      }

      template <typename T>
      T
      get()
      {
        AssertThrow(position + sizeof(T) <= buffer->size(),
                    InputError("a damaged frame",
                               "the file of a moving picture's frames",
                               "remove the file and run again"));
        T value;
        std::memcpy(&value, buffer->data() + position, sizeof(T));
        position += sizeof(T);
        return value;
      }

    private:
      const std::string *buffer;
      std::size_t        position = 0;
    };


    /// The place relative to @p origin, so that single precision will do.
    void
    add(Packer &packer, const Vertex &vertex, const Point<2> &origin)
    {
      for (unsigned int d = 0; d < 2; ++d)
        packer.add(static_cast<float>(vertex.position[d] - origin[d]));
      for (unsigned int d = 0; d < 2; ++d)
        packer.add(static_cast<float>(vertex.displacement[d]));
    }


    Vertex
    get_vertex(Unpacker &unpacker, const Point<2> &origin)
    {
      Vertex vertex;
      for (unsigned int d = 0; d < 2; ++d)
        vertex.position[d] = origin[d] + unpacker.get<float>();
      for (unsigned int d = 0; d < 2; ++d)
        vertex.displacement[d] = unpacker.get<float>();
      return vertex;
    }


    std::string
    pack(const PictureData &data)
    {
      const Point<2> origin = data.triangles.empty()
                                ? Point<2>()
                                : data.triangles[0].vertices[0].position;
      Packer         packer;
      packer.add(origin[0]);
      packer.add(origin[1]);
      packer.add(static_cast<std::uint64_t>(data.triangles.size()));
      for (const PictureData::Triangle &triangle : data.triangles)
        for (unsigned int i = 0; i < 6; ++i)
        {
          add(packer, triangle.vertices[i], origin);
          packer.add(static_cast<float>(triangle.values[i]));
        }
      for (const auto *lines : {&data.outlines,
                                &data.interfaces,
                                &data.mesh_lines,
                                &data.obstacles})
      {
        packer.add(static_cast<std::uint64_t>(lines->size()));
        for (const PictureData::Polyline &line : *lines)
        {
          packer.add(static_cast<std::uint32_t>(line.size()));
          for (const Vertex &vertex : line)
            add(packer, vertex, origin);
        }
      }
      packer.add(static_cast<std::uint64_t>(data.contacts.size()));
      for (const PictureData::Bar &bar : data.contacts)
      {
        add(packer, bar.foot, origin);
        for (unsigned int d = 0; d < 2; ++d)
          packer.add(static_cast<float>(bar.traction[d]));
        packer.add(static_cast<std::uint32_t>(bar.kind));
      }
      packer.add(static_cast<std::uint64_t>(data.layers.size()));
      for (const PictureData::Layer &layer : data.layers)
      {
        packer.add(static_cast<std::uint32_t>(layer.quantity));
        for (const auto &values : layer.values)
          for (const double value : values)
            packer.add(static_cast<float>(value));
      }
      return packer.buffer;
    }


    PictureData
    unpack(const std::string &buffer)
    {
      Unpacker       unpacker(buffer);
      PictureData    data;
      const double   x = unpacker.get<double>(), y = unpacker.get<double>();
      const Point<2> origin(x, y);
      for (auto n = unpacker.get<std::uint64_t>(); n > 0; --n)
      {
        PictureData::Triangle triangle;
        for (unsigned int i = 0; i < 6; ++i)
        {
          triangle.vertices[i] = get_vertex(unpacker, origin);
          triangle.values[i]   = unpacker.get<float>();
        }
        data.triangles.push_back(triangle);
      }
      for (auto *lines : {&data.outlines,
                          &data.interfaces,
                          &data.mesh_lines,
                          &data.obstacles})
        for (auto n = unpacker.get<std::uint64_t>(); n > 0; --n)
        {
          lines->emplace_back();
          for (auto k = unpacker.get<std::uint32_t>(); k > 0; --k)
            lines->back().push_back(get_vertex(unpacker, origin));
        }
      for (auto n = unpacker.get<std::uint64_t>(); n > 0; --n)
      {
        PictureData::Bar bar;
        bar.foot = get_vertex(unpacker, origin);
        for (unsigned int d = 0; d < 2; ++d)
          bar.traction[d] = unpacker.get<float>();
        bar.kind =
          static_cast<PictureData::Bar::Kind>(unpacker.get<std::uint32_t>());
        data.contacts.push_back(bar);
      }
      for (auto n = unpacker.get<std::uint64_t>(); n > 0; --n)
      {
        PictureData::Layer layer;
        layer.quantity = static_cast<Quantity>(unpacker.get<std::uint32_t>());
        layer.values.resize(data.triangles.size());
        for (auto &values : layer.values)
          for (double &value : values)
            value = unpacker.get<float>();
        data.layers.push_back(std::move(layer));
      }
      return data;
    }


    /// Put the values of @p quantity into the triangles, if they are in a layer.
    void
    choose_layer(const Quantity quantity, PictureData &data)
    {
      for (const PictureData::Layer &layer : data.layers)
        if (layer.quantity == quantity)
          for (std::size_t t = 0; t < data.triangles.size(); ++t)
            data.triangles[t].values = layer.values[t];
    }


    /// In the range of the picture's own values, unless a range @p is_given or that
    /// of @p frame is not known (then the picture's parameters have one), and of its
    /// own bars. What the single precision of frames cannot tell from a constant, or
    /// from nothing, stays as it is.
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


    /// Writes times with as many places as tell neighbours from each other.
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
    find_records(keep_until);
    // makes the file if there is none
    std::ofstream file(file_name, std::ios::binary | std::ios::app);
    AssertThrow(file.good(), OutputFailure(file_name));
    file.close();
    std::filesystem::resize_file(file_name, static_cast<std::uintmax_t>(end));
  }


  void
  Animation::find_records(const double keep_until)
  {
    std::ifstream file(file_name, std::ios::binary | std::ios::ate);
    if (!file.good())
      return;
    const std::streamoff size = file.tellg();
    std::string          header(frame_header_size, '\0');
    while (end + static_cast<std::streamoff>(frame_header_size) <= size)
    {
      file.seekg(end);
      file.read(header.data(), frame_header_size);
      if (!file.good() || header.compare(0, frame_magic_size, frame_magic) != 0)
        break;
      Record record;
      std::memcpy(&record.time, header.data() + frame_magic_size, 8);
      std::memcpy(&record.n_bytes, header.data() + frame_magic_size + 8, 8);
      record.position = end + static_cast<std::streamoff>(frame_header_size);
      if (!(record.time <= keep_until) ||
          record.n_bytes > static_cast<std::uint64_t>(size - record.position))
        break;
      records.push_back(record);
      end = record.position + static_cast<std::streamoff>(record.n_bytes);
    }
  }


  void
  Animation::add_frame(const double time, const PictureData &data)
  {
    AssertThrow(records.empty() || time >= records.back().time,
                InputError("a frame of an earlier time",
                           "the moving picture",
                           "add frames in the order of their times"));
    const std::string body = pack(data);
    Packer            header;
    header.buffer.assign(frame_magic, frame_magic_size);
    header.add(time);
    header.add(static_cast<std::uint64_t>(body.size()));

    std::ofstream file(file_name, std::ios::binary | std::ios::app);
    file.write(header.buffer.data(),
               static_cast<std::streamsize>(header.buffer.size()));
    file.write(body.data(), static_cast<std::streamsize>(body.size()));
    file.close();
    AssertThrow(file.good(), OutputFailure(file_name));
    records.push_back({time,
                       end + static_cast<std::streamoff>(header.buffer.size()),
                       body.size()});
    end = records.back().position + static_cast<std::streamoff>(body.size());
  }


  unsigned int
  Animation::n_frames() const
  {
    return records.size();
  }


  double
  Animation::last_time() const
  {
    return records.back().time;
  }


  void
  Animation::remove_last_frame()
  {
    end =
      records.back().position - static_cast<std::streamoff>(frame_header_size);
    records.pop_back();
    std::filesystem::resize_file(file_name, static_cast<std::uintmax_t>(end));
  }


  PictureData
  Animation::read(const Record &record) const
  {
    std::ifstream file(file_name, std::ios::binary);
    std::string   buffer(record.n_bytes, '\0');
    file.seekg(record.position);
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    AssertThrow(file.good(),
                InputError("the file '" + file_name + "' cannot be read",
                           "the moving picture",
                           "leave it in its place while the analysis runs"));
    return unpack(buffer);
  }


  std::vector<Animation::Record>
  Animation::chosen_records(const unsigned int max_frames) const
  {
    if (records.size() <= max_frames)
      return records;
    std::vector<Record> chosen;
    for (std::size_t k = 0; k < max_frames; ++k)
      chosen.push_back(records[k * (records.size() - 1) / (max_frames - 1)]);
    return chosen;
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
                   const OutputParameters    &parameters,
                   const AnimationParameters &animation) const
  {
    animation.check();
    AssertThrow(!records.empty(),
                InputError("no frames", "the moving picture", "add one"));
    const std::vector<Record> chosen = chosen_records(animation.max_frames);

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
    // the first one's values are the triangles' own
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
    std::vector<PictureFrame>     frames(quantities.size());
    std::vector<OutputParameters> of_frames(quantities.size(), parameters);
    std::vector<std::string>      names;
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
    std::filesystem::remove(file_name);
    records.clear();
  }
} // namespace NMM
