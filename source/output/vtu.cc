#include <nmm/output/vtu.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <cstdint>
#include <numeric>
#include <output/vtu_array.h>
#include <regex>
#include <sstream>
#include <tuple>

namespace NMM
{
  namespace
  {
    /// deal.II's have the date, by which the files of equal runs would differ.
    std::string
    without_comments(const std::string &text)
    {
      return std::regex_replace(text, std::regex("<!--[^>]*-->\\s*"), "");
    }


    using VectorRanges = std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>;

    /// Velocities come last, if there are any.
    std::vector<std::string>
    field_names(const bool has_velocity)
    {
      std::vector<std::string> names = {"displacement",
                                        "displacement",
                                        "direct_stress_xx",
                                        "direct_stress_yy",
                                        "direct_stress_xy",
                                        "direct_stress_zz",
                                        "recovered_stress_xx",
                                        "recovered_stress_yy",
                                        "recovered_stress_xy",
                                        "recovered_stress_zz",
                                        "von_mises_stress",
                                        "first_principal_stress",
                                        "second_principal_stress",
                                        "block",
                                        "region",
                                        "material",
                                        "rank"};
      if (has_velocity)
        names.insert(names.end(), 2, "velocity");
      return names;
    }


    VectorRanges
    vector_ranges(const bool has_velocity)
    {
      const auto vector = [](const unsigned int first, const char *name) {
        return std::make_tuple(
          first,
          first + 1,
          std::string(name),
          dealii::DataComponentInterpretation::component_is_part_of_vector);
      };
      VectorRanges ranges = {vector(0, "displacement")};
      if (has_velocity)
        ranges.push_back(
          vector(field_names(has_velocity).size() - 2, "velocity"));
      return ranges;
    }


    /// Fields at the nodes of all triangles, one after the other, in the order of
    /// field_names().
    std::vector<std::vector<float>>
    tabulate(const CoverSystem &covers, const FieldTriangles &triangles)
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      const std::size_t   n    = 6 * triangles.nodes.size();
      const auto          rank = static_cast<float>(
        dealii::Utilities::MPI::this_mpi_process(covers.communicator()));
      std::vector<std::vector<float>> fields(
        field_names(triangles.has_velocity).size(), std::vector<float>(n));
      for (std::size_t k = 0; k < n; ++k)
      {
        const FieldSample &sample = triangles.samples[k / 6][k % 6];
        const ElementIds   ids = element_ids(mesh, triangles.elements[k / 6]);
        const auto         principal = principal_stresses(sample.recovered);
        unsigned int       field     = 0;
        const auto         add       = [&](const double value) {
          fields[field++][k] = static_cast<float>(value);
        };
        add(sample.displacement[0]);
        add(sample.displacement[1]);
        for (const FieldSample::Stress *stress :
             {&sample.direct, &sample.recovered})
        {
          add(stress->in_plane[0][0]);
          add(stress->in_plane[1][1]);
          add(stress->in_plane[0][1]);
          add(stress->zz);
        }
        add(von_mises_stress(sample.recovered));
        add(principal[0]);
        add(principal[1]);
        add(ids.block);
        add(ids.region);
        add(ids.material);
        add(rank);
        for (unsigned int d = 0; d < 2 && triangles.has_velocity; ++d)
          add(sample.velocity[d]);
        AssertDimension(field, fields.size());
      }
      return fields;
    }


    /// VTK's vectors have three components.
    std::vector<float>
    make_vectors(const std::vector<float> &x, const std::vector<float> &y)
    {
      std::vector<float> vectors(3 * x.size(), 0.f);
      for (std::size_t k = 0; k < x.size(); ++k)
      {
        vectors[3 * k]     = x[k];
        vectors[3 * k + 1] = y[k];
      }
      return vectors;
    }


    void
    write_mesh(const std::vector<QuadraticTriangle> &triangles,
               internal::VtuArrayWriter             &arrays,
               std::ostream                         &out)
    {
      constexpr std::uint8_t lagrange_triangle = 69;
      const std::size_t      n                 = triangles.size();
      std::vector<float>     points(18 * n, 0.f);
      for (std::size_t t = 0; t < n; ++t)
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int d = 0; d < 2; ++d)
            points[18 * t + 3 * i + d] = static_cast<float>(triangles[t][i][d]);
      std::vector<std::int32_t> connectivity(6 * n), offsets(n);
      std::iota(connectivity.begin(), connectivity.end(), 0);
      for (std::size_t t = 0; t < n; ++t)
        offsets[t] = static_cast<std::int32_t>(6 * (t + 1));
      out << "  <Points>\n";
      arrays.write("Float32", "", 3, points);
      out << "  </Points>\n  <Cells>\n";
      arrays.write("Int32", "connectivity", 1, connectivity);
      arrays.write("Int32", "offsets", 1, offsets);
      arrays.write("UInt8",
                   "types",
                   1,
                   std::vector<std::uint8_t>(n, lagrange_triangle));
      out << "  </Cells>\n";
    }


    void
    write_piece(const CoverSystem    &covers,
                const FieldTriangles &triangles,
                std::ostream         &out)
    {
      internal::VtuArrayWriter arrays(out);
      const std::size_t        n = triangles.nodes.size();
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
             "version=\"0.1\" compressor=\"vtkZLibDataCompressor\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\""
          << 6 * n << "\" NumberOfCells=\"" << n << "\">\n";
      write_mesh(triangles.nodes, arrays, out);

      const auto names  = field_names(triangles.has_velocity);
      const auto fields = tabulate(covers, triangles);
      out << "  <PointData>\n";
      for (unsigned int f = 0; f < names.size(); ++f)
        if (f + 1 < names.size() && names[f] == names[f + 1])
        {
          arrays.write("Float32",
                       names[f],
                       3,
                       make_vectors(fields[f], fields[f + 1]));
          ++f;
        }
        else
          arrays.write("Float32", names[f], 1, fields[f]);
      out << "  </PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }
  } // namespace


  std::string
  write_fields_of_state(const CoverSystem     &covers,
                        const FieldTriangles  &triangles,
                        const OutputDirectory &directory,
                        const std::string     &base)
  {
    const MPI_Comm     communicator = covers.communicator();
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);

    const auto piece_name = [&](const unsigned int r) {
      return n_ranks == 1 ? base + ".vtu"
                          : base + "." + std::to_string(r) + ".vtu";
    };
    directory.write_text(piece_name(rank), [&](std::ostream &out) {
      write_piece(covers, triangles, out);
    });
    if (n_ranks == 1)
      return piece_name(0);

    if (rank == 0)
      directory.write_text(base + ".pvtu", [&](std::ostream &out) {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_ranks; ++r)
          pieces.push_back(piece_name(r));
        std::ostringstream text;
        dealii::DataOutBase::write_pvtu_record(
          text,
          pieces,
          field_names(triangles.has_velocity),
          vector_ranges(triangles.has_velocity),
          dealii::DataOutBase::VtkFlags());
        out << without_comments(text.str());
      });
    return base + ".pvtu";
  }


  void
  write_series(const std::vector<std::pair<double, std::string>> &states,
               const OutputDirectory                             &directory)
  {
    write_series(states, directory, "fields.pvd");
  }


  void
  write_series(const std::vector<std::pair<double, std::string>> &states,
               const OutputDirectory                             &directory,
               const std::string                                 &name)
  {
    directory.write_text(name, [&](std::ostream &out) {
      std::ostringstream text;
      text.precision(12);
      dealii::DataOutBase::write_pvd_record(text, states);
      out << without_comments(text.str());
    });
  }
} // namespace NMM
