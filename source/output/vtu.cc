#include <nmm/output/vtu.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <output/double_points.h>
#include <regex>
#include <sstream>
#include <tuple>

namespace NMM
{
  namespace DataOutBase = dealii::DataOutBase;
  namespace Parallel    = dealii::Utilities::MPI;

  namespace
  {
    /// Removes comments from an XML text. Those of deal.II contain the date, so that the files of
    /// equal runs would differ.
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

    /// Names of the fields in the file; velocity and plastic strain come last, if there are any.
    std::vector<std::string>
    field_names(const FieldTriangles &triangles)
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
      if (triangles.has_velocity)
        names.insert(names.end(), 2, "velocity");
      if (triangles.has_plastic_strain)
        names.emplace_back("plastic_strain");
      return names;
    }


    /// Finds the vector fields: two neighbours with the same name are the components of a vector.
    VectorRanges
    vector_ranges(const std::vector<std::string> &names)
    {
      VectorRanges ranges;
      for (unsigned int f = 0; f + 1 < names.size(); ++f)
        if (names[f] == names[f + 1])
          ranges.emplace_back(
            f,
            f + 1,
            names[f],
            dealii::DataComponentInterpretation::component_is_part_of_vector);
      return ranges;
    }


    /// Makes a patch of each triangle: the fields at its nodes, in the order of field_names(), and
    /// then the positions of the nodes.
    std::vector<DataOutBase::Patch<2, 2>>
    make_patches(const CoverSystem &covers, const FieldTriangles &triangles)
    {
      const unsigned int rank =
        Parallel::this_mpi_process(covers.communicator());
      const unsigned int n_rows = field_names(triangles).size() + 2;
      std::vector<DataOutBase::Patch<2, 2>> patches(triangles.nodes.size());
      for (unsigned int t = 0; t < patches.size(); ++t)
      {
        DataOutBase::Patch<2, 2> &patch = patches[t];
        patch.reference_cell            = dealii::ReferenceCells::Triangle;
        patch.patch_index               = t;
        patch.points_are_available      = true;
        patch.data.reinit(n_rows, 6);
        const ElementIds ids =
          element_ids(covers.manifold_mesh(), triangles.elements[t]);
        for (unsigned int i = 0; i < 6; ++i)
        {
          const FieldSample &sample    = triangles.samples[t][i];
          const auto         principal = principal_stresses(sample.recovered);
          unsigned int       row       = 0;
          const auto         add       = [&](const double value) {
            patch.data(row++, i) = static_cast<float>(value);
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
          if (triangles.has_plastic_strain)
            add(sample.plastic_strain);
          for (unsigned int d = 0; d < 2; ++d)
            add(triangles.nodes[t][i][d]);
          AssertDimension(row, n_rows);
        }
      }
      return patches;
    }
  } // namespace


  std::string
  write_fields_of_state(const CoverSystem     &covers,
                        const FieldTriangles  &triangles,
                        const OutputDirectory &directory,
                        const std::string     &base)
  {
    const MPI_Comm        communicator = covers.communicator();
    const unsigned int    rank    = Parallel::this_mpi_process(communicator);
    const unsigned int    n_ranks = Parallel::n_mpi_processes(communicator);
    const auto            names   = field_names(triangles);
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    // The enumeration has another name from deal.II 9.5 on, so its type is deduced.
    flags.compression_level = decltype(flags.compression_level)::no_compression;

    const auto piece_name = [&](const unsigned int r) {
      return n_ranks == 1 ? base + ".vtu"
                          : base + "." + std::to_string(r) + ".vtu";
    };
    directory.write_text(piece_name(rank), [&](std::ostream &out) {
      std::ostringstream text;
      DataOutBase::write_vtu(make_patches(covers, triangles),
                             names,
                             vector_ranges(names),
                             flags,
                             text);
      std::vector<dealii::Point<2>> points;
      for (const QuadraticTriangle &triangle : triangles.nodes)
        points.insert(points.end(), triangle.begin(), triangle.end());
      out << internal::with_double_points(text.str(), points);
    });
    if (n_ranks == 1)
      return piece_name(0);

    if (rank == 0)
      directory.write_text(base + ".pvtu", [&](std::ostream &out) {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_ranks; ++r)
          pieces.push_back(piece_name(r));
        std::ostringstream text;
        DataOutBase::write_pvtu_record(
          text, pieces, names, vector_ranges(names), flags);
        out << internal::with_double_points(without_comments(text.str()));
      });
    return base + ".pvtu";
  }


  FileSeries::FileSeries(const OutputDirectory &directory, std::string base)
    : directory(&directory)
    , base(std::move(base))
  {
  }


  void
  FileSeries::resume(const double last)
  {
    std::ifstream    in(directory->path() / (base + ".pvd"));
    const std::regex entry("timestep=\"([^\"]*)\".*file=\"(" + base +
                           "-[^\"]*)\"");
    std::smatch      match;
    states.clear();
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, entry) && std::stod(match[1]) <= last)
        states.emplace_back(std::stod(match[1]), match[2]);
    if (!states.empty())
      write_list();
  }


  void
  FileSeries::add(const double value, const std::string &file)
  {
    states.emplace_back(value, file);
    write_list();
  }


  void
  FileSeries::finish(const double value, const std::string &file)
  {
    if (!has(value))
      states.emplace_back(value, file);
    write_list();
  }


  bool
  FileSeries::has(const double value) const
  {
    return std::any_of(states.begin(), states.end(), [&](const auto &state) {
      return std::abs(state.first - value) <= 1e-9 * std::abs(value);
    });
  }


  void
  FileSeries::write_list() const
  {
    directory->write_text(base + ".pvd", [&](std::ostream &out) {
      std::ostringstream text;
      text.precision(12);
      DataOutBase::write_pvd_record(text, states);
      out << without_comments(text.str());
    });
  }
} // namespace NMM
