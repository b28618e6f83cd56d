#include <nmm/base/exceptions.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/probes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace NMM
{
  namespace
  {
    /// Number of doubles of a FieldSample that are sent: displacement and stresses.
    constexpr unsigned int n_sample_numbers = 10;

    void
    pack(const FieldSample &sample, std::vector<double> &numbers)
    {
      numbers.push_back(sample.displacement[0]);
      numbers.push_back(sample.displacement[1]);
      for (const auto *stress : {&sample.direct, &sample.recovered})
        for (const double number : {stress->in_plane[0][0],
                                    stress->in_plane[1][1],
                                    stress->in_plane[0][1],
                                    stress->zz})
          numbers.push_back(number);
    }


    FieldSample
    unpack(const double *numbers)
    {
      FieldSample sample;
      sample.displacement[0] = *numbers++;
      sample.displacement[1] = *numbers++;
      for (auto *stress : {&sample.direct, &sample.recovered})
      {
        stress->in_plane[0][0] = *numbers++;
        stress->in_plane[1][1] = *numbers++;
        stress->in_plane[0][1] = *numbers++;
        stress->zz             = *numbers++;
      }
      return sample;
    }


    unsigned int
    find_element_nearby(const ManifoldMesh     &mesh,
                        const dealii::Point<2> &x,
                        const double            tolerance)
    {
      unsigned int element = mesh.find_element(x);
      for (unsigned int k = 0; k < 8 && element == invalid_index; ++k)
      {
        const double angle = k * dealii::numbers::PI_4;
        element            = mesh.find_element(
          x +
          tolerance * dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
      }
      return element;
    }
  } // namespace


  ProbePoints::ProbePoints(const ManifoldMesh       &mesh,
                           const std::vector<Probe> &probes)
  {
    const auto &box = mesh.physical_mesh().bounding_box().get_boundary_points();
    const double tolerance = 1e-9 * box.first.distance(box.second);

    for (const Probe &probe : probes)
    {
      const unsigned int n      = probe.is_line ? probe.n_points : 1;
      unsigned int       inside = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double t = n > 1 ? static_cast<double>(i) / (n - 1) : 0.;
        Entry        entry;
        entry.probe = names.size();
        entry.index = i;
        entry.x     = probe.is_line ? probe.from + t * (probe.to - probe.from)
                                    : probe.point;
        entry.distance = probe.is_line ? entry.x.distance(probe.from) : 0.;
        entry.element  = find_element_nearby(mesh, entry.x, tolerance);
        inside += (entry.element != invalid_index);
        all_entries.push_back(entry);
      }
      AssertThrow(inside > 0,
                  InputError(probe.is_line
                               ? "no point of the line of probe '" +
                                   probe.name + "' lies in the solid"
                               : "probe '" + probe.name +
                                   "' lies outside the solid",
                             probe.is_line ? to_string(probe.from) + " to " +
                                               to_string(probe.to)
                                           : to_string(probe.point),
                             "move it into the solid or remove it"));
      names.push_back(probe.name);
    }
  }


  const std::vector<ProbePoints::Entry> &
  ProbePoints::entries() const
  {
    return all_entries;
  }


  std::vector<std::optional<FieldSample>>
  ProbePoints::evaluate(const CoverSystem    &covers,
                        const FieldEvaluator &evaluator) const
  {
    const auto [first, last] = covers.locally_owned_elements();
    std::vector<unsigned int> indices;
    std::vector<double>       numbers;
    for (unsigned int i = 0; i < all_entries.size(); ++i)
    {
      const Entry &entry = all_entries[i];
      if (entry.element >= first && entry.element < last &&
          evaluator.shows(entry.element))
      {
        indices.push_back(i);
        pack(evaluator(entry.element, entry.x), numbers);
      }
    }

    const auto all_indices =
      dealii::Utilities::MPI::gather(covers.communicator(), indices);
    const auto all_numbers =
      dealii::Utilities::MPI::gather(covers.communicator(), numbers);
    std::vector<std::optional<FieldSample>> samples(all_entries.size());
    for (unsigned int rank = 0; rank < all_indices.size(); ++rank)
      for (unsigned int k = 0; k < all_indices[rank].size(); ++k)
        samples[all_indices[rank][k]] =
          unpack(all_numbers[rank].data() + n_sample_numbers * k);
    return samples;
  }


  void
  ProbePoints::write(
    std::ostream                                  &out,
    const std::vector<std::optional<FieldSample>> &samples) const
  {
    out << "probe,point,distance,x,y,inside,displacement_x,displacement_y";
    for (const char *kind : {"direct", "recovered"})
      for (const char *component : {"xx", "yy", "xy", "zz"})
        out << ',' << kind << "_stress_" << component;
    out << '\n' << std::setprecision(12);

    for (unsigned int i = 0; i < all_entries.size(); ++i)
    {
      const Entry        &entry = all_entries[i];
      std::vector<double> numbers;
      if (samples[i])
        pack(*samples[i], numbers);
      out << quoted(names[entry.probe]) << ',' << entry.index << ','
          << entry.distance << ',' << entry.x[0] << ',' << entry.x[1] << ','
          << (samples[i] ? 1 : 0);
      for (unsigned int k = 0; k < n_sample_numbers; ++k)
        if (samples[i])
          out << ',' << numbers[k];
        else
          out << ",nan";
      out << '\n';
    }
  }
} // namespace NMM
