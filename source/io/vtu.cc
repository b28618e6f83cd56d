#include <nmm/base/compat.h>
#include <nmm/io/vtu.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/reference_cell.h>

#include <tuple>

namespace NMM
{
  namespace
  {
    using Patch = dealii::DataOutBase::Patch<2, 2>;

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


    std::vector<Patch>
    make_patches(const CoverSystem &covers, const FieldTriangles &triangles)
    {
      const ManifoldMesh &mesh   = covers.manifold_mesh();
      const unsigned int  n_rows = field_names(triangles.has_velocity).size();
      const unsigned int  rank =
        dealii::Utilities::MPI::this_mpi_process(covers.communicator());

      std::vector<Patch> patches(triangles.nodes.size());
      for (unsigned int t = 0; t < patches.size(); ++t)
      {
        Patch &patch               = patches[t];
        patch.reference_cell       = dealii::ReferenceCells::Triangle;
        patch.patch_index          = t;
        patch.n_subdivisions       = 2;
        patch.points_are_available = true;
        patch.data.reinit(n_rows + 2, 6);
        const ElementIds ids = element_ids(mesh, triangles.elements[t]);
        for (unsigned int i = 0; i < 6; ++i)
        {
          const FieldSample &sample    = triangles.samples[t][i];
          const auto         principal = principal_stresses(sample.recovered);
          unsigned int       row       = 0;
          const auto         add       = [&](const double value) {
            patch.data(row++, i) = value;
          };
          for (const double value : {sample.displacement[0],
                                     sample.displacement[1],
                                     sample.direct.in_plane[0][0],
                                     sample.direct.in_plane[1][1],
                                     sample.direct.in_plane[0][1],
                                     sample.direct.zz,
                                     sample.recovered.in_plane[0][0],
                                     sample.recovered.in_plane[1][1],
                                     sample.recovered.in_plane[0][1],
                                     sample.recovered.zz,
                                     von_mises_stress(sample.recovered),
                                     principal[0],
                                     principal[1],
                                     static_cast<double>(ids.block),
                                     static_cast<double>(ids.region),
                                     static_cast<double>(ids.material),
                                     static_cast<double>(rank)})
            add(value);
          for (unsigned int d = 0; d < 2 && triangles.has_velocity; ++d)
            add(sample.velocity[d]);
          for (unsigned int d = 0; d < 2; ++d)
            add(triangles.nodes[t][i][d]);
          AssertDimension(row, n_rows + 2);
        }
        for (unsigned int i = 0; i < 3; ++i)
          patch.vertices[i] = triangles.nodes[t][i];
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
    const MPI_Comm     communicator = covers.communicator();
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);

    dealii::DataOutBase::VtkFlags flags;
    Compat::set_fast_compression(flags);
    flags.write_higher_order_cells = true;

    const auto piece_name = [&](const unsigned int r) {
      return n_ranks == 1 ? base + ".vtu"
                          : base + "." + std::to_string(r) + ".vtu";
    };
    directory.write_text(piece_name(rank), [&](std::ostream &out) {
      dealii::DataOutBase::write_vtu(make_patches(covers, triangles),
                                     field_names(triangles.has_velocity),
                                     vector_ranges(triangles.has_velocity),
                                     flags,
                                     out);
    });
    if (n_ranks == 1)
      return piece_name(0);

    if (rank == 0)
      directory.write_text(base + ".pvtu", [&](std::ostream &out) {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_ranks; ++r)
          pieces.push_back(piece_name(r));
        dealii::DataOutBase::write_pvtu_record(
          out,
          pieces,
          field_names(triangles.has_velocity),
          vector_ranges(triangles.has_velocity),
          flags);
      });
    return base + ".pvtu";
  }


  void
  write_series(const std::vector<std::pair<double, std::string>> &states,
               const OutputDirectory                             &directory)
  {
    directory.write_text("fields.pvd", [&](std::ostream &out) {
      out.precision(12);
      dealii::DataOutBase::write_pvd_record(out, states);
    });
  }

} // namespace NMM
