#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <mechanics/disk_system.h>
#include <mechanics/ghost_terms.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// The sum of forces on all unknowns: their work on a unit translation along each axis.
      dealii::Tensor<1, 2>
      resultant(const DiskSystem::Vector &forces)
      {
        dealii::Tensor<1, 2> sum;
        auto                 i = forces.local_range().first;
        for (const double force : forces)
          sum[component_of(i++)] += force;
        return dealii::Utilities::MPI::sum(sum, forces.get_mpi_communicator());
      }
    } // namespace


    DiskSystem::DiskSystem(const CoverSystem                       &covers,
                           const dealii::AffineConstraints<double> &constraints,
                           const ElasticityProblem                 &problem,
                           const std::vector<const DiskCover *>    &disks)
      : covers(&covers)
      , constraints(&constraints)
      , problem(&problem)
      , disks(disks)
    {
      unsigned int n = 0;
      for (const DiskCover *disk : disks)
      {
        offsets.push_back(n);
        n += disk->n_functions();
      }
      matrix.reinit(n, n);
      work_matrix.reinit(n, n);
      rhs.reinit(n);
    }


    void
    DiskSystem::assemble(const EdgeTerms       &edge_terms,
                         const CurveConditions &conditions,
                         const Vector          &like)
    {
      if (disks.empty())
        return;
      Vector zero(like);
      zero = 0.;
      columns.assign(rhs.size(), zero);
      works       = columns;
      matrix      = 0.;
      work_matrix = 0.;
      for (unsigned int d = 0; d < disks.size(); ++d)
      {
        add_circle(d, edge_terms, conditions);
        add_loads(d, conditions);
      }
      for (Vector &work : works)
        work.compress(dealii::VectorOperation::add);
      for (dealii::FullMatrix<double> *m : {&matrix, &work_matrix})
        dealii::Utilities::MPI::sum(*m, covers->communicator(), *m);
    }


    void
    DiskSystem::add_circle(const unsigned int     d,
                           const EdgeTerms       &edge_terms,
                           const CurveConditions &conditions)
    {
      const unsigned int n_per_cell =
        covers->manifold_mesh().mathematical_mesh().n_covers_per_cell();
      const unsigned int                           m = disks[d]->n_functions();
      std::vector<dealii::types::global_dof_index> unknowns(4 * n_per_cell);
      EdgeTerms::DiskEdge                          local;
      // These are columns still zero.
      std::array<Vector, 2> unit_tractions = {
        {columns[offsets[d]], columns[offsets[d]]}};
      for_each_tie(
        *covers,
        conditions,
        [&](const unsigned int e, const ElementEdge &edge) {
          if (!edge_terms.compute_disk_edge(e, edge, *disks[d], local))
            return;
          const auto pair = covers_of_pair(*covers, e, edge.neighbor);
          for (unsigned int i = 0; i < 4 * n_per_cell; ++i)
            unknowns[i] = unknown_of(pair[cover_of(i)], component_of(i));
          for (unsigned int j = 0; j < m; ++j)
          {
            constraints->distribute_local_to_global(local.couplings[j],
                                                    unknowns,
                                                    columns[offsets[d] + j]);
            constraints->distribute_local_to_global(local.works[j],
                                                    unknowns,
                                                    works[offsets[d] + j]);
          }
          for (unsigned int c = 0; c < 2; ++c)
            constraints->distribute_local_to_global(local.unit_tractions[c],
                                                    unknowns,
                                                    unit_tractions[c]);
          matrix.add(local.matrix, 1., offsets[d], offsets[d]);
          work_matrix.add(local.work_matrix, 1., offsets[d], offsets[d]);
        });
      for (Vector &traction : unit_tractions)
        traction.compress(dealii::VectorOperation::add);
      const double length = resultant(unit_tractions[0])[0];
      for (unsigned int j = 0; j < m; ++j)
      {
        Vector &column = columns[offsets[d] + j];
        column.compress(dealii::VectorOperation::add);
        const dealii::Tensor<1, 2> force = resultant(column);
        for (unsigned int c = 0; c < 2; ++c)
          column.add(-force[c] / length, unit_tractions[c]);
      }
    }


    void
    DiskSystem::add_loads(const unsigned int     d,
                          const CurveConditions &conditions)
    {
      const PhysicalMesh &mesh    = covers->manifold_mesh().physical_mesh();
      const auto         &regions = mesh.regions();
      const auto          inside =
        std::find_if(regions.begin(), regions.end(), [&](const auto &region) {
          return disks[d]->contains(region.inside);
        });
      AssertThrow(inside != regions.end(), dealii::ExcInternalError());
      const unsigned int region = inside - regions.begin();
      const Material    &material =
        problem->materials[problem->region_to_material(mesh)[region]];
      const std::vector<unsigned int> pressures =
        pressures_within(region, conditions);

      AssertThrow(material.varying_initial_stress == nullptr,
                  InputError("a disk cover bears a uniform initial stress only",
                             "material \"" + material.name + "\"",
                             "resolve its crack tip by a graded mesh "
                             "instead"));
      DiskCover::Loads loads;
      loads.initial_stress = material.initial_stress;
      loads.body_force     = [&](const dealii::Point<2> &x) {
        dealii::Tensor<1, 2> force = material.weight_at(x, problem->gravity);
        if (problem->body_force != nullptr)
          for (unsigned int c = 0; c < 2; ++c)
            force[c] += problem->body_force->value(x, c);
        return force;
      };
      loads.face_pressure = [&](const dealii::Point<2> &x) {
        double pressure = 0.;
        for (const unsigned int c : pressures)
          if (const auto &value = problem->boundary_conditions[c].value)
            pressure += value->value(x);
        return pressure;
      };
      const std::vector<double> work = disks[d]->work(loads);
      std::copy(work.begin(), work.end(), rhs.begin() + offsets[d]);
    }


    std::vector<unsigned int>
    DiskSystem::pressures_within(const unsigned int     region,
                                 const CurveConditions &conditions) const
    {
      const ManifoldMesh       &mesh = covers->manifold_mesh();
      std::vector<unsigned int> is_within(problem->boundary_conditions.size());
      const auto [first, last] = covers->locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
        if (mesh.region(e) == region)
          for (const ElementEdge &edge : mesh.edges(e))
            for (const unsigned int c : conditions.conditions(e, edge))
              is_within[c] = problem->boundary_conditions[c].is_pressure();
      dealii::Utilities::MPI::max(is_within, covers->communicator(), is_within);
      std::vector<unsigned int> result;
      for (unsigned int c = 0; c < is_within.size(); ++c)
        if (is_within[c] > 0)
          result.push_back(c);
      return result;
    }


    const std::vector<DiskSystem::Vector> &
    DiskSystem::couplings() const
    {
      return columns;
    }


    const dealii::FullMatrix<double> &
    DiskSystem::own_matrix() const
    {
      return matrix;
    }


    void
    DiskSystem::combine(const std::vector<Vector> &responses, Vector &solution)
    {
      if (disks.empty())
        return;
      const unsigned int n = columns.size();
      AssertDimension(responses.size(), n);
      dealii::FullMatrix<double> schur(matrix);
      dealii::Vector<double>     c(n), g(rhs);
      for (unsigned int j = 0; j < n; ++j)
      {
        g(j) -= columns[j] * solution;
        for (unsigned int k = 0; k < n; ++k)
          schur(k, j) -= columns[k] * responses[j];
      }
      schur.gauss_jordan();
      schur.vmult(c, g);
      for (unsigned int j = 0; j < n; ++j)
        solution.add(-c(j), responses[j]);

      values.clear();
      for (unsigned int d = 0; d < disks.size(); ++d)
      {
        const auto first = c.begin() + offsets[d];
        values.emplace_back(first, first + disks[d]->n_functions());
      }
    }


    const std::vector<dealii::Vector<double>> &
    DiskSystem::coefficients() const
    {
      return values;
    }


    double
    DiskSystem::energy(const Vector &solution) const
    {
      double sum = 0.;
      for (unsigned int d = 0; d < disks.size(); ++d)
      {
        const dealii::Vector<double> &c = values[d];
        for (unsigned int j = 0; j < c.size(); ++j)
        {
          sum += c(j) * (works[offsets[d] + j] * solution);
          for (unsigned int k = 0; k < c.size(); ++k)
            sum +=
              0.5 * c(j) * c(k) * work_matrix(offsets[d] + j, offsets[d] + k);
        }
      }
      return sum;
    }
  } // namespace internal
} // namespace NMM
