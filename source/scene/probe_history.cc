#include <nmm/covers/weight_functions.h>

#include <scene/probe_history.h>

namespace NMM
{
  namespace internal
  {
    ProbeHistory::ProbeHistory(const CoverSystem        &covers,
                               const ProbePoints        &points,
                               const std::vector<Probe> &probes)
      : communicator(covers.communicator())
    {
      follow(covers, points, probes);
    }


    void
    ProbeHistory::follow(const CoverSystem        &covers,
                         const ProbePoints        &points,
                         const std::vector<Probe> &probes)
    {
      names.clear();
      terms.clear();
      const ManifoldMesh     &mesh         = covers.manifold_mesh();
      const MathematicalMesh &mathematical = mesh.mathematical_mesh();
      for (const ProbePoints::Entry &entry : points.entries())
        if (!probes[entry.probe].is_line)
        {
          double values[WeightFunctions::max_per_cell];
          WeightFunctions::values(
            mathematical.degree(),
            mathematical.real_to_reference(mesh.cell(entry.element), entry.x),
            values);
          names.push_back(probes[entry.probe].name);
          terms.emplace_back();
          unsigned int i = 0;
          for (const unsigned int cover : covers.covers(entry.element))
          {
            if (covers.locally_owned_covers().is_element(cover))
              terms.back().push_back({cover, values[i]});
            ++i;
          }
        }
    }


    bool
    ProbeHistory::is_empty() const
    {
      return names.empty();
    }


    void
    ProbeHistory::open(const std::string &file_name, const int continue_after)
    {
      std::vector<std::string> columns;
      for (const std::string &name : names)
        for (const char *suffix : {"_x", "_y", "_vx", "_vy"})
          columns.push_back(name + suffix);
      table = std::make_unique<CsvSeries>(file_name, columns, continue_after);
    }


    std::vector<double>
    ProbeHistory::evaluate(const Vector &u, const Vector &v) const
    {
      std::vector<double> values(4 * terms.size(), 0.);
      for (unsigned int i = 0; i < terms.size(); ++i)
        for (const Term &term : terms[i])
          for (unsigned int c = 0; c < 2; ++c)
          {
            values[4 * i + c] += term.weight * u(unknown_of(term.cover, c));
            values[4 * i + 2 + c] += term.weight * v(unknown_of(term.cover, c));
          }
      std::vector<double> sums(values.size());
      dealii::Utilities::MPI::sum(values, communicator, sums);
      return sums;
    }


    void
    ProbeHistory::write(const double               time,
                        const unsigned int         step,
                        const std::vector<double> &values)
    {
      if (table)
        table->append(time, step, values);
    }
  } // namespace internal
} // namespace NMM
