#include <nmm/output/contact_output.h>
#include <nmm/output/csv_series.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <regex>
#include <sstream>
#include <tuple>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  namespace
  {
    constexpr const char *table_name = "contacts.csv";

    MPI_Comm
    communicator(const ContactSurface &surface)
    {
      return surface.cover_system().communicator();
    }


    Tensor<1, 2>
    traction_of(const double        pressure,
                const double        shear,
                const Tensor<1, 2> &normal)
    {
      return pressure * normal - shear * Point<2>(-normal[1], normal[0]);
    }


    /// Number of doubles in which a sample is sent between ranks.
    constexpr unsigned int n_packed = 15;


    template <typename Value>
    void
    write_array(std::ostream                     &out,
                const std::string                &name,
                const unsigned int                n_components,
                const std::vector<ContactSample> &points,
                const Value                      &value)
    {
      out << "<DataArray type=\"Float64\" Name=\"" << name
          << "\" NumberOfComponents=\"" << n_components
          << "\" format=\"ascii\">\n";
      for (const ContactSample &point : points)
      {
        value(point);
        out << '\n';
      }
      out << "</DataArray>\n";
    }
  } // namespace


  Tensor<1, 2>
  ContactSample::traction() const
  {
    return traction_of(pressure, shear, normal);
  }


  const std::string &
  to_string(const ContactState state)
  {
    static const std::string words[] = {"open", "stick", "slip"};
    return words[static_cast<unsigned int>(state)];
  }


  std::vector<ContactSample>
  gather_contact_points(const ContactSurface            &surface,
                        const std::vector<ContactPoint> &points)
  {
    std::vector<double> mine;
    for (const ContactPoint &point : points)
      if (point.master != invalid_index && point.weight != 0.)
      {
        const Point<2> X = surface.reference_place(point.edge, point.s).x;
        mine.insert(mine.end(),
                    {X[0],
                     X[1],
                     point.x[0],
                     point.x[1],
                     point.normal[0],
                     point.normal[1],
                     double(point.edge),
                     double(point.master),
                     point.gap,
                     point.pressure,
                     point.shear,
                     // the weight of an open point has no effect, and may
                     // differ in a run that was continued
                     point.state == ContactState::open ? 0. : point.weight,
                     double(static_cast<unsigned int>(point.state)),
                     double(point.is_bonded),
                     point.s});
      }
    const auto all = Parallel::gather(communicator(surface), mine);
    std::vector<ContactSample> result;
    for (const std::vector<double> &part : all)
      for (auto v = part.begin(); v != part.end(); v += n_packed)
      {
        ContactSample point;
        point.reference = Point<2>(v[0], v[1]);
        point.x         = Point<2>(v[2], v[3]);
        point.normal    = Point<2>(v[4], v[5]);
        point.slave     = static_cast<unsigned int>(v[6]);
        point.master    = static_cast<unsigned int>(v[7]);
        point.gap       = v[8];
        point.pressure  = v[9];
        point.shear     = v[10];
        point.weight    = v[11];
        point.state     = static_cast<ContactState>(static_cast<int>(v[12]));
        point.is_bonded = v[13] != 0.;
        point.s         = v[14];
        result.push_back(point);
      }
    std::stable_sort(result.begin(),
                     result.end(),
                     [](const ContactSample &a, const ContactSample &b) {
                       return std::tie(a.slave, a.s, a.master) <
                              std::tie(b.slave, b.s, b.master);
                     });
    return result;
  }


  void
  add_contact(const ContactSurface             &surface,
              const std::vector<ContactSample> &points,
              PictureData                      &data,
              const double                      least)
  {
    const unsigned int first = surface.n_bodies() - surface.obstacles().size();
    for (unsigned int e = 0; e < surface.edges().size(); ++e)
      if (surface.is_rigid(e) && !surface.is_absent(e))
      {
        const ContactSurface::Edge &edge = surface.edges()[e];
        const Tensor<1, 2>         &shift =
          surface.obstacle_displacement(edge.body - first);
        const double sweep = edge.last_angle - edge.first_angle;
        const auto   n     = 1 + static_cast<unsigned int>(
                             edge.radius == 0. ? 0. : std::abs(sweep) / 0.05);
        PictureData::Polyline line;
        for (unsigned int i = 0; i <= n; ++i)
          line.push_back({surface.reference_place(e, double(i) / n).x, shift});
        data.obstacles.push_back(line);
      }
    for (const ContactSample &point : points)
      if (point.state != ContactState::open && point.traction().norm() >= least)
        // If the slave is a corner of an obstacle, the force on the solid is the opposite one.
        data.contacts.push_back(
          {{point.reference, point.x - point.reference},
           (surface.is_rigid(point.slave) ? -1. : 1.) * point.traction(),
           point.is_bonded                     ? PictureData::Bar::bonded
           : point.state == ContactState::slip ? PictureData::Bar::slips
                                               : PictureData::Bar::sticks});
  }


  void
  ContactSeries::follow(const ContactSurface &new_surface)
  {
    surface = &new_surface;
  }


  ContactSeries::ContactSeries(const ContactSurface  &surface,
                               const OutputDirectory &directory,
                               std::string            value_name,
                               const bool             with_table,
                               const bool             with_fields)
    : surface(&surface)
    , directory(&directory)
    , value_name(std::move(value_name))
    , with_table(with_table)
    , with_fields(with_fields)
    , files(directory, "contacts")
  {
  }


  std::string
  ContactSeries::header() const
  {
    return value_name +
           ",x,y,reference_x,reference_y,slave,master,gap,pressure,shear,"
           "state,weight,bonded\n";
  }


  void
  ContactSeries::resume(const double last)
  {
    files.resume(last);
    written.clear();
    const auto path = directory->path() / table_name;
    if (!with_table || !std::filesystem::exists(path))
      return;
    table.emplace(path.string(), header(), [&](const std::string &row) {
      const double value = std::strtod(row.c_str(), nullptr);
      // The final state of the earlier run is not a state of the series, so it has no file.
      if (value > last || (with_fields && !files.has(value)))
        return false;
      if (written.empty() || written.back() != value)
        written.push_back(value);
      return true;
    });
  }


  void
  ContactSeries::append_rows(const double                      value,
                             const std::vector<ContactSample> &points)
  {
    if (!with_table || (!written.empty() && written.back() == value))
      return;
    if (!table)
      table.emplace(directory->file(table_name), header());
    written.push_back(value);
    std::ostringstream rows;
    rows << std::setprecision(12);
    for (const ContactSample &point : points)
      rows << value << ',' << point.x[0] << ',' << point.x[1] << ','
           << point.reference[0] << ',' << point.reference[1] << ','
           << quoted(surface->name(point.slave)) << ','
           << quoted(surface->name(point.master)) << ',' << point.gap << ','
           << point.pressure << ',' << point.shear << ','
           << to_string(point.state) << ',' << point.weight << ','
           << point.is_bonded << '\n';
    table->append(rows.str());
  }


  void
  ContactSeries::write_points(const std::string                &name,
                              const std::vector<ContactSample> &points) const
  {
    directory->write_text(name, [&](std::ostream &out) {
      out << std::setprecision(12)
          << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" "
             "version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n<Piece "
             "NumberOfPoints=\""
          << points.size() << "\" NumberOfVerts=\"" << points.size()
          << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
             "NumberOfPolys=\"0\">\n<Points>\n";
      using Sample = ContactSample;
      write_array(out, "Points", 3, points, [&](const Sample &point) {
        out << point.x[0] << ' ' << point.x[1] << " 0";
      });
      out << "</Points>\n<Verts>\n";
      for (const bool is_offset : {false, true})
      {
        out << "<DataArray type=\"Int64\" Name=\""
            << (is_offset ? "offsets" : "connectivity")
            << "\" format=\"ascii\">\n";
        for (std::size_t i = 0; i < points.size(); ++i)
          out << i + (is_offset ? 1 : 0) << '\n';
        out << "</DataArray>\n";
      }
      out << "</Verts>\n<PointData Scalars=\"pressure\" "
             "Vectors=\"traction\">\n";
      const auto scalar = [&](const std::string &field, const auto &value) {
        write_array(out, field, 1, points, [&](const Sample &point) {
          out << value(point);
        });
      };
      scalar("pressure", [](const Sample &point) { return point.pressure; });
      scalar("shear", [](const Sample &point) { return point.shear; });
      scalar("gap", [](const Sample &point) { return point.gap; });
      scalar("state", [](const Sample &point) {
        return static_cast<unsigned int>(point.state);
      });
      scalar("bonded", [](const Sample &point) { return point.is_bonded; });
      scalar("weight", [](const Sample &point) { return point.weight; });
      for (const bool is_traction : {true, false})
        write_array(out,
                    is_traction ? "traction" : "displacement",
                    3,
                    points,
                    [&](const Sample &point) {
                      const Tensor<1, 2> value = is_traction
                                                   ? point.traction()
                                                   : point.x - point.reference;
                      out << value[0] << ' ' << value[1] << " 0";
                    });
      out << "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    });
  }


  void
  ContactSeries::write(const double                      value,
                       const std::string                &base,
                       const std::vector<ContactSample> &points)
  {
    append_rows(value, points);
    if (!with_fields)
      return;
    write_points(base + ".vtp", points);
    files.add(value, base + ".vtp");
  }


  void
  ContactSeries::finish(const double                      value,
                        const std::vector<ContactSample> &points)
  {
    append_rows(value, points);
    if (!with_fields)
      return;
    write_points("contacts.vtp", points);
    files.finish(value, "contacts.vtp");
  }
} // namespace NMM
